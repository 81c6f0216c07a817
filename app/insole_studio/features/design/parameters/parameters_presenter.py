"""Presenter of the parameters panel."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, Protocol, TypeAlias

from insole_core.cases.case_record import ReferencePlane
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import ClinicRules
from insole_core.insole.elements import Correction, Pelott, Posting
from insole_core.insole.fields import Range
from insole_core.insole.finishing.rim_curve import counted_from, replaced_station
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.pressure.regions import RELIEF_KPA
from insole_core.workflows.pad_library import LibraryPad, default_pelott
from insole_studio.document.case import Case
from insole_studio.document.material_model import MaterialModel
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel, with_stations
from insole_studio.features.design.correction_names import name_of, pad_text
from insole_studio.features.design.parameters.correction_fields import field_specs, with_value
from insole_studio.features.design.parameters.device_fields import (
    SLIDERS,
    device_group,
    layers_group,
    shell_group,
    with_device_value,
    with_foot_share,
    with_layers_value,
    with_post_value,
    with_shell_value,
    with_slid_value,
    with_usual_thickness,
)
from insole_studio.features.design.parameters.foot_proposals import FootProposals
from insole_studio.features.design.parameters.plantar_fields import PlantarFields
from insole_studio.features.design.rim_texts import place_text
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec, Proposal
from insole_studio.features.design.tools.brush_tool import BrushTool
from insole_studio.features.design.tools.metatarsal_line import selected_pelott
from insole_studio.features.design.tools.outline_tool import (
    proposed_size_eu,
    with_size,
    with_source,
)
from insole_studio.features.design.tools.pelott_tool import PelottTool
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.features.design.tools.rim_tool import remove_station
from insole_studio.features.design.tools.tool import with_number
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.pointer import AnyGesture
from insole_studio.texts import tr

ANGLE = Range(-90, 90, "degrees")
PLACE = Range(-400, 400)
Fields: TypeAlias = tuple[FieldSpec | ChoiceSpec, ...]
TEMPLATE_KEYS = ("height_mm", "length_mm", "width_mm")


class ParametersPanel(Protocol):
    """The parameters panel as its presenter sees it, with the signals it emits."""

    field_edited: Any
    field_moved: Any
    move_cancelled: Any
    proposal_chosen: Any

    def show_groups(self, groups: Sequence[FieldGroup]) -> None: ...  # noqa: D102


class ParametersPresenter:
    """Shows and edits the values of the selected correction and of the insole."""

    def __init__(
        self,
        panel: ParametersPanel,
        case: Case,
        tool_controller: ToolController,
        pads: Sequence[LibraryPad],
        rules: ClinicRules,
        *,
        rim: RimModel,
        plantar: PlantarView,
        materials: MaterialModel,
        request_action: Callable[[str], None],
        ask_size: Callable[[], float | None],
    ) -> None:
        self._panel = panel
        self._rim = rim
        self._materials = materials
        self._is_sliding = False
        self._request, self._ask_size = request_action, ask_size
        self._case = case
        self._tool_controller = tool_controller
        self._pads = pads
        self._foot_offers = FootProposals(case, rules, default_pelott(pads))
        self._plantar = PlantarFields(
            case, plantar, pads, rules.pelott_usual_behind_heads_mm, RELIEF_KPA
        )
        plantar.changed.connect(self.show)
        panel.field_edited.connect(self.edit)
        panel.field_moved.connect(self.slide)
        panel.move_cancelled.connect(tool_controller.cancel)
        panel.proposal_chosen.connect(self.choose)
        case.opened.connect(self.show)
        case.changed.connect(self.show)
        case.preview_changed.connect(self.show)
        case.selection_changed.connect(self.show)
        tool_controller.tool_changed.connect(self.show)
        rim.selection_changed.connect(self.show)
        materials.changed.connect(self.show)
        self.show()

    def show(self) -> None:
        """Show the groups for the current tool and selection."""
        design = self._case.shown.design
        if design is None:
            note = tr("The numbers of the design appear here.")
            self._panel.show_groups([FieldGroup("", note=note)])
            return
        is_outline = self._tool_controller.tool.key == "outline"
        layers = layers_group(design, self._materials.table)
        make = _make_groups(design, layers, self._expert_fields(design), outline_first=is_outline)
        device = [device_group(design, design.side)]
        if design.shell is not None:
            device.append(shell_group(design, self._materials.table))
        self._panel.show_groups([*self._groups(design), *device, *make])

    def edit(self, key: str, value: Any) -> None:
        """Set a value; consecutive edits of one field are one undo step."""
        if self._is_sliding:
            self._tool_controller.drag(None)
        group, name = key.split(".", 1)
        _EDITS[group](self, name, value)
        self.show()

    def slide(self, key: str, value: float) -> None:
        """Show a value while its slider is dragged."""
        design = self._case.record.design
        if design is None:
            return
        if not self._tool_controller.is_busy:
            self._tool_controller.begin(self._follow_slider())
        self._tool_controller.drag(with_slid_value(design, key, value))

    def _follow_slider(self) -> AnyGesture:
        """Preview each design that comes; the last one comes as an edit of its own."""
        self._is_sliding = True
        try:
            while (design := (yield)) is not None:
                self._case.preview(design)
        finally:
            self._is_sliding = False

    def choose(self, key: str) -> None:
        """Run the action of a button."""
        kind, name = key.split(".", 1)
        if kind == "action":
            self._request(name)
            return
        if self._foot_offers.choose(kind, name):
            return
        if kind == "size":
            self._take_size(self._pads[int(name)].template)
        elif kind == "remove":
            self._remove(name)
        elif kind == "thickness":
            self._take_thickness()
        elif kind == "plantar":
            self._plantar.choose(name)

    def _groups(self, design: InsoleDesign) -> list[FieldGroup]:
        tool, selected = self._tool_controller.tool, self._selected(design)
        own = _TOOL_GROUPS.get(tool.key)
        if own is not None:
            return own(self)
        if tool.key == "posting" and not (selected and selected.type != Posting.type):
            return [self._posting_group(posting_of(design) or Posting())]
        of_selected = [] if selected is None else [self._correction_group(selected)]
        if isinstance(tool, BrushTool):
            title = tr("Next stroke")
            return [
                FieldGroup(title, field_specs(tool.template, "template", self._side)),
                *of_selected,
            ]
        if isinstance(tool, PelottTool) and selected is None:
            return [self._template_group(tool.template)]
        return of_selected

    def _expert_fields(self, design: InsoleDesign) -> Fields:
        """Return the fields for experts of the correction whose other values are shown."""
        tool, selected = self._tool_controller.tool, self._selected(design)
        if tool.key in _TOOL_GROUPS:
            return ()
        if tool.key == "posting" and selected is None:
            selected = posting_of(design) or Posting()
        if selected is None:
            return ()
        prefix = "posting" if selected.type == Posting.type else "correction"
        return field_specs(selected, prefix, self._side, expert=True)

    @property
    def _side(self) -> Side:
        side = self._case.shown.side
        assert side is not None, "there are fields for the design of a foot only"
        return side

    def _selected(self, design: InsoleDesign) -> Correction | None:
        selection = self._case.selection
        return design.correction(selection) if selection is not None else None

    def _correction_group(self, correction: Correction) -> FieldGroup:
        if correction.type == Posting.type:
            return self._posting_group(correction)
        fields = field_specs(correction, "correction", self._side)
        offers = self._size_offers(correction)
        return FieldGroup(name_of(correction), fields, offers, caption=_size_caption(offers))

    def _posting_group(self, posting: Correction) -> FieldGroup:
        """Return the group of the angles, with the posting suggested by the measured axis."""
        note = self._foot_offers.posting_note()
        offers = self._foot_offers.posting_offers()
        fields = field_specs(posting, "posting", self._side)
        return FieldGroup(name_of(posting), fields, offers, note)

    def _rim_groups(self) -> list[FieldGroup]:
        """Return the group of the selected station."""
        placed = self._rim.placed.get(-1 if self._rim.selected is None else self._rim.selected)
        if placed is None:
            return []
        fields = field_specs(placed.station, "station", self._side)
        offers = (Proposal("remove.station", tr("Remove")),)
        return [FieldGroup(f"{tr('Rim')}: {place_text(placed)}", fields, offers)]

    def _plane_groups(self) -> list[FieldGroup]:
        return [_plane_group(self._case.shown.annotations.plane)]

    def _template_group(self, template: Pelott) -> FieldGroup:
        specs = field_specs(template, "template", self._side)
        fields = tuple(spec for spec in specs if spec.key.split(".")[1] in TEMPLATE_KEYS)
        title = tr("Next: {name}").format(name=name_of(template))
        offers = self._size_offers(template)
        return FieldGroup(title, fields, offers, caption=_size_caption(offers))

    def _size_offers(self, correction: Correction) -> tuple[Proposal, ...]:
        """Return the sizes in the library of what the pad is prescribed as."""
        if not isinstance(correction, Pelott):
            return ()
        kind = correction.kind, correction.shape
        return tuple(
            Proposal(f"size.{number}", pad.size, pad_text(pad))
            for number, pad in enumerate(self._pads)
            if pad.size and (pad.template.kind, pad.template.shape) == kind
        )

    def _take_size(self, size: Pelott) -> None:
        pad, design = selected_pelott(self._case), self._case.record.design
        if pad is not None and design is not None:
            changed = design.with_changed(_sized(pad, size))
            self._case.apply(changed, tr("Take a size of the library"))
        elif isinstance(self._tool_controller.tool, PelottTool):
            self._tool_controller.tool.template = _sized(self._tool_controller.tool.template, size)
            self.show()

    def _take_thickness(self) -> None:
        design = self._case.record.design
        if design is not None:
            self._case.apply(
                with_usual_thickness(design, self._materials.table), tr("Take the usual thickness")
            )

    def _remove(self, name: str) -> None:
        if name == "station" and self._rim.selected is not None:
            remove_station(self._case, self._rim, self._rim.selected)
        if name == "plane":
            self._case.apply(
                replace(self._case.record.annotations, plane=None), tr("Remove the reference plane")
            )

    def _edit_correction(self, name: str, value: Any) -> None:
        design = self._case.record.design
        selected = self._selected(design) if design is not None else None
        if design is None or selected is None:
            return
        sentence = tr("Edit: {name}").format(name=name_of(selected))
        changed = design.with_changed(with_value(selected, name, value, self._side))
        self._case.apply(changed, sentence, f"{selected.id}:{name}")

    def _edit_template(self, name: str, value: Any) -> None:
        tool = self._tool_controller.tool
        if isinstance(tool, PelottTool | BrushTool):
            tool.template = with_value(tool.template, name, value, self._side)

    def _edit_posting(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None:
            before = posting_of(design) or self._case.stamped(Posting())
            changed = design.with_set(with_value(before, name, value, self._side))
            self._case.apply(changed, tr("Edit the posting"), f"posting:{name}")

    def _edit_station(self, name: str, value: Any) -> None:
        design, rim, number = self._case.record.design, self._rim.rim, self._rim.selected
        placed = None if number is None else self._rim.placed.get(number)
        if design is None or design.finish is None or rim is None or placed is None:
            return
        stations = design.finish.rim
        if name == "over":
            changed = counted_from(rim, placed.station, value)
        else:
            changed = with_value(placed.station, name, value, self._side)
        stations = replaced_station(stations, placed.number, changed)
        self._case.apply(
            with_stations(design, stations), tr("Change the rim"), f"rim:{number}:{name}"
        )

    def _edit_device(self, name: str, value: float) -> None:
        design = self._case.record.design
        if design is not None:
            changed = with_device_value(design, name, value)
            self._case.apply(changed, SLIDERS[name].label(), f"device:{name}")

    def _edit_base(self, name: str, value: float) -> None:
        design = self._case.record.design
        if design is not None:
            changed = with_foot_share(design, value)
            self._case.apply(changed, tr("Edit the device"), f"base:{name}")

    def _edit_finish(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None and design.finish is not None:
            changed = replace(design, finish=with_value(design.finish, name, value, self._side))
            self._case.apply(changed, tr("Edit the device"), f"finish:{name}")

    def _edit_shell(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None and design.shell is not None:
            changed = with_shell_value(design, name, value, self._materials.table)
            self._case.apply(changed, tr("Edit the shell"), f"shell:{name}")

    def _edit_post(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None and design.shell is not None:
            changed = with_post_value(design, name, value)
            self._case.apply(changed, tr("Edit the post"), f"post:{name}")

    def _edit_insole(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None:
            self._case.apply(
                with_value(design, name, value, self._side), tr("Edit the insole"), f"insole:{name}"
            )

    def _edit_layers(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is not None:
            layers = with_layers_value(design, name, value)
            changed = replace(design, layers=layers)
            self._case.apply(changed, tr("Edit the layers"), f"layers:{name}")

    def _edit_outline(self, name: str, value: Any) -> None:
        design = self._case.record.design
        if design is None:
            return
        if (name, value) == ("source", "shoe_size"):
            size_eu = proposed_size_eu(self._case.record) or self._ask_size()
            if size_eu is None:
                return
            outline = with_size(self._case.record, size_eu)
        elif name == "source":
            outline = with_source(self._case.record, value)
        else:
            outline = with_value(design.outline, name, value, self._side)
        changed = replace(design, outline=outline)
        self._case.apply(changed, tr("Edit the outline"), f"outline:{name}")

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


def _size_caption(offers: tuple[Proposal, ...]) -> str:
    return tr("Size") if offers else ""


def _sized(pad: Pelott, size: Pelott) -> Pelott:
    return replace(pad, length_mm=size.length_mm, width_mm=size.width_mm, height_mm=size.height_mm)


def _plane_group(plane: ReferencePlane | None) -> FieldGroup:
    if plane is None:
        return FieldGroup(tr("Reference plane"), note=tr("Click on the foot to place it."))
    fields = (
        _field("plane.z", tr("Height"), plane.origin_mm[2], PLACE),
        _field("plane.pitch_deg", tr("Toe end up"), plane.pitch_deg, ANGLE),
        _field("plane.roll_deg", tr("Sideways"), plane.roll_deg, ANGLE),
    )
    return FieldGroup(tr("Reference plane"), fields, (Proposal("remove.plane", tr("Remove")),))


def _make_groups(
    design: InsoleDesign, layers: FieldGroup, expert_fields: Fields, *, outline_first: bool
) -> list[FieldGroup]:
    """Return the groups that are always shown: how the insole is made, and last the expert's."""
    side = design.side
    made = [
        FieldGroup(tr("Insole"), field_specs(design, "insole", side)),
        layers,
    ]
    outline = FieldGroup(tr("Outline"), field_specs(design.outline, "outline", side))
    own = (
        *expert_fields,
        *field_specs(design.layers, "layers", side, expert=True),
        *field_specs(design, "insole", side, expert=True),
    )
    expert = []
    for title, part, prefix in (
        (tr("Expert: device"), design.finish, "finish"),
        (tr("Expert: shell"), design.shell, "shell"),
    ):
        if part is not None:
            fields = field_specs(part, prefix, side, expert=True)
            expert.append(FieldGroup(title, fields, folds=True))
    expert.append(FieldGroup(tr("Expert"), own, folds=True))
    return [outline, *made, *expert] if outline_first else [*made, outline, *expert]


