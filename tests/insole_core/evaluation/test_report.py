from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from simulated_board import COLOR_CAMERA, board_poses, sight
from simulated_device import CAMERA, DISPARITY, WALLS, SimulatedDevice, smooth_distortion

from insole_core.calibration.boards.board import Chequerboard
from insole_core.calibration.boards.intrinsics import calibrate_camera
from insole_core.calibration.boards.stereo import calibrate_stereo
from insole_core.calibration.markers.reference_file import (
    check_reference_system,
    load_reference_system,
)
from insole_core.calibration.walls.disparity_fit import fit_linear_inverse
from insole_core.calibration.walls.distortion import calibrate_distortion
from insole_core.errors import OutputError
from insole_core.evaluation.alignment import Misalignment
from insole_core.evaluation.artefact import ArtefactEvaluation
from insole_core.evaluation.calibration_sections import (
    camera_section,
    disparity_section,
    distortion_section,
    reference_section,
    stereo_section,
)
from insole_core.evaluation.distances import evaluate_object
from insole_core.evaluation.evaluation_sections import (
    alignment_section,
    artefact_section,
    noise_section,
    object_section,
    resolution_section,
    wall_section,
)
from insole_core.evaluation.noise import Noise, WarmUp
from insole_core.evaluation.report import (
    Number,
    Plot,
    Report,
    ReportSection,
    Share,
    Table,
    report_json,
    section_lines,
    with_limits,
)
from insole_core.evaluation.report_files import write_html, write_json, write_pdf
from insole_core.evaluation.resolution import evaluate_resolution
from insole_core.evaluation.wall import NoCorrection, wall_errors
from insole_core.geometry.transforms import rigid, transform
from insole_core.resources import resource_path


@pytest.fixture(scope="module")
def report() -> Report:
    board = Chequerboard(10, 7, 30)
    poses = board_poses(1, 8, np.array([135.0, 90, 0]))
    color = [sight(f"c{i}", board, p, COLOR_CAMERA, 0.1, i) for i, p in enumerate(poses)]
    shift = rigid(np.eye(3), np.array([25.0, 0, 0]))
    depth = [sight(f"d{i}", board, shift @ p, CAMERA, 0.1, i) for i, p in enumerate(poses)]
    device = SimulatedDevice(smooth_distortion(1, 2.0), serial="A<1>")
    captures = [device.capture(plane, 1) for plane in WALLS[:3]]
    distortion = calibrate_distortion(captures, CAMERA, DISPARITY)
    known = np.array([600.0, 800, 1000])
    system = load_reference_system(resource_path("reference_systems/lego-20.json"))
    corner = np.array([[0.0, 0, 0], [90, 0, 0], [0, 60, 0], [0, 0, 30]])
    errors = wall_errors(
        captures,
        {"raw": NoCorrection(), "corrected": distortion.correction},
        CAMERA,
        DISPARITY,
    )
    return Report(
        "Sensor report",
        "A<1>",
        "2026-11-21T10:00:00Z",
        (
            camera_section(calibrate_camera(color)),
            stereo_section(calibrate_stereo(depth, color, CAMERA, COLOR_CAMERA).stereo),
            disparity_section(fit_linear_inverse(DISPARITY.raw(known), known)),
            distortion_section(distortion),
            reference_section(system, check_reference_system(system)),
            wall_section(errors),
            resolution_section([evaluate_resolution(c, CAMERA, DISPARITY) for c in captures]),
            alignment_section([Misalignment(800, 0.5, 5, 0.1, 0.1, 6)]),
            object_section(evaluate_object(list("abcd"), corner, transform(shift, corner) * 1.01)),
            artefact_section(ArtefactEvaluation(3.0, 2.0, -0.4, 0.7, 2.5, 1.5)),
            noise_section(
                Noise(10, 0.5, 1.0, 0.02), WarmUp((0, 60, 120), (803, 801, 800), -3, float("inf"))
            ),
        ),
    )


