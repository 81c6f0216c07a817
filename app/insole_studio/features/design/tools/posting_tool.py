"""The posting tool: raise the medial or the lateral edge by degrees."""

from __future__ import annotations

from insole_core.insole.elements import Posting
from insole_core.insole.grips import Grip
from insole_core.insole.prescription.design import InsoleDesign
from insole_studio.document.case import Case
from insole_studio.features.design.tools.hand import dragged, element_handles, turn_by_notches
from insole_studio.features.design.tools.tool import SurfaceContext, Tool
from insole_studio.scene.pointer import Gesture, Handle, PointerEvent
from insole_studio.texts import tr

BORDER_SHARE = 0.42


class PostingTool(Tool):
    """Tool that sets rearfoot and forefoot angle of the posting, which is added if need be."""

    key = "posting"

    def hint(self, _case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        return tr("Drag heel or forefoot up to raise the medial edge, down to raise the lateral")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the rearfoot and the forefoot."""
        return element_handles(case, Posting(), surface)

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab the handle of the heel or of the forefoot."""
        grip, design = _grip_at(case, event), case.record.design
        if grip is None or design is None:
            return None
        posting = posting_of(design) or Posting()
        return dragged(case, event, posting, grip, lambda tilted, _grip, _event: tilted)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Change the angle of the part under the pointer."""
        grip, design = _grip_at(case, event), case.record.design
        if grip is None or design is None:
            return False
        turn_by_notches(case, posting_of(design) or Posting(), grip, steps)
        return True


def posting_of(design: InsoleDesign) -> Posting | None:
    """Return the design's posting; None if it has none."""
    return next(iter(design.of(Posting, active=False)), None)


def _grip_at(case: Case, event: PointerEvent) -> Grip | None:
    """Return the grip of the part under the pointer."""
    if case.foot is None:
        return None
    part = event.handle or _part(event, BORDER_SHARE * case.foot.length_mm)
    return next((grip for grip in Posting().grips(case.foot) if grip.name == part), None)


def _part(event: PointerEvent, border_mm: float) -> str:
    if event.by_key:
        return "rearfoot"
    if event.surface_mm is None:
        return ""
    return "rearfoot" if event.surface_mm[1] < border_mm else "forefoot"