def _field(key: str, label: str, value: float, allowed: Range) -> FieldSpec:
    unit = "°" if allowed.unit == "degrees" else allowed.unit
    return FieldSpec(key, label, unit, value, allowed.least, allowed.greatest, step=0.5)


_TOOL_GROUPS: dict[str, Callable[[ParametersPresenter], list[FieldGroup]]] = {
    "outline": lambda _presenter: [],
    "plane": ParametersPresenter._plane_groups,
    "rim": ParametersPresenter._rim_groups,
    "turn": lambda presenter: presenter._foot_offers.pose_groups(),
    "key_point": lambda presenter: presenter._foot_offers.landmark_groups(),
    "plantar": lambda presenter: presenter._plantar.groups(),
}
"""Field groups of the tools that show their own values, whatever is selected."""
_EDITS: dict[str, Callable[[ParametersPresenter, str, Any], None]] = {
    "correction": ParametersPresenter._edit_correction,
    "template": ParametersPresenter._edit_template,
    "posting": ParametersPresenter._edit_posting,
    "station": ParametersPresenter._edit_station,
    "device": ParametersPresenter._edit_device,
    "base": ParametersPresenter._edit_base,
    "finish": ParametersPresenter._edit_finish,
    "shell": ParametersPresenter._edit_shell,
    "post": ParametersPresenter._edit_post,
    "insole": ParametersPresenter._edit_insole,
    "layers": ParametersPresenter._edit_layers,
    "outline": ParametersPresenter._edit_outline,
    "plane": ParametersPresenter._edit_plane,
    "plantar": lambda presenter, name, value: presenter._plantar.edit(name, value),
    "pose": lambda presenter, name, value: presenter._foot_offers.turn(name, value),
}
