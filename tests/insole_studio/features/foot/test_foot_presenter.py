"""The foot stage without its window: corrections, undo, and the foot that is handed over."""

from __future__ import annotations

import json
import shutil
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from insole_core.errors import ReconstructionError
from insole_core.geometry.side import BOTH, Side
from insole_core.reconstruct.poses.pose_quality import DEFAULT_LIMITS
from insole_core.recording.box import Box
from insole_core.recording.hand_edits import NO_EDITS
from insole_core.recording.hand_edits_file import edits_path
from insole_core.recording.reader import read_session
from insole_core.workflows.scanned_feet import ScannedFoot
from insole_studio.document.foot_display import known_display
from insole_studio.features.foot.presenter import MAKING, FootStagePresenter
from insole_studio.features.foot.rows import FootMap, Limits, Mark, ViewRow, color_foot
from insole_studio.jobs import Jobs
from insole_studio.services.questions import OtherFoot

pytestmark = pytest.mark.one_window


class Intent:
    """A signal without Qt."""

    def __init__(self) -> None:
        self.heard: list[Callable[..., object]] = []

    def connect(self, slot: Callable[..., object]) -> None:
        self.heard.append(slot)

    def emit(self, *values: object) -> None:
        for slot in self.heard:
            slot(*values)


class FakePanel:
    """Remembers what is shown; its intents are there when asked for."""

    def __init__(self) -> None:
        self.shown: dict[str, Any] = {}
        self.intents: dict[str, Intent] = {}
        self.feet: list[Any] = []

    def __getattr__(self, name: str) -> Any:
        if name.startswith("show_"):
            return lambda *values: self.shown.__setitem__(name, values)
        return self.intents.setdefault(name, Intent())

    def show_foot(self, mesh: Any, coloring: Any) -> None:
        self.feet.append((mesh, coloring))

    @property
    def rows(self) -> dict[str, ViewRow]:
        return {row.name: row for row in self.shown["show_views"][0]}

    @property
    def marks(self) -> dict[str, Mark]:
        return {mark.id: mark for mark in self.shown["show_markers"][0]}

    @property
    def buttons(self) -> Any:
        return self.shown["show_buttons"][0]

    @property
    def sentences(self) -> str:
        return "\n".join(self.shown.get("show_sentences", [()])[0])


class Bench:
    """A presenter before a fake panel, and what it tells others."""

    def __init__(self, jobs: Jobs, session: Path, qtbot: QtBot) -> None:
        self.panel, self.session, self.jobs, self._qtbot = FakePanel(), session, jobs, qtbot
        self.handed: list[ScannedFoot] = []
        self.left: list[bool] = []
        self.needed = 0
        self.errors: list[Exception] = []
        self.limits = [DEFAULT_LIMITS]
        self.asked: list[str] = []
        self.alone: list[Side] = []
        self.shown: list[Side] = []
        self.answer = False
        self.answers: list[bool] = []
        """To the next questions; to those after them, `answer`."""
        self.presenter = FootStagePresenter(
            panel=self.panel,
            jobs=jobs,
            limits=DEFAULT_LIMITS,
            remember=self.limits.append,
            hand_over=self.handed.append,
            ask=self._ask,
            ask_alone=self._ask_alone,
            ask_side=self._ask_side,
            finished=self.left.append,
            needed_again=self._need,
            unreadable=self.errors.append,
        )

    def _need(self) -> None:
        self.needed += 1

    def _ask(self, sentence: str) -> bool:
        self.asked.append(sentence)
        return self.answers.pop(0) if self.answers else self.answer

    def _ask_side(self, sentence: str, shown: Side) -> OtherFoot:
        self.shown.append(shown)
        return OtherFoot.INSIST if self._ask(sentence) else OtherFoot.CANCEL

    def _ask_alone(self, sentence: str, side: Side) -> bool:
        self.alone.append(side)
        return self._ask(sentence)

    def until(self, is_ready: Callable[[], bool]) -> None:
        self._qtbot.waitUntil(is_ready)

    def settle(self) -> None:
        self.until(lambda: not self.jobs.is_running())

    def open(self, hand_over: bool = False) -> None:
        self.presenter.open(self.session, hand_over)
        self.settle()

    def poses(self) -> dict[str, Any]:
        work = self.presenter._work
        assert work is not None
        return {name: result.sensor2reference for name, result in work.results.items()}


