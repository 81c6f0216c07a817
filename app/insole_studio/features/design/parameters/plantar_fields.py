"""The fields of the tool that lays a map, its peaks, and the reliefs that these propose."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from insole_core.cases.case_record import FootRecord
from insole_core.pressure.laid_map import PressureMap
from insole_core.pressure.regions import overloaded_heads, region_peaks
from insole_core.workflows.findings import Catalogue
from insole_core.workflows.foot_landmarks import landmarks_of
from insole_core.workflows.pad_library import LibraryPad
from insole_core.workflows.plantar_pressure import heads_to_relieve, with_reliefs
from insole_studio.document.case import Case
from insole_studio.document.plantar_view import PlantarLayer, PlantarView
from insole_studio.features.design.rows import ChoiceSpec, FieldGroup, FieldSpec, Proposal
from insole_studio.texts import fill, localised, tr

_THRESHOLD_KPA = (20.0, 1500.0)
_PLACE_MM = 400.0


class PlantarFields:
    """Shows and edits where the map lies, and offers reliefs under overloaded heads."""

    def __init__(
        self,
        case: Case,
        view: PlantarView,
        pads: Sequence[LibraryPad],
        behind_heads_mm: float,
        relief_kpa: float,
    ) -> None:
        self._case = case
        self._view = view
        self._catalogue = Catalogue({}, "", pads, behind_heads_mm)
        self._relief_kpa = self._threshold_kpa = relief_kpa
        case.opened.connect(self._forget_threshold)

    def groups(self) -> list[FieldGroup]:
        """Return the groups of the tool."""
        plantar = self._case.shown.plantar
        shown = self._view.shown(plantar)
        lay = Proposal("action.lay_pressure", tr("Lay a pressure map or footprint…"))
        if shown is None:
            note = tr("Nothing lies under this foot yet.")
            return [FieldGroup(tr("Pressure and footprint"), note=note, offers=(lay,))]
        fields = [
            _place(
                "plantar.x_mm", tr("Across"), shown.placement.x_mm,
                tr("Moves it across the foot; > 0 is to the right, seen from above"),
            ),
            _place(
                "plantar.y_mm", tr("Along"), shown.placement.y_mm,
                tr("Moves it along the foot; > 0 is towards the toes"),
            ),
            FieldSpec(
                "plantar.turn_deg", tr("Turned"), "°", shown.placement.turn_deg, -180, 180, 0.5,
                tip=tr("Counter-clockwise, seen from above"),
            ),
            FieldSpec(
                "plantar.opacity", tr("Opacity"), "%", 100 * self._view.opacity, 5, 100, 5, 0,
                tip=tr("How much the map covers foot and insole"),
            ),
        ]  # fmt: skip
        offers = (Proposal("plantar.remove", tr("Remove")), lay)
        title = tr("Pressure and footprint")
        if isinstance(shown, PressureMap) and shown.device:
            title += f": {shown.device}"
        choice: tuple[ChoiceSpec, ...] = ()
        if plantar.pressure is not None and plantar.picture is not None:
            choice = (self._layer_choice(),)
        group = FieldGroup(title, (*choice, *fields), offers)
        if isinstance(shown, PressureMap):
            return [group, self._peak_group(shown)]
        return [group]

    def edit(self, name: str, value: float | str) -> None:
        """Take a value of a field."""
        if name == "layer":
            self._view.want(PlantarLayer(str(value)))
        elif name == "opacity":
            self._view.set_opacity(float(value) / 100)
        elif name == "threshold":
            self._threshold_kpa = float(value)
        else:
            self._move(name, float(value))

    def choose(self, name: str) -> None:
        """Run the action of a button."""
        foot = self._case.record.current
        if foot is None:
            return
        if name == "remove":
            self._case.apply(self._view.without(foot), tr("Remove the map"))
        else:
            self._relieve(foot, tuple(int(head) for head in name.removeprefix("relieve-")))

    def _relieve(self, foot: FootRecord, heads: tuple[int, ...]) -> None:
        landmarks = landmarks_of(self._case.record)
        design = with_reliefs(foot.design, heads, landmarks, self._catalogue, self._case.stamped)
        self._case.apply(design, tr("Relieve where the pressure is high"))

    def _move(self, name: str, value: float) -> None:
        foot = self._case.record.current
        shown = None if foot is None else self._view.shown(foot.plantar)
        if foot is None or shown is None:
            return
        changes: dict[str, float] = {name: value}
        placement = replace(shown.placement, **changes)  # type: ignore[arg-type]
        self._case.apply(self._view.placed(foot, placement), tr("Move the map"), f"plantar:{name}")

    def _forget_threshold(self) -> None:
        """Go back to the usual threshold: another one was chosen for another patient."""
        self._threshold_kpa = self._relief_kpa

    def _layer_choice(self) -> ChoiceSpec:
        layer = self._view.layer(self._case.shown.plantar)
        options = (
            (PlantarLayer.PRESSURE.value, tr("Pressure map")),
            (PlantarLayer.PICTURE.value, tr("Footprint")),
        )
        return ChoiceSpec("plantar.layer", tr("Shown"), str(layer), options)

    def _peak_group(self, shown: PressureMap) -> FieldGroup:
        """Return the peaks of the regions, and a relief for each head above the threshold."""
        peaks = region_peaks(shown, landmarks_of(self._case.shown))
        design = self._case.shown.design
        heads = overloaded_heads(peaks, self._threshold_kpa)
        open_heads = () if design is None else heads_to_relieve(design, self._known(heads))
        offers = tuple(
            Proposal(
                f"plantar.relieve-{head}",
                fill(
                    tr("Relief: {head} ({kpa:.0f} kPa)"),
                    head=head_text(head),
                    kpa=peaks[f"head_{head}"] or 0.0,
                ),
                tr("Add the relief of the library under this head; it can be undone and changed"),
            )
            for head in open_heads
        )
        threshold = FieldSpec(
            "plantar.threshold", tr("Relieve from"), "kPa", self._threshold_kpa, *_THRESHOLD_KPA,
            10, 0, tip=tr("Peak pressure under a head from which on a relief is proposed"),
        )  # fmt: skip
        note = peaks_text(peaks)
        if heads and not open_heads:
            note += "  " + tr("Every head above it is relieved.")
        return FieldGroup(tr("Peaks, kPa"), (threshold,), offers, note)

    def _known(self, heads: tuple[int, ...]) -> tuple[int, ...]:
        """Return the heads for which the library has a relief."""
        kinds = {pad.kind for pad in self._catalogue.pads}
        return tuple(head for head in heads if f"relief_head_{head}" in kinds)


def peaks_text(peaks: Mapping[str, float | None]) -> str:
    """Return the peaks of all regions in a line; "–" where no sensor lies."""
    number = {name: "–" if peak is None else localised(peak, ".0f") for name, peak in peaks.items()}
    heads = " ".join(number[f"head_{head}"] for head in range(1, 6))
    return tr(
        "heel {heel}, midfoot {midfoot}, heads 1–5: {heads}, hallux {hallux}, toes {toes}"
    ).format(
        heel=number["heel"],
        midfoot=number["midfoot"],
        heads=heads,
        hallux=number["hallux"],
        toes=number["lesser_toes"],
    )


def head_text(head: int) -> str:
    """Return the name of a metatarsal head, 1 to 5."""
    return (
        tr("1st head"),
        tr("2nd head"),
        tr("3rd head"),
        tr("4th head"),
        tr("5th head"),
    )[head - 1]


def _place(key: str, label: str, value: float, tip: str) -> FieldSpec:
    return FieldSpec(key, label, "mm", value, -_PLACE_MM, _PLACE_MM, 0.5, tip=tip)
