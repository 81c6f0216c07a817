"""Tools by pointer events alone: no window, no renderer."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import Annotations, KeyPoint, ReferencePlane
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.landmarks import HEADS
from insole_core.geometry.side import Side
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.elements import (
    CORRECTION_TYPES,
    ArchRaise,
    HeelLift,
    Pelott,
    Posting,
    correction,
)
from insole_core.insole.grips import Grip, Pull
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.pad_library import load_pads
from insole_studio.document.case import Case
from insole_studio.document.plantar_view import PlantarView
from insole_studio.document.rim_model import RimModel
from insole_studio.document.section_plane import SectionModel, SectionPlane
from insole_studio.features.design.tools.all_tools import make_tools
from insole_studio.features.design.tools.key_point_tool import (
    KeyPointTool,
    confidence,
    distances,
    shown_points,
)
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.features.design.tools.tool_controller import ToolController
from insole_studio.scene.pointer import Phase, PointerEvent
from insole_studio.scene.view_camera import Preset, Subject, ViewCamera, look

CAMERA = ViewCamera(height_mm=400.0)
SIZE = (400, 400)


@dataclass(frozen=True)
class FlatGround:
    subject: Subject = Subject.FOOT
    side: Side = Side.LEFT

    def place(self, x_mm: float, y_mm: float) -> tuple[float, float, float]:
        return x_mm, y_mm, 0.0

    def covers(self, x_mm: float, y_mm: float) -> bool:
        return abs(x_mm) < 45 and 0 < y_mm < 260


GROUND = FlatGround()


def at(
    phase: Phase, x_mm: float, y_mm: float, handle: str | None = None, **more: Any
) -> PointerEvent:
    """A pointer over the sole, seen from below, one pixel a millimetre."""
    place = np.array([x_mm, y_mm, 0.0])
    seen = look(CAMERA, Subject.FOOT, Side.LEFT, SIZE)
    x_px, y_px = seen.pixels_of(place)[0]
    return PointerEvent(phase, Subject.FOOT, seen, (x_px, y_px), place, handle, **more)


@pytest.fixture
def case(make_foot: Any) -> Case:
    """A foot whose metatarsal heads are set so far ahead that no pad snaps to them."""
    case = Case()
    case.open_foot(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/foot.ply", "0" * 64))
    current = case.record.current
    assert current is not None
    heads = tuple(KeyPoint(name, (20.0 - 8.0 * i, 235.0, 0.0)) for i, name in enumerate(HEADS))
    marked = replace(current, annotations=Annotations(heads))
    case.open(case.record.with_foot(marked), None)
    return case


@pytest.fixture
def tool_controller(case: Case, section: SectionModel) -> ToolController:
    rim = RimModel(case, AsScanned())
    return ToolController(case, make_tools(section, rim, PlantarView(), load_pads(), load_rules()))


class AsScanned(QObject):
    """The preview of an insole without a rim of its own."""

    changed = Signal()
    finished = None


@pytest.fixture
def section() -> SectionModel:
    return SectionModel()


def drag(
    tool_controller: ToolController, *places: tuple[float, float], handle: str | None = None
) -> None:
    tool_controller.press(at(Phase.PRESS, *places[0], handle=handle), GROUND)
    for place in places[1:]:
        tool_controller.drag(at(Phase.MOVE, *place))
    tool_controller.drag(at(Phase.RELEASE, *places[-1]))


def design(case: Case) -> InsoleDesign:
    assert case.record.design is not None
    return case.record.design


def only_pelott(case: Case) -> Pelott:
    (pad,) = design(case).corrections
    assert isinstance(pad, Pelott)
    return pad


def test_a_click_places_a_pelott_there(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (3.0, 150.0))
    assert only_pelott(case).centre_mm == (3.0, 150.0)
    assert case.selection == only_pelott(case).id
    assert len(case.history) == 1


def test_dragging_a_pelott_is_one_undo(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    drag(tool_controller, (2.0, 152.0), (5.0, 160.0), (12.0, 162.0))
    assert only_pelott(case).centre_mm == (10.0, 160.0)
    assert len(case.history) == 2
    case.undo()
    assert only_pelott(case).centre_mm == (0.0, 150.0)


def test_the_picture_follows_the_hand(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    tool_controller.press(at(Phase.PRESS, 0.0, 150.0), GROUND)
    tool_controller.drag(at(Phase.MOVE, 4.0, 150.0))
    assert case.shown.design is not None
    (shown,) = case.shown.design.corrections
    assert isinstance(shown, Pelott)
    assert shown.centre_mm == (4.0, 150.0)
    assert only_pelott(case).centre_mm == (0.0, 150.0)


@pytest.mark.parametrize("tool", ["pelott", "key_point", "posting", "plane"])
def test_escape_restores(case: Case, tool_controller: ToolController, tool: str) -> None:
    tool_controller.take(tool)
    record = case.record
    assert tool_controller.press(at(Phase.PRESS, 0.0, 150.0), GROUND)
    tool_controller.drag(at(Phase.MOVE, 8.0, 180.0))
    assert tool_controller.cancel()
    assert case.shown is case.record is record
    assert len(case.history) == 0
    assert case.selection is None
    assert not tool_controller.cancel()


@pytest.mark.parametrize(
    ("handle", "start", "end", "name", "value"),
    [
        ("width", (20.0, 150.0), (25.0, 150.0), "width_mm", 50.0),
        ("turn", (0.0, 190.0), (-40.0, 190.0), "turn_deg", 45.0),
        ("height", (0.0, 120.0), (0.0, 128.0), "height_mm", 6.0),
        ("move", (0.0, 150.0), (-7.0, 148.0), "centre_mm", (-7.0, 148.0)),
    ],
)
def test_handles_reshape_the_pelott(
    case: Case,
    tool_controller: ToolController,
    handle: str,
    start: Any,
    end: Any,
    name: str,
    value: Any,
) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    drag(tool_controller, start, end, handle=handle)
    assert getattr(only_pelott(case), name) == pytest.approx(value)
    assert len(case.history) == 2


def test_the_length_handle_keeps_to_the_tip(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    handles = {h.name: h for h in tool_controller.tool.handles(case, GROUND)}
    tip = handles["length"].position_mm[1]
    drag(tool_controller, (0.0, tip), (0.0, 150.0 + 1.5 * (tip - 150.0)), handle="length")
    assert only_pelott(case).length_mm == pytest.approx(90.0)
    moved = {h.name: h for h in tool_controller.tool.handles(case, GROUND)}["length"].position_mm[1]
    assert moved == pytest.approx(150.0 + 1.5 * (tip - 150.0), abs=0.3)


def test_sizes_stay_in_their_range(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    drag(tool_controller, (20.0, 150.0), (-30.0, 150.0), handle="width")
    assert only_pelott(case).width_mm == 5.0


def test_the_wheel_raises_by_half_a_millimetre_in_one_undo(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    for _ in range(3):
        assert tool_controller.wheel(at(Phase.MOVE, 1.0, 150.0), 1.0)
    assert only_pelott(case).height_mm == 5.5
    assert len(case.history) == 2
    assert not tool_controller.wheel(at(Phase.MOVE, 35.0, 30.0), 1.0)


def test_arrows_nudge_as_one_sees(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    # From below, the right of the picture is -x.
    assert tool_controller.nudge(at(Phase.MOVE, 0.0, 0.0), 1, 0)
    assert only_pelott(case).centre_mm == (-0.5, 150.0)
    tool_controller.nudge(at(Phase.MOVE, 0.0, 0.0, coarse=True), 0, 1)
    tool_controller.nudge(at(Phase.MOVE, 0.0, 0.0, fine=True), 0, 1)
    assert only_pelott(case).centre_mm == (-0.5, 155.05)


def with_arch(case: Case, arch: ArchRaise) -> None:
    case.apply(design(case).with_added(arch), "Raise the arch")
    case.select(arch.id)


def only_arch(case: Case) -> ArchRaise:
    (arch,) = design(case).corrections
    assert isinstance(arch, ArchRaise)
    return arch


@pytest.mark.parametrize("tool", ["pelott", "orbit"])
@pytest.mark.parametrize(
    ("arch", "key", "value"),
    [
        (ArchRaise(height_mm=3.0, apex_mm=(10.0, 110.0)), "height_mm", 5.0),
        (ArchRaise(target_mm=30.0, apex_mm=(10.0, 110.0)), "target_mm", 32.0),
        (ArchRaise(target_mm=59.0, apex_mm=(10.0, 110.0)), "target_mm", 60.0),
    ],
    ids=["added", "to a height", "to the greatest height"],
)
def test_an_arch_is_moved_stretched_and_raised_by_handles(
    case: Case, tool_controller: ToolController, tool: str, arch: ArchRaise, key: str, value: float
) -> None:
    tool_controller.take(tool)
    with_arch(case, arch)
    names = {handle.name for handle in tool_controller.tool.handles(case, GROUND)}
    assert names == {"move", "length", "width", "height"}
    drag(tool_controller, (10.0, 110.0), (14.0, 100.0), handle="move")
    assert only_arch(case) == replace(arch, apex_mm=(14.0, 100.0))
    drag(tool_controller, (14.0, 150.0), (14.0, 160.0), handle="length")
    drag(tool_controller, (39.0, 100.0), (34.0, 100.0), handle="width")
    assert (only_arch(case).length_mm, only_arch(case).width_mm) == (120.0, 40.0)
    drag(tool_controller, (14.0, 40.0), (14.0, 48.0), handle="height")
    assert getattr(only_arch(case), key) == value
    case.undo()
    assert getattr(only_arch(case), key) == getattr(arch, key)


def test_the_foots_own_arch_is_raised_where_it_is_until_it_is_moved(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("pelott")
    with_arch(case, ArchRaise(height_mm=3.0))
    (move,) = (h for h in tool_controller.tool.handles(case, GROUND) if h.name == "move")
    x, y, _ = move.position_mm
    assert tool_controller.wheel(at(Phase.MOVE, x, y), 1.0)
    assert (only_arch(case).height_mm, only_arch(case).apex_mm) == (3.5, None)
    assert tool_controller.nudge(at(Phase.MOVE, 0.0, 0.0), 0, 1)
    apex = only_arch(case).apex_mm
    assert apex is not None
    assert apex == pytest.approx((x, y + 0.5), abs=0.01)


def test_no_pelott_beside_the_insole_or_on_the_back_of_the_foot(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("pelott")
    assert not tool_controller.press(at(Phase.PRESS, 0.0, 300.0), GROUND)
    seen = look(ViewCamera(Preset.DORSAL), Subject.FOOT, Side.LEFT, SIZE)
    above = PointerEvent(Phase.PRESS, Subject.FOOT, seen, (9, 9), np.array([0.0, 150.0, 60.0]))
    assert not tool_controller.press(above, GROUND)
    assert design(case).corrections == ()


def test_a_press_on_a_pelott_selects_the_topmost(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    drag(tool_controller, (0.0, 60.0))
    first, second = design(case).corrections
    tool_controller.take("orbit")
    assert not tool_controller.press(at(Phase.PRESS, 5.0, 150.0), GROUND)
    assert case.selection == first.id
    tool_controller.press(at(Phase.PRESS, 5.0, 60.0), GROUND)
    assert case.selection == second.id
    tool_controller.press(at(Phase.PRESS, 35.0, 220.0), GROUND)
    assert case.selection is None


@pytest.mark.parametrize(
    ("start", "rearfoot", "forefoot"), [((0.0, 40.0), 4.0, 0.0), ((0.0, 200.0), 0.0, 4.0)]
)
def test_dragging_up_raises_the_medial_edge(
    case: Case,
    tool_controller: ToolController,
    start: tuple[float, float],
    rearfoot: float,
    forefoot: float,
) -> None:
    tool_controller.take("posting")
    drag(tool_controller, start, (start[0], start[1] + 20.0))
    posting = posting_of(design(case))
    assert isinstance(posting, Posting)
    assert (posting.rearfoot_deg, posting.forefoot_deg) == (rearfoot, forefoot)
    assert len(case.history) == 1


def test_a_posting_stays_one_and_in_its_range(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("posting")
    drag(tool_controller, (0.0, 40.0), (0.0, 50.0))
    drag(tool_controller, (0.0, 40.0), (0.0, 240.0))
    assert len(design(case).corrections) == 1
    posting = posting_of(design(case))
    assert posting is not None
    assert posting.rearfoot_deg == 15.0


def test_a_click_without_a_drag_makes_no_posting(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("posting")
    drag(tool_controller, (0.0, 40.0))
    assert design(case).corrections == ()
    assert len(case.history) == 0


def test_clicks_on_the_skin_mark_further_points(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("key_point")
    drag(tool_controller, (0.0, 0.0))
    drag(tool_controller, (30.0, 40.0))
    points = case.record.annotations.key_points
    assert [point.name for point in points[len(HEADS) :]] == ["Point 1", "Point 2"]
    assert distances(case.record.annotations) == [("Point 1", "Point 2", pytest.approx(50.0))]


def test_a_marked_point_is_written_on_and_another_one_keeps_its_place(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("key_point")
    drag(tool_controller, (0.0, 0.0))
    drag(tool_controller, (30.0, 40.0))
    tool = tool_controller.tool
    assert isinstance(tool, KeyPointTool)
    texts = ["sore, 3 weeks", "sore, 3 weeks"]
    tool.ask_text = lambda _before: texts.pop()
    event = at(Phase.PRESS, 0.0, 0.0, handle="point:Point 1")
    assert tool_controller.double_click(event, GROUND)
    (write, _remove) = tool_controller.offers(replace(event, handle="point:Point 2"), GROUND)
    assert write.text == "Write on it…"
    write.run()

    def names() -> list[str]:
        return [point.name for point in case.record.annotations.key_points[len(HEADS) :]]

    assert names() == ["sore, 3 weeks", "sore, 3 weeks 2"]
    drag(tool_controller, (10.0, 10.0))
    assert names()[2] == "Point 3"
    case.undo()
    case.undo()
    assert names() == ["sore, 3 weeks", "Point 2"]
    landmark = replace(event, handle=f"point:{HEADS[0]}")
    assert not tool_controller.double_click(landmark, GROUND)


def test_a_landmark_dragged_is_sure_from_then_on(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("key_point")
    name = "heel_centre"
    assert confidence(case, name) < 1.0
    drag(tool_controller, shown_points(case)[name][:2], (5.0, 180.0), handle=f"point:{name}")
    assert shown_points(case)[name] == pytest.approx((5.0, 180.0, 0.0))
    assert confidence(case, name) == 1.0
    assert distances(case.record.annotations) == []
    case.undo()
    assert confidence(case, name) < 1.0


def test_the_plane_is_put_raised_and_turned(case: Case, tool_controller: ToolController) -> None:
    tool_controller.take("plane")
    drag(tool_controller, (10.0, 100.0))
    assert case.record.annotations.plane == ReferencePlane((10.0, 100.0, 0.0))
    drag(tool_controller, (10.0, 100.0), (10.0, 106.0), handle="plane-raise")
    drag(tool_controller, (10.0, 170.0), (10.0, 180.0), handle="plane-pitch")
    assert case.record.annotations.plane == ReferencePlane((10.0, 100.0, 6.0), pitch_deg=5.0)
    assert len(case.history) == 3


def test_turning_the_plane_lifts_the_end_that_was_grabbed(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("plane")
    drag(tool_controller, (0.0, 100.0))
    for name, axis in (("plane-pitch", 1), ("plane-roll", 0)):
        before = {h.name: h.position_mm for h in tool_controller.tool.handles(case, GROUND)}[name]
        drag(tool_controller, before[:2], (before[0], before[1] + 10.0), handle=name)
        after = {h.name: h.position_mm for h in tool_controller.tool.handles(case, GROUND)}[name]
        assert after[2] > before[2] + 1.0, (name, axis)


def test_undo_in_the_middle_of_a_drag_is_not_lost(
    case: Case, tool_controller: ToolController
) -> None:
    tool_controller.take("pelott")
    drag(tool_controller, (0.0, 150.0))
    tool_controller.press(at(Phase.PRESS, 0.0, 150.0), GROUND)
    tool_controller.take("orbit")
    assert not tool_controller.is_busy
    assert only_pelott(case).centre_mm == (0.0, 150.0)


@pytest.mark.parametrize("tool", ["orbit", "pelott", "key_point", "posting", "plane"])
def test_every_tool_says_what_one_can_do(
    case: Case, tool_controller: ToolController, tool: str
) -> None:
    tool_controller.take(tool)
    assert 10 < len(tool_controller.tool.hint(case)) < 90


class TestSection:
    def test_a_click_cuts_there_and_a_drag_moves_the_cut(
        self, tool_controller: ToolController, section: SectionModel
    ) -> None:
        tool_controller.take("section")
        drag(tool_controller, (10.0, 60.0), (10.0, 60.0))
        assert section.plane == SectionPlane((10.0, 60.0))
        drag(tool_controller, (10.0, 60.0), (0.0, 90.0), handle="section-move")
        assert section.plane == SectionPlane((0.0, 90.0))

    def test_its_end_turns_it(self, tool_controller: ToolController, section: SectionModel) -> None:
        tool_controller.take("section")
        section.show(SectionPlane((10.0, 60.0)))
        drag(tool_controller, (55.0, 60.0), (10.0, 110.0), handle="section-turn")
        assert section.plane == SectionPlane((10.0, 60.0), 90.0)

    def test_escape_puts_it_back(
        self, tool_controller: ToolController, section: SectionModel
    ) -> None:
        tool_controller.take("section")
        section.show(SectionPlane((10.0, 60.0)))
        tool_controller.press(at(Phase.PRESS, 30.0, 80.0), GROUND)
        tool_controller.drag(at(Phase.MOVE, 35.0, 85.0))
        assert section.plane != SectionPlane((10.0, 60.0))
        tool_controller.cancel()
        assert section.plane == SectionPlane((10.0, 60.0))

    def test_it_is_no_step_of_undo(
        self, tool_controller: ToolController, case: Case, section: SectionModel
    ) -> None:
        tool_controller.take("section")
        drag(tool_controller, (10.0, 60.0), (20.0, 60.0))
        assert len(case.history) == 0
        assert tool_controller.nudge(at(Phase.MOVE, 0.0, 0.0), 0, 1)
        assert section.plane == SectionPlane((20.0, 60.5))


def test_an_element_says_itself_how_it_is_grabbed(
    case: Case, tool_controller: ToolController, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(correction, "CORRECTION_TYPES", dict(CORRECTION_TYPES))

    class Wedge(HeelLift):
        type = "wedge"

        def grips(self, foot: Foot) -> tuple[Grip, ...]:
            return (Grip("top", (0.0, 30.0), "Drag up to raise it", "Raise it", notch_mm=1.0),)

        def pulled(self, grip: str, pull: Pull, foot: Foot) -> Wedge:
            return replace(self, height_mm=round(self.height_mm + pull.up_mm / 10, 1))

    wedge = Wedge(height_mm=3.0)
    case.apply(design(case).with_added(wedge), "Add a wedge")
    case.select(wedge.id)
    tool = tool_controller.tool
    (handle,) = tool.handles(case, GROUND)
    assert (handle.name, handle.position_mm) == ("top", (0.0, 30.0, 0.0))
    assert "Heel lift: drag a handle" in tool.hint(case)
    drag(tool_controller, (0.0, 30.0), (0.0, 10.0), handle="top")
    rise_mm = at(Phase.PRESS, 0.0, 30.0).pixel[1] - at(Phase.PRESS, 0.0, 10.0).pixel[1]
    assert design(case).corrections == (replace(wedge, height_mm=3.0 + rise_mm / 10),)
    assert case.history.undo_sentence == "Raise it"
    assert tool.wheel(case, at(Phase.MOVE, 0.0, 0.0, by_key=True), 5.0)
    assert design(case).corrections == (replace(wedge, height_mm=3.5 + rise_mm / 10),)
    case.apply(design(case).with_changed(replace(wedge, enabled=False)), "Switch it off")
    assert tool.handles(case, GROUND) == ()


def test_a_selected_posting_is_tilted_while_the_view_is_turned(
    case: Case, tool_controller: ToolController
) -> None:
    posting = Posting(rearfoot_deg=2.0)
    case.apply(design(case).with_added(posting), "Add a posting")
    assert tool_controller.tool.handles(case, GROUND) == ()
    case.select(posting.id)
    names = [handle.name for handle in tool_controller.tool.handles(case, GROUND)]
    assert names == ["rearfoot", "forefoot"]
    drag(tool_controller, (10.0, 140.0), (10.0, 120.0), handle="forefoot")
    (tilted,) = design(case).corrections
    assert tilted == replace(posting, forefoot_deg=tilted.forefoot_deg)  # type: ignore[attr-defined]
    assert abs(tilted.forefoot_deg) == 4.0  # type: ignore[attr-defined]