@pytest.fixture
def bench(qapp: QApplication, qtbot: QtBot, tmp_path: Path, small_session: Path) -> Iterator[Bench]:
    session = tmp_path / "session.zip"
    shutil.copy(small_session, session)
    jobs = Jobs()
    yield Bench(jobs, session, qtbot)
    jobs.close()


@pytest.fixture
def opened(bench: Bench) -> Bench:
    """A session that is read and placed; its foot is not made."""
    bench.presenter.open(bench.session, hand_over=False)
    bench.until(lambda: bench.presenter._work is not None)
    bench.panel.cancel_requested.emit()
    return bench


@pytest.fixture
def made(bench: Bench) -> Bench:
    """A session and its foot."""
    bench.open()
    return bench


def test_a_session_is_shown_and_its_foot_made(made: Bench) -> None:
    assert list(made.panel.rows) == ["left", "right", "top"]
    left = made.panel.rows["left"]
    assert (left.found, left.used, left.on, left.trouble) == (12, 12, True, "")
    assert left.residual_mm is not None
    assert 0 < left.residual_mm[0] <= left.residual_mm[1] <= left.residual_mm[2] < 3
    assert left.displacement_mm is not None
    assert left.frames > 0
    assert made.panel.shown["show_session"][0] == "session"
    assert made.panel.buttons.go_on
    assert not made.panel.buttons.is_stale
    assert made.handed == []
    mesh, _ = made.panel.feet[-1]
    assert len(np.unique(mesh.colors, axis=0)) == 3


@pytest.mark.slow
def test_a_foot_that_was_opened_for_design_is_handed_over_once(bench: Bench) -> None:
    bench.open(hand_over=True)
    assert len(bench.handed) == 1
    assert bench.left == []
    bench.panel.go_on_requested.emit()
    assert len(bench.handed) == 1
    assert bench.left == [True]


def test_a_correction_is_live_kept_and_undone(opened: Bench) -> None:
    before = opened.poses()["left"]
    opened.panel.marker_toggled.emit("S3")
    assert opened.panel.marks["S3"].state == "excluded"
    assert opened.panel.rows["left"].used == 11
    assert "S3" in opened.panel.buttons.undo
    assert read_session(opened.session).edits.of("left").excluded == ("S3",)
    opened.panel.undo_requested.emit()
    np.testing.assert_array_equal(opened.poses()["left"], before)
    assert opened.panel.marks["S3"].state == "used"
    assert not edits_path(opened.session).exists()
    opened.panel.redo_requested.emit()
    assert opened.panel.marks["S3"].state == "excluded"
    opened.panel.marker_toggled.emit("S3")
    assert opened.presenter.edits == NO_EDITS


def test_a_marker_is_dragged_and_left_to_the_search_and_two_are_exchanged(opened: Bench) -> None:
    before, (u, v) = opened.poses()["left"], opened.panel.marks["S6"].pixel
    for step in (5.0, 10.0):
        opened.panel.marker_moved.emit("S6", (u + step, v))
        assert opened.panel.marks["S6"].pixel == (u + step, v)
    assert opened.presenter.edits == NO_EDITS
    opened.panel.marker_dropped.emit("S6", (u + 10, v))
    assert opened.panel.marks["S6"].by_hand
    assert opened.panel.marks["S6"].state == "unused"
    assert opened.panel.marks[""].pixel == (u, v)
    opened.panel.marker_released.emit("S6")
    np.testing.assert_array_equal(opened.poses()["left"], before)

    before, marks = opened.poses()["left"], opened.panel.marks
    for marker, other in (("S2", "S9"), ("S9", "S2")):
        opened.panel.marker_named.emit(marker, marks[other].pixel, False)
    assert opened.panel.marks["S2"].pixel == marks["S9"].pixel
    assert opened.panel.rows["left"].used == 10
    for marker in ("S2", "S9"):
        opened.panel.marker_named.emit(marker, marks[marker].pixel, False)
    np.testing.assert_allclose(opened.poses()["left"], before, atol=1e-6)


def test_regions_limit_the_search(opened: Bench) -> None:
    u, v = opened.panel.marks["S4"].pixel
    opened.panel.spot_ignored.emit((u, v))
    assert "S4" not in opened.panel.marks
    assert opened.panel.rows["left"].found == 11
    opened.panel.regions_cleared.emit()
    assert "S4" in opened.panel.marks
    opened.panel.region_searched.emit(((0.0, 0.0), (100.0, 0.0), (100.0, 100.0)))
    assert not opened.panel.rows["left"].is_used
    assert "no blue marker" in opened.panel.rows["left"].trouble
    opened.panel.marker_named.emit("S4", (u, v), False)
    assert opened.panel.marks["S4"].by_hand  # shown although there is no pose


