"""Between the parameters panel and the case."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Protocol

from insole_core.cases.record import ReferencePlane
from insole_core.insole.design import InsoleDesign, Pelott, Posting
from insole_core.insole.limits import CORRECTION_RANGES, DESIGN_RANGES, Range
from insole_studio.stages.design.rows import FieldGroup, FieldSpec, Offer
from insole_studio.texts import tr
from insole_studio.tools.hand import Hand
from insole_studio.tools.pelott import PelottTool, selected_pelott
from insole_studio.tools.posting import posting_of, with_posting
from insole_studio.tools.tool import with_number
from insole_studio.workbench.case import Case
from insole_studio.workbench.pad_library import PadSize

ANGLE = Range(-90, 90, "degrees")
PLACE = Range(-400, 400)


class ParametersPanel(Protocol):
    """What the parameters panel shows, and the intents it emits."""

    field_edited: Any
    offer_chosen: Any

    def show_groups(self, groups: Sequence[FieldGroup]) -> None: ...  # noqa: D102


class ParametersPresenter:
    """Shows the numbers of the selected correction and of the insole, and takes new ones."""

    def __init__(
        self, panel: ParametersPanel, case: Case, hand: Hand, sizes: Sequence[PadSize]
    ) -> None:
        self._panel = panel
        self._case = case
        self._hand = hand
        self._sizes = sizes
        panel.field_edited.connect(self.edit)
        panel.offer_chosen.connect(self.choose)
        case.opened.connect(self.show)
        case.changed.connect(self.show)
        case.preview_changed.connect(self.show)
        case.selection_changed.connect(self.show)
        hand.tool_changed.connect(self.show)
        self.show()

    def show(self) -> None:
        """Show the groups that matter now."""
        design = self._case.shown.design
        if design is None:
            note = tr("The numbers of the design appear here.")
            self._panel.show_groups([FieldGroup("", note=note)])
            return
        self._panel.show_groups([*self._groups(design), _insole_group(design)])

    def edit(self, key: str, value: float) -> None:
        """Take a number; edits of one field that follow each other are one undo."""
        group, name = key.split(".", 1)
        _EDITS[group](self, name, value)
        self.show()

    def choose(self, key: str) -> None:
        """Do what a button offers."""
        kind, name = key.split(".", 1)
        if kind == "size":
            self._take_size(next(size for size in self._sizes if size.name == name))
        elif kind == "remove":
            self._remove(name)

    def _groups(self, design: InsoleDesign) -> list[FieldGroup]:
        pad = selected_pelott(self._case)
        tool = self._hand.tool
        if tool.key == "posting":
            return [_posting_group(posting_of(design) or Posting())]
        if tool.key == "plane":
            return [_plane_group(self._case.shown.annotations.plane)]
        if pad is not None:
            return [self._pelott_group(pad)]
        if isinstance(tool, PelottTool):
            return [self._template_group(tool.template)]
        return []

    def _pelott_group(self, pad: Pelott) -> FieldGroup:
        x, y = pad.centre_mm
        place = CORRECTION_RANGES[Pelott]["centre_mm"]
        fields = (
            _field("pelott.height_mm", tr("Height"), pad.height_mm, _pad_range("height_mm")),
            _field("pelott.turn_deg", tr("Turn"), pad.turn_deg, _pad_range("turn_deg")),
            _field("pelott.length_mm", tr("Length"), pad.length_mm, _pad_range("length_mm")),
            _field("pelott.width_mm", tr("Width"), pad.width_mm, _pad_range("width_mm")),
            _field("pelott.x", tr("Place x"), x, place),
            _field("pelott.y", tr("Place y"), y, place),
            _field("pelott.egg_ratio", tr("Egg ratio"), pad.egg_ratio, _pad_range("egg_ratio")),
        )
        return FieldGroup(tr("Pelott"), fields, self._size_offers())

    def _template_group(self, template: Pelott) -> FieldGroup:
        fields = (
            _field("template.height_mm", tr("Height"), template.height_mm, _pad_range("height_mm")),
            _field("template.length_mm", tr("Length"), template.length_mm, _pad_range("length_mm")),
            _field("template.width_mm", tr("Width"), template.width_mm, _pad_range("width_mm")),
        )
        return FieldGroup(tr("Next pelott"), fields, self._size_offers())

    def _size_offers(self) -> tuple[Offer, ...]:
        return tuple(
            Offer(
                f"size.{size.name}",
                f"{size.name}   {size.length_mm:g} × {size.width_mm:g} × {size.height_mm:g}",
            )
            for size in self._sizes
        )

    def _take_size(self, size: PadSize) -> None:
        pad, design = selected_pelott(self._case), self._case.record.design
        if pad is not None and design is not None:
            changed = design.with_changed(size.of(pad))
            self._case.apply(changed, tr("Take a pelott size"))
        elif isinstance(self._hand.tool, PelottTool):
            self._hand.tool.template = size.of(self._hand.tool.template)
            self.show()

    def _remove(self, name: str) -> None:
        if name == "plane":
            self._case.apply(
                replace(self._case.record.annotations, plane=None), tr("Remove the reference plane")
            )

    def _edit_pelott(self, name: str, value: float) -> None:
        pad, design = selected_pelott(self._case), self._case.record.design
        if pad is None or design is None:
            return
        x, y = pad.centre_mm
        places = {"x": (value, y), "y": (x, value)}
        edited = (
            replace(pad, centre_mm=places[name])
            if name in places
            else with_number(pad, name, value)
        )
        self._case.apply(design.with_changed(edited), tr("Edit the pelott"), f"{pad.id}:{name}")

    def _edit_template(self, name: str, value: float) -> None:
        if isinstance(self._hand.tool, PelottTool):
            self._hand.tool.template = with_number(self._hand.tool.template, name, value)

    def _edit_posting(self, name: str, value: float) -> None:
        design = self._case.record.design
        if design is not None:
            posting = with_number(posting_of(design) or Posting(), name, value)
            changed = with_posting(design, posting)
            self._case.apply(changed, tr("Edit the posting"), f"posting:{name}")

    def _edit_insole(self, name: str, value: float) -> None:
        design = self._case.record.design
        if design is not None:
            changed = with_number(design, name, value)
            self._case.apply(changed, tr("Edit the insole"), f"insole:{name}")

    def _edit_plane(self, name: str, value: float) -> None:
        annotations = self._case.record.annotations
        plane = annotations.plane
        if plane is None:
            return
        x, y, _ = plane.origin_mm
        turned = (
            replace(plane, origin_mm=(x, y, value))
            if name == "z"
            else with_number(plane, name, value)
        )
        changed = replace(annotations, plane=turned)
        self._case.apply(changed, tr("Turn the reference plane"), f"plane:{name}")


def _posting_group(posting: Posting) -> FieldGroup:
    allowed = CORRECTION_RANGES[Posting]
    rearfoot = _field(
        "posting.rearfoot_deg", tr("Rearfoot"), posting.rearfoot_deg, allowed["rearfoot_deg"]
    )
    forefoot = _field(
        "posting.forefoot_deg", tr("Forefoot"), posting.forefoot_deg, allowed["forefoot_deg"]
    )
    note = tr("> 0 raises the medial edge, < 0 the lateral edge")
    return FieldGroup(tr("Pronation / supination"), (rearfoot, forefoot), note=note)


def _plane_group(plane: ReferencePlane | None) -> FieldGroup:
    if plane is None:
        return FieldGroup(tr("Reference plane"), note=tr("Click on the foot to place it."))
    fields = (
        _field("plane.z", tr("Height"), plane.origin_mm[2], PLACE),
        _field("plane.pitch_deg", tr("Toe end up"), plane.pitch_deg, ANGLE),
        _field("plane.roll_deg", tr("Sideways"), plane.roll_deg, ANGLE),
    )
    return FieldGroup(tr("Reference plane"), fields, (Offer("remove.plane", tr("Remove")),))


def _insole_group(design: InsoleDesign) -> FieldGroup:
    grid = DESIGN_RANGES["grid_mm"]
    fields = (
        _field(
            "insole.thickness_mm",
            tr("Thickness"),
            design.thickness_mm,
            DESIGN_RANGES["thickness_mm"],
        ),
        FieldSpec(
            "insole.grid_mm", tr("Grid"), "mm", design.grid_mm, grid.least, grid.greatest, 0.25, 2
        ),
    )
    return FieldGroup(tr("Insole"), fields)


def _field(key: str, label: str, value: float, allowed: Range) -> FieldSpec:
    limits = (allowed.least, allowed.greatest)
    if not allowed.unit:
        return FieldSpec(key, label, "", value, *limits, step=0.05, decimals=2)
    unit = "°" if allowed.unit == "degrees" else allowed.unit
    return FieldSpec(key, label, unit, value, *limits, step=0.5)


def _pad_range(name: str) -> Range:
    return CORRECTION_RANGES[Pelott][name]


_EDITS: dict[str, Callable[[ParametersPresenter, str, float], None]] = {
    "pelott": ParametersPresenter._edit_pelott,
    "template": ParametersPresenter._edit_template,
    "posting": ParametersPresenter._edit_posting,
    "insole": ParametersPresenter._edit_insole,
    "plane": ParametersPresenter._edit_plane,
}