@pytest.mark.slow
def test_html_holds_everything(report: Report, tmp_path: Path) -> None:
    write_html(report, tmp_path / "report.html")
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "A&lt;1&gt;" in page
    assert page.count("<h2>") == len(report.sections)
    assert page.count("data:image/png;base64,") == sum(len(s.plots) for s in report.sections)
    assert 'src="http' not in page


def pages(path: Path) -> int:
    content = path.read_bytes()
    assert content.startswith(b"%PDF")
    return content.count(b"/Type /Page ") + content.count(b"/Type /Page\n")


@pytest.mark.slow
def test_pdf_has_the_pages(report: Report, tmp_path: Path) -> None:
    write_pdf(report, tmp_path / "report.pdf")
    plots = sum(len(section.plots) for section in report.sections)
    assert plots / 3 < pages(tmp_path / "report.pdf") <= plots


def test_a_short_evaluation_is_one_page(tmp_path: Path) -> None:
    section = alignment_section([Misalignment(800, 0.5, -0.001, 0.1, 0.1, 6)])
    write_pdf(Report(section.title, "A", "now", (section,)), tmp_path / "a.pdf")
    assert pages(tmp_path / "a.pdf") == 1
    assert section.tables[0].rows[0][2] == "+0.00"


def test_shares_are_read_in_percent() -> None:
    (judged,) = with_limits(ReportSection("s", "S", (Share("a", "A", 0.034),)), {"a": 0.02}).numbers
    assert judged.text == "3.4 %"
    assert judged.verdict == "failed (limit 2 %)"


def test_json_holds_the_numbers(report: Report, tmp_path: Path) -> None:
    write_json(report, tmp_path / "report.json")
    values = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert values["serial"] == "A<1>"
    assert values["sections"]["object"]["numbers"]["max_abs_mm"]["unit"] == "mm"
    assert values["sections"]["noise"]["numbers"]["settled_after_s"]["value"] is None
    assert len(values["sections"]["object"]["tables"]["Distances"]) == 6
    assert values["passed"] is True


def test_the_unit_of_a_table_is_for_people_alone() -> None:
    table = Table("Offset", ("x",), (("1",),), "px")
    section = ReportSection("s", "S", tables=(table,))
    assert "Offset, px" in section_lines(section)
    tables = report_json(Report("t", "s", "now", (section,)))["sections"]["s"]["tables"]
    assert tables == {"Offset": [{"x": "1"}]}


def test_limits_pass_and_fail_by_size_not_sign() -> None:
    section = ReportSection("s", "S", (Number("a", "A", -2.0, "mm"), Number("b", "B", 1.0, "mm")))
    judged = with_limits(section, {"a": 1.5, "b": 1.5})
    assert [number.passed for number in judged.numbers] == [False, True]
    result = Report("t", "s", "now", (judged,))
    assert not result.passed
    assert [number.label for number in result.failed] == ["A"]
    assert report_json(result)["sections"]["s"]["numbers"]["a"]["passed"] is False
    assert judged.numbers[0].verdict == "failed (limit 1.5 mm)"
    assert section.numbers[0].verdict == ""


def test_a_place_that_cannot_be_written(report: Report, tmp_path: Path) -> None:
    for write in (write_html, write_pdf, write_json):
        with pytest.raises(OutputError, match="folder does not exist"):
            write(report, tmp_path / "none" / "report")


def test_each_plot_is_drawn_once_for_all_forms(tmp_path: Path) -> None:
    drawn: list[Figure] = []
    plot = Plot("Noise", drawn.append)
    section = ReportSection("noise", "Noise", plots=(plot,))
    report = Report("Noise", "A", "2026-01-01T00:00:00+00:00", (section,))
    write_html(report, tmp_path / "r.html")
    write_pdf(report, tmp_path / "r.pdf")
    assert len(drawn) == 1
