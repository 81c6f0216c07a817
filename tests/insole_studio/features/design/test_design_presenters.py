"""Presenters with mocked views: what they show, and what they make of intents."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from round_foot import round_foot

from insole_core.cases.case_record import (
    Annotations,
    FootRecord,
    KeyPoint,
    Patient,
    ReferencePlane,
    Variant,
)
from insole_core.cases.scan_source import ScanSource
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import Pelott
from insole_core.workflows.pad_library import load_pads
from insole_studio.document.case import Case
from insole_studio.document.foot_display import FootDisplay
from insole_studio.document.insole_preview import InsolePreview
from insole_studio.document.load_view import LoadView
from insole_studio.document.material_model import MaterialModel
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.document.side_by_side import SideBySide
from insole_studio.features.design.models.model_presenter import (
    FootPresenter,
    InsolePresenter,
    ShownModels,
)
from insole_studio.features.design.models.section_presenter import SectionPresenter
from insole_studio.features.design.parameters.parameters_presenter import ParametersPresenter
from insole_studio.features.design.parameters.warnings_presenter import WarningsPresenter
from insole_studio.features.design.patient.patient_presenter import PatientPresenter
from insole_studio.features.design.rows import FieldGroup
from insole_studio.features.design.tools.all_tools import make_tools
from insole_studio.features.design.tools.pelott_tool import PelottTool
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.jobs import Jobs


class MockView:
    """Remembers the last arguments of every ``show_…``; signals can be fired by hand."""

    def __init__(self) -> None:
        self.shown: dict[str, tuple[Any, ...]] = {}
        self.can_move = False
        for name in (
            "field_edited",
            "field_moved",
            "move_cancelled",
            "side_chosen",
            "variant_chosen",
            "proposal_chosen",
            "device_selected",
            "correction_selected",
            "correction_toggled",
            "correction_removed",
            "correction_moved",
            "correction_copied",
        ):
            setattr(self, name, MockSignal())

    def move_mesh(self, *arguments: Any) -> bool:
        self.shown["move_mesh"] = arguments
        return self.can_move

    def right_of(self, outline: FloatArray, place_mm: FloatArray) -> FloatArray:
        return np.append(outline[:, :2].max(axis=0), place_mm[2])

    def __getattr__(self, name: str) -> Callable[..., None]:
        if name not in ("clear", "forget_typed") and not name.startswith("show_"):
            raise AttributeError(name)

        def show(*arguments: Any, **_named: Any) -> None:
            self.shown[name] = arguments

        return show


class MockSignal:
    def __init__(self) -> None:
        self._slots: list[Callable[..., None]] = []

    def connect(self, slot: Callable[..., None]) -> None:
        self._slots.append(slot)

    def emit(self, *values: Any) -> None:
        for slot in self._slots:
            slot(*values)


@pytest.fixture
def view() -> Any:
    return MockView()


@pytest.fixture
def case() -> Case:
    return Case()


@pytest.fixture
def tool_controller(case: Case, section: SectionModel, rim: RimModel) -> ToolController:
    return ToolController(case, make_tools(section, rim, PlantarView(), load_pads(), load_rules()))


@pytest.fixture
def rim(case: Case, surface: InsolePreview) -> RimModel:
    return RimModel(case, surface)


@pytest.fixture
def section(qapp: QApplication) -> SectionModel:
    return SectionModel()


@pytest.fixture
def surface(case: Case, qapp: QApplication) -> Iterator[InsolePreview]:
    jobs = Jobs()
    yield InsolePreview(case, jobs)
    jobs.close()


@pytest.fixture
def facts(
    case: Case, surface: InsolePreview, section: SectionModel, tool_controller: ToolController
) -> Iterator[dict[str, Any]]:
    """What the two 3-D panels follow."""
    jobs = Jobs()
    yield {
        "case": case,
        "surface": surface,
        "section": section,
        "tool_controller": tool_controller,
        "counterpart": SideBySide(case, jobs, surface.builder),
        "plantar": PlantarView(),
        "load": LoadView(case, surface, jobs, MaterialModel()),
    }
    jobs.close()


@pytest.fixture
def display(case: Case) -> Iterator[FootDisplay]:
    jobs = Jobs()
    yield FootDisplay(case, jobs)
    jobs.close()


@pytest.fixture
def open_foot(case: Case, make_foot: Any) -> Callable[[], None]:
    def open_it(side: Side = Side.LEFT) -> None:
        case.open_foot(make_foot(side), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64))

    return open_it


NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)


def add_pelott(case: Case, **values: Any) -> Pelott:
    assert case.record.design is not None
    pad = Pelott(centre_mm=(0.0, 150.0), **values)
    case.apply(case.record.design.with_added(pad), "Place")
    return pad


def groups(view: Any) -> dict[str, FieldGroup]:
    return {group.title: group for group in view.shown["show_groups"][0]}


class TestPatient:
    @pytest.fixture
    def presenter(self, view: Any, case: Case) -> PatientPresenter:
        return PatientPresenter(view, case)

    def test_an_empty_case_has_no_side_and_no_measure(
        self, view: Any, presenter: PatientPresenter
    ) -> None:
        assert view.shown["show_feet"] == (None, [])
        assert view.shown["show_measures"] == ([],)

    def test_typing_is_one_step(self, view: Any, case: Case, presenter: PatientPresenter) -> None:
        view.field_edited.emit("name", " Anna B. ")
        assert case.record.patient == Patient(name="Anna B.")
        view.field_edited.emit("name", "Anna B.")
        assert len(case.history) == 1

    def test_measures_and_distances_are_listed(
        self, view: Any, case: Case, presenter: PatientPresenter
    ) -> None:
        case.open_foot(round_foot(Side.LEFT), NOWHERE)
        points = (KeyPoint("Heel", (0.0, 0.0, 0.0)), KeyPoint("Arch", (30.0, 40.0, 0.0)))
        case.apply(Annotations(points), "Mark")
        measures = {m.name: m for m in view.shown["show_measures"][0]}
        about, length, *limits = measures["Foot length"].values[0].split()
        assert about == "≈"  # this foot has no toes
        assert float(length) == pytest.approx(250.0, abs=1.0)
        assert limits == ["±", "?"]
        assert "toe tip" in measures["Foot length"].tip
        assert measures["± ?: not known of another scanner's file"].values == ()
        assert not measures["Heel width"].values[0].startswith("≈")
        assert measures["Heel – Arch"].values == ("50.0",)
        assert measures["Arch height"].unit == "mm"

    def test_two_feet_are_measured_beside_each_other(
        self, view: Any, case: Case, presenter: PatientPresenter
    ) -> None:
        case.open_foot(round_foot(Side.LEFT), NOWHERE)
        case.apply(FootRecord.begun(round_foot(Side.RIGHT), NOWHERE), "Add")
        assert view.shown["show_feet"] == (Side.RIGHT, [Side.LEFT, Side.RIGHT])
        measures = {m.name: m.values for m in view.shown["show_measures"][0]}
        left, right, limits, difference, percent = measures["Foot length"]
        left, right = (value.removeprefix("≈ ") for value in (left, right))  # the foot has no toes
        assert float(left) == pytest.approx(float(right), abs=0.2)
        assert float(difference) == pytest.approx(0.0, abs=0.2)
        assert (limits, percent) == ("?", "0")
        points = (KeyPoint("Heel", (0.0, 0.0, 0.0)), KeyPoint("Arch", (30.0, 40.0, 0.0)))
        case.apply(Annotations(points), "Mark")
        measures = {m.name: m.values for m in view.shown["show_measures"][0]}
        assert measures["Heel – Arch"] == ("", "50.0", "", "", "")

    def test_what_was_not_scanned_has_no_number_and_is_not_compared(
        self, view: Any, case: Case, presenter: PatientPresenter
    ) -> None:
        case.open_foot(round_foot(Side.LEFT, cut_mm=60.0), NOWHERE)
        alone = {m.name: m for m in view.shown["show_measures"][0]}
        for name, reason in (("Foot length", "toes"), ("Ball girth", "back of the foot")):
            assert (alone[name].values, alone[name].unit) == (("not scanned",), "")
            assert reason in alone[name].tip
        assert float(alone["Heel width"].values[0].split()[0]) > 50
        assert "Navicular height" not in alone  # it waits for a mark, not for a scan
        case.apply(FootRecord.begun(round_foot(Side.RIGHT), NOWHERE), "Add")
        both = {m.name: m.values for m in view.shown["show_measures"][0]}
        left, right, *compared = both["Foot length"]
        assert (left, compared) == ("–", ["?", "", ""])
        assert float(right.removeprefix("≈ ")) == pytest.approx(250.0, abs=1.0)

    def test_a_side_and_a_variant_are_chosen(
        self, view: Any, case: Case, presenter: PatientPresenter, open_foot: Any, make_foot: Any
    ) -> None:
        open_foot()
        assert view.shown["show_variants"] == (["A"], "A")
        left = case.record.current
        assert left is not None
        case.apply(left.with_variant(Variant("B", left.design)), "Duplicate")
        assert view.shown["show_variants"] == (["A", "B"], "B")
        view.variant_chosen.emit("A")
        assert case.record.current.chosen == "A"
        view.side_chosen.emit(Side.RIGHT)
        assert case.side is Side.LEFT

    def test_the_eye_switches_and_the_cross_removes(
        self, view: Any, case: Case, presenter: PatientPresenter, open_foot: Any
    ) -> None:
        open_foot()
        pad = add_pelott(case)
        view.correction_toggled.emit(pad.id)
        assert case.record.design is not None
        assert not case.record.design.corrections[0].enabled
        assert not view.shown["show_corrections"][0][0].enabled
        view.correction_removed.emit(pad.id)
        assert case.record.design.corrections == ()

    def test_selecting_a_row_selects_everywhere(
        self, view: Any, case: Case, presenter: PatientPresenter, open_foot: Any
    ) -> None:
        open_foot()
        pad = add_pelott(case)
        view.correction_selected.emit(pad.id)
        assert case.selection == pad.id
        assert view.shown["show_corrections"][0][0].selected


class TestParameters:
    @pytest.fixture
    def presenter(
        self, view: Any, case: Case, tool_controller: ToolController, rim: RimModel
    ) -> ParametersPresenter:
        return ParametersPresenter(
            view,
            case,
            tool_controller,
            load_pads(),
            load_rules(),
            rim=rim,
            plantar=PlantarView(),
            materials=MaterialModel(),
            request_action=lambda _key: None,
            ask_size=lambda: None,
        )

    def test_numbers_of_the_selected_pelott(
        self, view: Any, case: Case, presenter: ParametersPresenter, open_foot: Any
    ) -> None:
        open_foot()
        pad = add_pelott(case, height_mm=7.0)
        case.select(pad.id)
        fields = {field.key: field.value for field in groups(view)["Pelott"].fields}
        assert fields["correction.height_mm"] == 7.0
        assert fields["correction.centre_mm.1"] == 150.0

    def test_edits_of_one_field_are_one_undo(
        self, view: Any, case: Case, presenter: ParametersPresenter, open_foot: Any
    ) -> None:
        open_foot()
        pad = add_pelott(case)
        case.select(pad.id)
        for height in (6.5, 7.0, 7.5):
            view.field_edited.emit("correction.height_mm", height)
        view.field_edited.emit("correction.centre_mm.0", 4.0)
        assert len(case.history) == 3
        assert case.record.design is not None
        (edited,) = case.record.design.corrections
        assert isinstance(edited, Pelott)
        assert (edited.height_mm, edited.centre_mm) == (7.5, (4.0, 150.0))

    def test_a_size_of_the_library_is_taken(
        self, view: Any, case: Case, presenter: ParametersPresenter, open_foot: Any
    ) -> None:
        open_foot()
        case.select(add_pelott(case).id)
        view.proposal_chosen.emit("size.1")
        assert case.record.design is not None
        (pad,) = case.record.design.corrections
        assert isinstance(pad, Pelott)
        assert (pad.length_mm, pad.width_mm, pad.height_mm) == (70, 50, 4)

    def test_the_pelott_tool_shows_and_takes_the_next_size(
        self,
        view: Any,
        case: Case,
        tool_controller: ToolController,
        presenter: ParametersPresenter,
        open_foot: Any,
    ) -> None:
        open_foot()
        tool_controller.take("pelott")
        view.proposal_chosen.emit("size.2")
        view.field_edited.emit("template.height_mm", 5.0)
        assert isinstance(tool_controller.tool, PelottTool)
        assert (
            tool_controller.tool.template.width_mm,
            tool_controller.tool.template.height_mm,
        ) == (60, 5)
        assert len(case.history) == 0

    def test_posting_by_numbers(
        self,
        view: Any,
        case: Case,
        tool_controller: ToolController,
        presenter: ParametersPresenter,
        open_foot: Any,
    ) -> None:
        open_foot()
        tool_controller.take("posting")
        view.field_edited.emit("posting.rearfoot_deg", 4.0)
        view.field_edited.emit("posting.forefoot_deg", -2.0)
        (group,) = [g for title, g in groups(view).items() if title == "Posting"]
        assert [field.value for field in group.fields[:2]] == [4.0, -2.0]
        assert case.record.design is not None
        assert len(case.record.design.corrections) == 1

    def test_the_insole_has_its_numbers_always(
        self, view: Any, case: Case, presenter: ParametersPresenter, open_foot: Any
    ) -> None:
        open_foot()
        view.field_edited.emit("insole.thickness_mm", 5.0)
        assert case.record.design is not None
        assert case.record.design.thickness_mm == 5.0
        assert groups(view)["Insole"].fields[0].value == 5.0

    def test_the_plane_by_numbers_and_gone(
        self,
        view: Any,
        case: Case,
        tool_controller: ToolController,
        presenter: ParametersPresenter,
        open_foot: Any,
    ) -> None:
        open_foot()
        case.apply(Annotations(plane=ReferencePlane((1.0, 2.0, 3.0))), "Place")
        tool_controller.take("plane")
        view.field_edited.emit("plane.z", 9.0)
        view.field_edited.emit("plane.roll_deg", -5.0)
        assert case.record.annotations.plane == ReferencePlane((1.0, 2.0, 9.0), roll_deg=-5.0)
        view.proposal_chosen.emit("remove.plane")
        assert case.record.annotations.plane is None


class TestModels:
    def test_no_foot_offers_what_comes_next(
        self, view: Any, facts: dict[str, Any], display: FootDisplay
    ) -> None:
        FootPresenter(view, ShownModels(**facts), display).show_all()
        sentence, offers = view.shown["show_empty"]
        assert "No scan yet" in sentence
        assert list(offers) == ["capture", "open_session", "open_archive", "open_example"]

    @pytest.mark.parametrize("side", list(Side))
    def test_the_foot_appears_with_its_side(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        facts: dict[str, Any],
        display: FootDisplay,
        make_foot: Any,
        forget_results: Callable[[], None],
        qtbot: QtBot,
        side: Side,
    ) -> None:
        presenter = FootPresenter(view, ShownModels(**facts), display)
        scanned = make_foot(side)
        forget_results()
        foot = replace(scanned)  # whose surface for display is not known yet
        case.open_foot(foot, NOWHERE)
        assert view.shown["show_mesh"] == (foot.mesh, None)
        qtbot.waitUntil(lambda: view.shown["show_mesh"][0] is not foot.mesh)
        assert view.shown["show_mesh"] == (foot.display_surface().mesh, None)
        assert view.shown["show_side"] == (side,)
        assert view.shown["show_directions"][0] is side
        assert presenter.side is side

    def test_directions_stand_around_a_shown_shoe(
        self,
        view: Any,
        surface: InsolePreview,
        facts: dict[str, Any],
        open_foot: Any,
        qtbot: QtBot,
    ) -> None:
        presenter = InsolePresenter(view, ShownModels(**facts))
        open_foot()
        qtbot.waitUntil(lambda: surface.mesh is not None)
        _, alone = view.shown["show_directions"]
        presenter.show_shoe(True)
        (shoe,), (_, box) = view.shown["show_shoe"], view.shown["show_directions"]
        points = np.concatenate(shoe.lines)
        assert points[:, 1].max() > alone[1, 1]
        assert (box[0] <= points.min(axis=0)).all()
        assert (box[1] >= points.max(axis=0)).all()
        presenter.show_shoe(False)
        assert np.array_equal(view.shown["show_directions"][1], alone)

    def test_a_pelott_raises_the_insole_at_its_place(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        facts: dict[str, Any],
        open_foot: Any,
        qtbot: QtBot,
    ) -> None:
        presenter = InsolePresenter(view, ShownModels(**facts))
        open_foot()
        qtbot.waitUntil(lambda: surface.mesh is not None)
        before = surface.height_mm(0.0, 150.0)
        far = surface.height_mm(0.0, 40.0)
        case.select(add_pelott(case, height_mm=6.0).id)
        assert surface.height_mm(0.0, 150.0) == pytest.approx(before + 6.0, abs=0.05)
        assert surface.height_mm(0.0, 40.0) == far
        _others, selected = view.shown["show_outlines"]
        assert len(selected) == 1
        assert {h.name for h in view.shown["show_handles"][0]} >= {"move", "length", "width"}
        assert presenter.place(0.0, 150.0)[2] == pytest.approx(before + 6.0, abs=0.05)

    def test_a_posting_is_built_beside_the_window(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        facts: dict[str, Any],
        tool_controller: ToolController,
        rim: RimModel,
        open_foot: Any,
        qtbot: QtBot,
    ) -> None:
        ParametersPresenter(
            view,
            case,
            tool_controller,
            (),
            load_rules(),
            rim=rim,
            plantar=PlantarView(),
            materials=MaterialModel(),
            request_action=lambda _key: None,
            ask_size=lambda: None,
        )
        open_foot()
        qtbot.waitUntil(lambda: surface.mesh is not None)
        flat = surface.height_mm(30.0, 30.0) - surface.height_mm(-30.0, 30.0)
        tool_controller.take("posting")
        view.field_edited.emit("posting.rearfoot_deg", 4.0)
        qtbot.waitUntil(lambda: surface.is_current)
        # A left foot's medial side is +x; a varus post raises it.
        assert surface.height_mm(30.0, 30.0) - surface.height_mm(-30.0, 30.0) > flat + 3.0


class TestSection:
    @pytest.mark.parametrize("side", list(Side))
    def test_the_cut_shows_pad_and_words_where_they_are(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        section: SectionModel,
        tool_controller: ToolController,
        open_foot: Any,
        qtbot: QtBot,
        side: Side,
    ) -> None:
        presenter = SectionPresenter(
            view, case=case, surface=surface, section=section, tool_controller=tool_controller
        )
        assert "section tool" in view.shown["show_sentence"][0]
        open_foot(side)
        qtbot.waitUntil(lambda: surface.mesh is not None)
        section.show(SectionPlane((0.0, 150.0)))
        presenter.show()
        before = height_in(view, 0.0)
        add_pelott(case, height_mm=6.0)
        assert height_in(view, 0.0) == pytest.approx(before + 6.0, abs=0.05)
        _top, _bottom, skin, ends = view.shown["show_cut"]
        assert len(skin) > 10
        assert ends[0 if side is Side.RIGHT else 1] == "Medial"

    def test_along_the_foot_the_toes_are_at_the_right(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        section: SectionModel,
        tool_controller: ToolController,
        open_foot: Any,
        qtbot: QtBot,
    ) -> None:
        presenter = SectionPresenter(
            view, case=case, surface=surface, section=section, tool_controller=tool_controller
        )
        open_foot()
        qtbot.waitUntil(lambda: surface.mesh is not None)
        section.show(SectionPlane((20.0, 110.0), 90.0))
        top, _bottom, _skin, ends = view.shown["show_cut"]
        assert ends == ("Heel", "Toes")
        # The arch of the test's foot is highest at y = 110.
        assert abs(top[top[:, 1].argmax(), 0]) < 2.0
        section.show(SectionPlane((500.0, 110.0), 90.0))
        presenter.show()
        assert "beside" in view.shown["show_sentence"][0]


def height_in(view: Any, along_mm: float) -> float:
    top = view.shown["show_cut"][0]
    return float(np.interp(along_mm, top[:, 0], top[:, 1]))


class TestWarnings:
    def test_what_breaks_a_rule_is_said_and_leads_there(
        self,
        view: Any,
        case: Case,
        surface: InsolePreview,
        tool_controller: ToolController,
        open_foot: Any,
        qtbot: QtBot,
    ) -> None:
        view.warning_chosen = MockSignal()
        looked: list[tuple[float, float]] = []
        presenter = WarningsPresenter(
            view,
            case=case,
            surface=surface,
            tool_controller=tool_controller,
            rules=load_rules(),
            materials=MaterialModel(),
            look_at=looked.append,
        )
        open_foot()
        qtbot.waitUntil(lambda: surface.mesh is not None)
        assert view.shown["show_warnings"] == ([],)
        pad = Pelott(centre_mm=(70.0, 150.0))
        assert case.record.design is not None
        case.apply(case.record.design.with_added(pad), "Place")
        presenter.show()
        (row,) = [row for row in view.shown["show_warnings"][0] if "below the foot" in row.text]
        assert row.leads
        presenter.lead_to(view.shown["show_warnings"][0].index(row))
        assert case.selection == pad.id
        assert looked == [(70.0, 150.0)]