@pytest.mark.slow
def test_a_view_is_left_out_and_the_foot_made_again(made: Bench) -> None:
    made.panel.view_switched.emit("right", False)
    assert not made.panel.rows["right"].on
    mesh, _ = made.panel.feet[-1]
    assert len(np.unique(mesh.colors, axis=0)) == 2
    made.panel.make_requested.emit()
    assert made.panel.buttons.cancel
    made.settle()
    assert "The view right is left out: it was switched off by hand." in made.panel.sentences
    made.panel.go_on_requested.emit()
    assert len(made.handed) == 1
    assert any("switched off" in warning for warning in made.handed[0].warnings)


@pytest.mark.slow
def test_going_on_with_corrections_makes_the_foot_first(made: Bench) -> None:
    made.panel.view_switched.emit("right", False)
    assert made.panel.buttons.is_stale
    made.panel.undo_requested.emit()
    assert not made.panel.buttons.is_stale
    made.panel.redo_requested.emit()
    made.panel.go_on_requested.emit()
    assert made.handed == []
    made.settle()
    assert len(made.handed) == 1
    assert made.left == [True]


@pytest.mark.slow
def test_a_foot_that_is_made_does_not_answer_for_a_session_opened_meanwhile(
    bench: Bench, tmp_path: Path
) -> None:
    """No patient gets the foot of the one before."""
    other = tmp_path / "other.zip"
    shutil.copy(bench.session, other)
    bench.presenter.open(bench.session, hand_over=True)
    bench.until(lambda: bench.jobs.is_running(MAKING))
    bench.presenter.open(other, hand_over=True)
    assert not bench.jobs.is_running(MAKING)
    bench.settle()
    assert [Path(handed.source.path).name for handed in bench.handed] == ["other.zip"]


def test_the_volume_is_changed_and_reset_and_cancel_answers_at_once(opened: Bench) -> None:
    recorded = opened.presenter.box
    for y in (-80.0, -60.0):
        opened.panel.box_edited.emit(Box((-70, y, -40), (70, 150, 160)))
    assert opened.panel.shown["show_box"][0].min_mm == (-70, -60, -40)
    mesh, _ = opened.panel.feet[-1]
    assert mesh.vertices[:, 1].min() >= -60
    opened.panel.undo_requested.emit()
    assert opened.presenter.box == recorded
    opened.panel.redo_requested.emit()
    opened.panel.box_reset.emit()
    assert opened.presenter.box == recorded

    opened.panel.make_requested.emit()
    opened.panel.cancel_requested.emit()
    assert not opened.jobs.is_running()
    assert opened.panel.shown["show_progress"] == (0.0, "")
    assert opened.panel.buttons.make


def test_every_map_has_a_value_for_every_vertex_and_the_foot_is_handed_on_as_measured(
    made: Bench,
) -> None:
    """What was filled for display is marked; the design can show the foot at once."""
    for kind in FootMap:
        made.panel.map_chosen.emit(kind)
        mesh, coloring = made.panel.feet[-1]
        assert made.panel.shown["show_map"][0] is kind
        if coloring is not None:
            assert coloring.values.shape == (len(mesh.vertices),)
            assert coloring.limits[0] < coloring.limits[1]
    _, moved = made.panel.feet[-1]
    assert moved.signed
    assert 0.02 < np.nanmean(np.abs(moved.values)) < 1
    made.panel.map_chosen.emit(FootMap.AGREEMENT)
    _, spread = made.panel.feet[-1]
    assert 0 < np.nanmedian(spread.values) < 3
    assert np.isnan(spread.values).any()

    made.panel.map_chosen.emit(FootMap.SKIN)
    skin, coloring = made.panel.feet[-1]
    assert coloring is None
    made.panel.map_chosen.emit(FootMap.CONFIDENCE)
    mesh, coloring = made.panel.feet[-1]
    unknown = np.isnan(coloring.values)[mesh.triangles].all(axis=1)
    assert coloring.missing == "not measured"
    assert 0.005 < mesh.triangle_areas_mm2[unknown].sum() / mesh.area_mm2 < 0.15
    assert mesh.area_mm2 == pytest.approx(skin.area_mm2)
    made.panel.map_chosen.emit(FootMap.AGREEMENT)
    _, spread = made.panel.feet[-1]
    assert spread.missing == ""  # there it is grey also where only one view sees the foot
    made.panel.go_on_requested.emit()
    (handed,) = made.handed
    assert len(handed.foot.mesh.triangles) != len(skin.triangles)  # it is handed on as measured
    assert handed.foot.derived.known("landmarks", ()) is not None
    assert known_display(handed.foot) is not None


