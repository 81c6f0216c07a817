"""The posting tool: raise the medial or the lateral edge by degrees."""

from __future__ import annotations

from collections.abc import Callable

from insole_core.geometry.rounding import rounded
from insole_core.insole.elements import Posting
from insole_core.insole.fields import ranges_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.posting_angles import posting_angles
from insole_studio.document.case import Case
from insole_studio.features.design.tools.tool import SurfaceContext, Tool, rise_mm, with_number
from insole_studio.scene.gesture import Gesture
from insole_studio.scene.pointer import Handle, Phase, PointerEvent
from insole_studio.texts import tr

ANGLE_STEP_DEG = 0.5
DEG_PER_MM = 0.2
HANDLE_SHARES = {"rearfoot": (0.09, 0.15), "forefoot": (0.16, 0.68)}
"""Where the handles are, medially and along the foot, in lengths of the foot: from behind, where
the Achilles axis is read, the one of the forefoot is seen beside the other."""
BORDER_SHARE = 0.42


class PostingTool(Tool):
    """Tool that sets rearfoot and forefoot angle, each by a handle at the medial edge."""

    key = "posting"

    def hint(self, _case: Case) -> str:
        """Return one short sentence on what the user can do now."""
        return tr("Drag heel or forefoot up to raise the medial edge, down to raise the lateral")

    def handles(self, case: Case, surface: SurfaceContext) -> tuple[Handle, ...]:
        """Return the handles of the rearfoot and the forefoot."""
        if case.foot is None:
            return ()
        length, medial = case.foot.length_mm, surface.side.medial_sign
        return tuple(
            Handle(
                name,
                surface.place(medial * across * length, along * length),
                _HINTS[name](),
                "move",
            )
            for name, (across, along) in HANDLE_SHARES.items()
        )

    def press(self, case: Case, event: PointerEvent, _surface: SurfaceContext) -> Gesture | None:
        """Grab the handle of the heel or of the forefoot."""
        part = event.handle or self._part(case, event)
        if part not in _HINTS or case.record.design is None:
            return None
        return _tilt(case, case.record.design, part, event)

    def wheel(self, case: Case, event: PointerEvent, steps: float) -> bool:
        """Change the angle of the part under the pointer."""
        part = event.handle or self._part(case, event)
        design = case.record.design
        if part not in _HINTS or design is None:
            return False
        changed = tilted(design, part, steps * ANGLE_STEP_DEG)
        case.apply(changed, _SENTENCES[part](), f"posting:{part}")
        return True

    def _part(self, case: Case, event: PointerEvent) -> str:
        if event.by_key:
            return "rearfoot"
        if event.surface_mm is None or case.foot is None:
            return ""
        behind = event.surface_mm[1] < BORDER_SHARE * case.foot.length_mm
        return "rearfoot" if behind else "forefoot"


def posting_of(design: InsoleDesign) -> Posting | None:
    """Return the design's posting; None if it has none."""
    return next(iter(design.of(Posting, active=False)), None)


def with_posting(design: InsoleDesign, posting: Posting) -> InsoleDesign:
    """Return the design with the posting added or replaced."""
    if design.correction(posting.id) is None:
        return design.with_added(posting)
    return design.with_changed(posting)


def tilted(
    design: InsoleDesign, part: str, by_deg: float, new: Posting | None = None
) -> InsoleDesign:
    """Return the design with its rearfoot or forefoot angle changed.

    Parameters
    ----------
    design
        The design.
    part
        ``rearfoot`` or ``forefoot``.
    by_deg
        Change of the angle, degrees.
    new
        Posting to start from if the design has none.
    """
    posting = posting_of(design) or new or Posting()
    name = f"{part}_deg"
    angle = rounded(getattr(posting, name) + by_deg, ANGLE_STEP_DEG)
    angle = float(ranges_of(Posting)[name].nearest(angle))
    return with_posting(design, with_number(posting, name, angle))


def _tilt(case: Case, design: InsoleDesign, part: str, press: PointerEvent) -> Gesture:
    new = Posting()
    changed, event = design, press
    while event.phase is not Phase.RELEASE:
        event = yield
        changed = tilted(design, part, rise_mm(press, event) * DEG_PER_MM, new)
        case.preview(changed)
    if posting_angles(changed) != posting_angles(design):
        case.apply(changed, _SENTENCES[part]())
    else:
        case.end_preview()


_HINTS: dict[str, Callable[[], str]] = {
    "rearfoot": lambda: tr("Drag up or down to change the rearfoot angle"),
    "forefoot": lambda: tr("Drag up or down to change the forefoot angle"),
}
_SENTENCES: dict[str, Callable[[], str]] = {
    "rearfoot": lambda: tr("Tilt the rearfoot"),
    "forefoot": lambda: tr("Tilt the forefoot"),
}
