"""The user compares a foot with its insole, and with a surface from a file."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtWidgets import QApplication, QWidget
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import CaseRecord, FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.formats.stl import write_stl
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.insole.build import build_insole
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.solid import insole_solid
from insole_core.workflows.compare_case import REPORT_SUFFIXES
from insole_studio.document.case import Case
from insole_studio.features.compare.rows import MAPS, RESULT, SURFACES
from insole_studio.features.compare.stage import CompareStage
from insole_studio.scene.point_picker import PointPicker
from insole_studio.scene.pointer import Phase, PointerEvent
from insole_studio.scene.view_camera import Preset, Subject, ViewCamera, look

NOWHERE = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
B2A = rigid(rotation_about(np.array([0.0, 0, 1]), 3.0), np.array([6.0, -4.0, 1.25]))


@pytest.fixture
def case(make_foot: Callable[[Side], Foot]) -> Case:
    built = Case()
    foot = FootRecord.begun(make_foot(Side.LEFT), NOWHERE, InsoleDesign(Side.LEFT, grid_mm=2.0))
    built.open(CaseRecord.of_foot(foot), None)
    return built


@pytest.fixture
def solid(case: Case) -> TriangleMesh:
    foot, design = case.record.foot, case.record.design
    assert foot is not None
    assert design is not None
    return insole_solid(build_insole(foot, design))


class Chosen:
    """Answers the questions for paths."""

    def __init__(self) -> None:
        self.path: Path | None = None

    def source(self, _kind: str) -> Path | None:
        return self.path

    def report(self) -> Path | None:
        return self.path


@pytest.fixture
def chosen() -> Chosen:
    return Chosen()


@pytest.fixture
def stage(qapp: QApplication, qtbot: QtBot, case: Case, chosen: Chosen) -> Iterator[CompareStage]:
    built = CompareStage(case, False, ask_source=chosen.source, ask_report=chosen.report)
    built.show()
    yield built
    built.close()
    built.deleteLater()


@pytest.fixture
def settle(qtbot: QtBot, stage: CompareStage) -> Callable[[], None]:
    def wait() -> None:
        qtbot.waitUntil(lambda: not stage.jobs.is_running())

    wait()
    return wait


def lower_file(solid: TriangleMesh, path: Path) -> Path:
    """Write the insole as it lies in another frame."""
    moved = TriangleMesh((solid.vertices - B2A[:3, 3]) @ B2A[:3, :3], solid.triangles)
    write_stl(moved, path)
    return path


def number(stage: CompareStage, text: str) -> float:
    figures = stage.view.figures
    texts = [figures.itemAt(i).widget().text() for i in range(figures.count())]
    return float(texts[texts.index(text) + 1].removesuffix(" mm"))


@pytest.mark.slow
def test_insole_and_foot_of_the_case_are_compared_at_once_and_reported(
    stage: CompareStage, settle: Callable[[], None], chosen: Chosen, tmp_path: Path
) -> None:
    """Nothing but the report changes by choosing no file, nor by a name of no known form."""
    before = number(stage, "Largest")
    assert number(stage, "Mean") < 0.3
    assert stage.view.tabs.currentIndex() == RESULT
    source = stage.view.sources["b"].currentText()
    stage.view.source_chosen.emit("b", "folder")
    assert stage.view.sources["b"].currentText() == source
    for suffix in REPORT_SUFFIXES:
        chosen.path = tmp_path / f"d{suffix}"
        stage.view.save.click()
        settle()
        assert chosen.path.stat().st_size > 100
    assert json.loads((tmp_path / "d.json").read_text())["unit"] == "mm"
    chosen.path = tmp_path / "d.docx"
    stage.view.save.click()
    settle()
    assert "let it end in .pdf" in stage.view.error.text()
    stage.view.median.setValue(6)
    settle()
    assert number(stage, "Largest") != before


@pytest.mark.slow
def test_maps_are_drawn_once_they_are_looked_at(
    stage: CompareStage, settle: Callable[[], None]
) -> None:
    shown = stage.view.map_picture
    ground = colors_of(shown)
    stage.view.show_tab(MAPS)
    settle()
    drawn = colors_of(shown)
    assert len(drawn) > 10 * len(ground)
    stage.view.show_tab(RESULT)
    stage.view.show_tab(MAPS)
    assert not stage.jobs.is_running()
    stage.view.source_chosen.emit("b", "")  # there is nothing left to compare
    assert colors_of(shown) == ground


def colors_of(widget: QWidget) -> set[int]:
    picture = widget.grab().toImage()
    return {picture.pixel(x, y) for x in range(0, picture.width(), 3)
            for y in range(0, picture.height(), 3)}  # fmt: skip


@pytest.mark.slow
def test_the_other_foot_and_its_insole_are_mirrored_and_said(
    stage: CompareStage,
    settle: Callable[[], None],
    case: Case,
    make_foot: Callable[[Side], Foot],
) -> None:
    """The made-up feet are mirror images."""
    other = FootRecord.begun(make_foot(Side.RIGHT), NOWHERE, InsoleDesign(Side.RIGHT, grid_mm=2.0))
    case.apply(other, "Open")
    for kind in ("foot", "insole"):
        stage.view.source_chosen.emit("a", f"0 {kind} left")
        stage.view.source_chosen.emit("b", f"0 {kind} right")
        settle()
        assert number(stage, "Largest") < 0.3
        assert (
            f"Right {kind} is of the other foot, so that it is mirrored."
            in stage.view._notes.text()
        )
    stage.view.source_chosen.emit("b", "0 insole left")
    settle()
    assert stage.view._notes.text() == ""
    assert number(stage, "Largest") == 0.0


@pytest.mark.slow
def test_two_visits_differ_by_what_the_foot_has_changed(
    qapp: QApplication, qtbot: QtBot, case: Case, chosen: Chosen
) -> None:
    older = case.record
    foot = older.foot
    assert foot is not None
    x, y = (foot.mesh.vertices[:, :2] - [5.0, 120.0]).T
    is_sole = foot.mesh.vertex_normals[:, 2] < 0
    swollen = foot.mesh.vertices.copy()
    swollen[:, 2] -= np.where(is_sole, 2.0 * np.exp(-(x**2 + y**2) / 50.0), 0.0)
    changed = replace(foot, mesh=replace(foot.mesh, vertices=swollen))
    newer = CaseRecord.of_foot(FootRecord.begun(changed, NOWHERE, older.design))
    stage = CompareStage(
        case, False, ask_source=chosen.source, ask_report=chosen.report,
        visits=(("Today", newer), ("Before", older)),
    )  # fmt: skip
    qtbot.addWidget(stage)
    qtbot.waitUntil(lambda: not stage.jobs.is_running())
    assert number(stage, "Largest") == pytest.approx(2.0, abs=0.1)
    assert number(stage, "Mean") < 0.1
    stage.view.source_chosen.emit("a", "1 foot left")
    qtbot.waitUntil(lambda: not stage.jobs.is_running())
    assert number(stage, "Largest") == 0.0
    stage.close()


@pytest.mark.slow
def test_surface_from_a_file_is_fitted_or_laid_by_picked_points(
    stage: CompareStage, settle: Callable[[], None], solid: TriangleMesh, tmp_path: Path,
    chosen: Chosen,
) -> None:  # fmt: skip
    """A report does not take its place, nor by a link."""
    untouched = stage.view.models["a"]
    untouched.look_from(Preset.DORSAL)
    turned = untouched.scene.camera
    file = chosen.path = lower_file(solid, tmp_path / "insole Fuß.stl")
    stage.view.source_chosen.emit("b", "file")
    settle()
    assert untouched.scene.camera is turned
    assert number(stage, "Largest") < 0.05
    assert stage.view.sources["b"].currentText() == file.name

    before = file.read_bytes()
    chosen.path = tmp_path / "link.ply"
    chosen.path.symlink_to(file)
    stage.view.save.click()
    settle()
    assert "is read to make the result" in stage.view.error.text()
    assert file.read_bytes() == before

    stage.view.alignment_chosen.emit("picked")
    assert stage.view.tabs.currentIndex() == SURFACES
    assert not stage.view.save.isEnabled()
    for place in solid.vertices[[40, 900, 2500]]:
        stage.view.point_picked.emit("a", place)
        stage.view.point_picked.emit("b", B2A[:3, :3].T @ (place - B2A[:3, 3]))
    assert "3 on A, 3 on B" in stage.view.hint.text()
    settle()
    assert number(stage, "Largest") < 0.05
    stage.view.take_back.click()
    assert "3 on A, 2 on B" in stage.view.hint.text()
    assert not stage.view.save.isEnabled()


@pytest.mark.slow
def test_surfaces_without_dots_or_overlap_are_one_sentence(
    stage: CompareStage, settle: Callable[[], None], solid: TriangleMesh, tmp_path: Path
) -> None:
    stage.view.alignment_chosen.emit("dots")
    settle()
    assert "pick the points instead" in stage.view.error.text()
    far = TriangleMesh(solid.vertices + np.array([900.0, 0, 0]), solid.triangles)
    write_stl(far, tmp_path / "far.stl")
    stage.view.alignment_chosen.emit("none")
    stage.presenter.choose_path("b", tmp_path / "far.stl")
    settle()
    assert "too little to compare" in stage.view.error.text()
    assert not stage.view.tabs.isTabEnabled(RESULT)


def test_only_a_click_picks() -> None:
    picked: list[np.ndarray] = []
    picker = PointPicker(picked.append)
    shown = look(ViewCamera(), Subject.INSOLE, Side.LEFT, (400, 400))

    def at(phase: Phase, x: float, place: np.ndarray | None) -> PointerEvent:
        return PointerEvent(phase, Subject.INSOLE, shown, (x, 100.0), place)

    place = np.array([1.0, 2.0, 3.0])
    assert not picker.press(at(Phase.PRESS, 100, place))
    picker.is_on = True
    assert not picker.press(at(Phase.PRESS, 100, None))
    for end in (101, 140):
        assert picker.press(at(Phase.PRESS, 100, place))
        picker.release(at(Phase.RELEASE, end, place))
    assert len(picked) == 1