def test_the_map_of_deviations_says_how_much_infrared_decides() -> None:
    def title(share: float) -> str:
        made = SimpleNamespace(deviation_mm=np.array([0.2, 0.9]), infrared_share=share)
        coloring = color_foot(FootMap.CONFIDENCE, cast("Any", SimpleNamespace(reconstruction=made)))
        assert coloring is not None
        assert coloring.values.tolist() == [0.2, 0.9]
        return coloring.title

    assert title(0.0) == "Standard deviation"
    assert title(0.913) == "Standard deviation, 91% by infrared"


def test_a_limit_refuses_a_view_and_names_its_markers(opened: Bench) -> None:
    opened.panel.limits_edited.emit(Limits(4.0, 1.0, 0.7))
    assert not opened.panel.rows["top"].is_used
    assert "mm uncertain at the foot" in opened.panel.rows["top"].trouble
    assert opened.panel.rows["top"].found == 8
    assert opened.limits[-1].displacement_mm == 0.7
    assert opened.panel.rows["top"].frames > 0
    assert opened.panel.sentences.startswith("View top: its markers leave the pose")
    opened.panel.view_chosen.emit("top")
    assert "A1" in opened.panel.marks


def test_no_view_left_is_told_and_can_be_mended(opened: Bench) -> None:
    for name in ("left", "right", "top"):
        opened.panel.view_switched.emit(name, False)
    assert "No view is placed" in opened.panel.shown["show_nothing"][0]
    opened.panel.make_requested.emit()
    opened.settle()
    assert "none of its views can be used" in opened.panel.sentences
    opened.panel.view_switched.emit("left", True)
    assert opened.panel.sentences == ""
    assert opened.panel.buttons.make


def test_corrections_that_cannot_be_kept_are_told(opened: Bench) -> None:
    edits_path(opened.session).mkdir()
    opened.panel.marker_toggled.emit("S3")
    assert "cannot be written" in opened.panel.sentences
    assert opened.panel.marks["S3"].state == "excluded"


def with_manifest(session: Path, folder: Path, change: Callable[[dict[str, Any]], None]) -> Path:
    """Return a copy of a session in a folder, with another manifest."""
    with zipfile.ZipFile(session) as archive:
        archive.extractall(folder)
    manifest = folder / "manifest.json"
    values = json.loads(manifest.read_text())
    change(values)
    manifest.write_text(json.dumps(values))
    return folder


@pytest.fixture
def other_side(bench: Bench, tmp_path: Path) -> Bench:
    """The session, declared as that of the other foot."""

    def change(manifest: dict[str, Any]) -> None:
        manifest["side"] = "right"

    bench.session = with_manifest(bench.session, tmp_path / "session", change)
    return bench


@pytest.mark.slow
def test_a_foot_that_looks_like_the_other_is_asked_about(other_side: Bench) -> None:
    other_side.open(hand_over=True)
    (sentence,) = other_side.asked
    assert "left" in sentence
    assert other_side.shown == [Side.LEFT]
    assert other_side.handed == []
    assert sentence in other_side.panel.sentences
    other_side.answer = True
    other_side.panel.make_requested.emit()
    other_side.until(lambda: bool(other_side.handed))
    assert other_side.handed[0].foot.side.value == "right"


def test_a_session_that_cannot_be_read(bench: Bench, tmp_path: Path) -> None:
    bench.presenter.open(tmp_path / "absent", hand_over=True)
    bench.settle()
    assert "does not exist" in str(bench.errors[0])


def test_nothing_can_be_pressed_before_there_is_a_session(bench: Bench) -> None:
    assert not bench.panel.buttons.make
    assert not bench.panel.buttons.go_on
    bench.panel.undo_requested.emit()
    bench.panel.view_chosen.emit("left")
    bench.panel.marker_moved.emit("S1", (1.0, 1.0))
    assert bench.presenter.edits == NO_EDITS


def test_a_stage_that_was_left_comes_back_when_its_foot_cannot_be_made(
    opened: Bench, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_args: object, **_options: object) -> None:
        raise ReconstructionError("No view can be used; correct the markers.")

    monkeypatch.setattr("insole_studio.features.foot.presenter.make_feet", fail)
    opened.settle()
    opened.presenter.make()
    opened.presenter.go_on()
    assert opened.left == [False]  # left, while its foot is still made
    opened.settle()
    assert opened.needed == 1
    assert opened.panel.sentences == "No view can be used; correct the markers."
    opened.presenter.make()
    opened.settle()
    assert opened.needed == 1  # nobody had left


@pytest.fixture
def both(qapp: QApplication, qtbot: QtBot, tmp_path: Path, small_session: Path) -> Iterator[Bench]:
    """A session of both feet, which are made in one go."""
    session = tmp_path / "both.zip"
    shutil.copy(small_session.with_name("both_small.zip"), session)
    jobs = Jobs()
    bench = Bench(jobs, session, qtbot)
    bench.open(hand_over=True)
    yield bench
    jobs.close()


@pytest.mark.slow
def test_both_feet_are_handed_over_in_one_go_and_corrected_apart(both: Bench) -> None:
    assert both.errors == []
    assert [scanned.foot.side for scanned in both.handed] == [Side.LEFT, Side.RIGHT]
    left_mm, right_mm = (scanned.foot.length_mm for scanned in both.handed)
    assert left_mm > right_mm + 10  # as simulated
    assert not any(scanned.is_alone for scanned in both.handed)
    assert both.panel.shown["show_session"] == ("both", (Side.LEFT, Side.RIGHT))
    assert both.panel.shown["show_side"] == (Side.LEFT,)

    both.panel.foot_chosen.emit(Side.RIGHT)
    assert both.panel.shown["show_side"] == (Side.RIGHT,)
    mesh, _ = both.panel.feet[-1]
    assert abs(mesh.vertices[:, 0].mean()) < 30  # in the foot's own frame, not between the two
    box = Box((-60, -150, -20), (60, 150, 150))
    both.panel.box_edited.emit(box)
    assert both.presenter.box == box
    assert read_session(both.session).edits.volumes == {Side.RIGHT: box}
    assert both.panel.buttons.is_stale
    both.panel.foot_chosen.emit(Side.LEFT)
    assert both.presenter.box != box


@pytest.mark.slow
def test_if_a_foot_is_missing_the_other_can_be_made_alone(
    bench: Bench, tmp_path: Path, small_session: Path
) -> None:
    def move_left_place(manifest: dict[str, Any]) -> None:
        manifest["reference_frame"]["feet"]["left"]["origin_mm"][0] = -400.0

    both_feet = small_session.with_name("both_small.zip")
    bench.session = with_manifest(both_feet, tmp_path / "missing", move_left_place)
    bench.open(hand_over=True)
    assert len(bench.asked) == 1
    assert "no left foot is in its place" in bench.asked[0]
    assert bench.alone == [Side.RIGHT]
    assert bench.handed == []
    assert not bench.panel.buttons.go_on
    bench.answer = True
    bench.panel.make_requested.emit()
    bench.until(lambda: bool(bench.handed))
    assert [scanned.foot.side for scanned in bench.handed] == [Side.RIGHT]
    assert not bench.handed[0].is_alone  # the capture has a place for the other one
    assert bench.panel.shown["show_side"] == (Side.RIGHT,)
    assert bench.panel.buttons.go_on
    assert not bench.panel.buttons.is_stale


@pytest.mark.slow
@pytest.mark.parametrize("insists", [True, False])
def test_the_foot_that_is_made_alone_is_asked_about_once_and_keeps_the_other(
    bench: Bench, tmp_path: Path, small_session: Path, insists: bool
) -> None:
    """A left foot stands in the place of the right one, and none in its own."""

    def exchange_places(manifest: dict[str, Any]) -> None:
        places = manifest["reference_frame"]["feet"]
        places["right"]["origin_mm"] = list(places["left"]["origin_mm"])
        places["left"]["origin_mm"][0] = -400.0

    both_feet = small_session.with_name("both_small.zip")
    bench.session = with_manifest(both_feet, tmp_path / "exchanged", exchange_places)
    bench.answers = [True, insists]
    bench.open(hand_over=True)
    missing, doubt = bench.asked
    assert "no left foot is in its place" in missing
    assert "looks like a left foot" in doubt
    assert bench.shown == []  # the place says which foot it is: it cannot be taken as the other
    assert [scanned.foot.side for scanned in bench.handed] == ([Side.RIGHT] if insists else [])
    assert (doubt in bench.panel.sentences) is not insists
    assert bench.panel.shown["show_session"][1] == (Side.LEFT, Side.RIGHT)
    work = bench.presenter._work
    assert work is not None
    assert work.opened.session.manifest.side == BOTH
