"""The reference foot: what is printed fits its papers, and its capture proves the chain."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
import trimesh
from read_pdf import text_of_pdf

from insole_core.calibration.markers.reference_file import (
    check_reference_system,
    load_reference_system,
)
from insole_core.errors import CalibrationError
from insole_core.evaluation.printed_body import PrintedBar
from insole_core.evaluation.printed_markers import check_print
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about, transform
from insole_core.reconstruct.markers.marker_observation import MarkerObservation
from insole_core.reconstruct.result import ViewResult
from insole_core.recording.session import ReferenceSystem
from insole_core.recording.writer import write_session
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.known_bodies import printed_foot
from insole_core.simulate.reference_foot import (
    BAR_MM,
    BED_MM,
    FILM_MM,
    ReferenceFoot,
    reference_foot,
)
from insole_core.solids.simplification import to_manifold
from insole_core.workflows.calibration.reference_foot_files import known_reference_foot
from insole_studio.cli.main import run

SIZES, SKEW_DEG = np.array([1.02, 1.015, 0.99]), 0.5


FORM_WIDTHS_MM = [77.131, 140.784, 192.371, 201.522, 174.797, 130.268]
"""Across every 30° from +x."""
FORM_SECTIONS_MM2 = {
    2.0: 1306.0,
    6.0: 6168.2,
    12.0: 9974.0,
    25.0: 11073.0,
    60.0: 10350.9,
    100.0: 9588.7,
}
"""By their height above the lowest point, mm."""


def bar_of(sizes: FloatArray, skew_deg: float) -> PrintedBar:
    """The bar of a print of another size, askew, as callipers read it."""
    x, y, z = np.array(BAR_MM) * sizes
    lean = math.radians(skew_deg)
    corner, along = y * np.array([math.sin(lean), math.cos(lean)]), np.array([x, 0.0])
    first, second = (float(np.linalg.norm(corner + side)) for side in (along, -along))
    return PrintedBar(BAR_MM, (x, y, z), (first, second))


def readings() -> list[float]:
    """What callipers read of the bar of a print that is too large and askew."""
    bar = bar_of(SIZES, SKEW_DEG)
    return [*bar.edges_mm, *bar.diagonals_mm]


def misprinted() -> ReferenceFoot:
    return reference_foot().printed(bar_of(SIZES, SKEW_DEG))


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reference") / "foot"
    assert run(["evaluate", "reference-foot", str(folder)]) == 0
    return folder


def test_the_print_is_one_solid_for_a_cheap_printer_with_its_sole_up(files: Path) -> None:
    body = trimesh.load_mesh(files / "reference-foot.stl")
    assert body.is_watertight
    assert body.body_count == 1
    assert (body.bounds[0] > -1e-3).all()
    assert (body.extents < BED_MM).all()
    certificate = json.loads((files / "certificate.json").read_text())
    assert body.extents == pytest.approx(certificate["size_mm"], abs=0.06)
    assert body.volume / 1000 == pytest.approx(
        certificate["volume_cm3"]["reference-foot.stl"], rel=1e-3
    )
    # The foot stands on its leg: what is highest beside the posts is its sole, the toes ahead.
    middle = body.bounds.mean(axis=0)
    sole = body.vertices[np.abs(body.vertices[:, 0] - middle[0]) < 45]
    assert np.ptp(sole[sole[:, 2] > 90, 1]) == pytest.approx(
        certificate["measures_mm"]["length"], abs=15
    )
    # A left one: seen with the toes up and the sole towards one, the hallux is on the left.
    toes = sole[(sole[:, 2] > 110) & (sole[:, 1] < 20)]
    assert toes[:, 0].mean() > middle[0]


def test_flat_faces_of_the_print_lie_where_the_certificate_says(files: Path) -> None:
    body = trimesh.load_mesh(files / "reference-foot.stl")
    certificate = json.loads((files / "certificate.json").read_text())
    system = load_reference_system(files / "reference-system.json")
    assert not any(check.problems for check in check_reference_system(system))
    for marker in system.markers:
        x, y, z = marker.position_mm
        at = np.array([x + 106, 112 - y, 136 - z])
        _, away, _ = trimesh.proximity.closest_point_naive(body, [at])
        assert away[0] == pytest.approx(FILM_MM, abs=1e-3), marker.id
    told = {one["between"]: one["mm"] for one in certificate["control_lengths"]}
    assert told["ends of the plate"] == pytest.approx(body.extents[1], abs=1e-3)
    assert told["sides of the plate"] == pytest.approx(body.extents[0], abs=1e-3)
    assert told["underside of the plate and end of S5"] == pytest.approx(body.extents[2], abs=1e-3)
    bar = trimesh.load_mesh(files / "scale-bar.stl")
    assert bar.is_watertight
    assert bar.extents == pytest.approx(certificate["bar_mm"])
    paper = text_of_pdf(files / "certificate.pdf")
    assert "reference-foot-1" in paper
    assert "128.06" in paper
    assert "A8" in paper


def test_earlier_files_are_replaced_and_those_of_others_are_not(files: Path, last_line) -> None:
    assert run(["evaluate", "reference-foot", str(files)]) == 0
    (files / "notes.txt").write_text("mine")
    try:
        assert run(["evaluate", "reference-foot", str(files)]) != 0
        assert "notes.txt" in last_line()
    finally:
        (files / "notes.txt").unlink()


def test_the_form_is_the_one_that_was_printed_before() -> None:
    """Clinics keep the print: a changed form needs another name and version."""
    form = reference_foot().form
    turn = np.radians(np.arange(0, 180, 30))
    across = np.stack([np.cos(turn), np.sin(turn), np.zeros_like(turn)])
    widths = np.ptp(form.vertices @ across, axis=0)
    assert widths == pytest.approx(FORM_WIDTHS_MM, abs=0.02)
    sections = {height: to_manifold(form).slice(height).area() for height in FORM_SECTIONS_MM2}
    assert sections == pytest.approx(FORM_SECTIONS_MM2, rel=1e-3)


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A print that is up to 2 % too large and askew by half a degree, captured like a foot."""
    options = SimulationOptions(
        seed=3, body=printed_foot(misprinted()), distance_mm=700, frames=2, color_size=(640, 480)
    )
    folder = tmp_path_factory.mktemp("chain") / "print"
    write_session(simulate_session(options).session, folder)
    return folder


def test_the_readings_of_the_bar_put_the_truth_where_the_print_is(
    session: Path, tmp_path: Path
) -> None:
    reports = [tmp_path / "proof.json", tmp_path / "proof.pdf"]
    call = ["evaluate", "chain", str(session), "--body", "reference-foot", "--callipers"]
    call += [f"{one:.2f}" for one in readings()]
    assert run([*call, "--report", *map(str, reports)]) == 0
    section = json.loads(reports[0].read_text())["sections"]["reference_foot"]
    numbers = {key: one["value"] for key, one in section["numbers"].items()}
    assert numbers["mean_abs_mm"] < 0.5
    assert numbers["best_place_mean_abs_mm"] < numbers["mean_abs_mm"] + 0.01
    assert numbers["place_mm"] < 0.8
    assert abs(numbers["size_mm"]) < 1.0
    assert numbers["missing_share"] < 0.1
    assert "x +2.00 %, y +1.50 %, z -1.00 %, skew +0.50°" in section["remarks"][0]
    assert "page 2" not in text_of_pdf(reports[1])


def surface_of(form: TriangleMesh) -> TriangleMesh:
    return form.part(form.vertices[:, 2] < 112)


def test_a_body_that_stands_elsewhere_among_its_markers_is_told() -> None:
    known = known_reference_foot(None)
    form = reference_foot().form
    known.find(surface_of(form))
    step = rigid(rotation_about(np.array([0.0, 0.0, 1.0]), 3.0), np.array([4.0, 3.0, 0.0]))
    with pytest.raises(CalibrationError, match=r"stands 5\.\d mm and 3\.0° from its place"):
        known.find(surface_of(form.transformed(step)))


def test_a_print_that_nobody_measured_is_told() -> None:
    form = reference_foot().form
    middle = form.bounds_mm.mean(axis=0)
    grown = form.moved(middle + 1.015 * (form.vertices - middle))
    with pytest.raises(CalibrationError, match=r"\+1\.5 % off that size; measure the bar"):
        known_reference_foot(None).find(surface_of(grown))


def seen(system: ReferenceSystem, depth_scale: float = 1.0) -> list[ViewResult]:
    """Markers as three sensors measure them, each from where it believes to stand."""
    turn = rigid(rotation_about(np.array([0.0, 0.6, 0.8]), 0.5), np.array([1.0, -2.0, 0.5]))
    views = []
    for name, face in (("left", "sole"), ("right", "sole"), ("top", "achilles")):
        fixes = tuple(
            MarkerObservation(one.id, (0.0, 0.0), tuple(transform(turn, place)), 0.3, used=True)
            for one in system.markers
            if one.face == face
            for place in [np.array(one.position_mm)]
        )
        views.append(ViewResult(name, used=True, fixes=fixes, depth_scale=depth_scale))
    return views


@pytest.mark.parametrize(
    ("sizes", "skew_deg", "told"),
    [
        ((1.02, 1.0, 1.0), 0.0, r"x \+2\.\d %, y [+-]0\.0 %"),
        ((1.0, 1.0, 1.02), 0.0, r"z \+2\.0 % and 0\.0° of skew"),
        ((1.0, 1.0, 1.0), 1.0, r"and 1\.0° of skew"),
        ((1.0, 1.0, 1.0), -0.5, r"and 0\.5° of skew"),
    ],
)
def test_a_print_of_other_proportions_is_told_by_its_markers(
    sizes: tuple[float, float, float], skew_deg: float, told: str
) -> None:
    printed = reference_foot().printed(bar_of(np.array(sizes), skew_deg))
    with pytest.raises(CalibrationError, match=told):
        check_print(known_reference_foot(None), seen(printed.system), "print")


def test_a_print_of_another_size_is_told_by_the_depth_of_its_markers() -> None:
    """Whether the print or the depth is wrong, only the readings of the bar can say."""
    views = seen(reference_foot().system, depth_scale=1.02)
    with pytest.raises(CalibrationError, match=r"x \+2\.\d %, y \+2\.\d %, z \+2\.\d %"):
        check_print(known_reference_foot(None), views, "print")
    check_print(known_reference_foot([*BAR_MM, *[math.hypot(*BAR_MM[:2])] * 2]), views, "print")


def test_a_print_that_is_as_told_is_used() -> None:
    check_print(known_reference_foot(None), seen(reference_foot().system), "print")
    check_print(known_reference_foot(readings()), seen(misprinted().system), "print")


def test_readings_that_are_left_out_are_missed(session: Path, last_line) -> None:
    assert run(["evaluate", "chain", str(session), "--body", "reference-foot"]) == 1
    assert "by its markers the print in print differs from that by x +" in last_line()


def test_another_body_is_told_by_its_markers(small_session: Path, last_line) -> None:
    assert run(["evaluate", "chain", str(small_session), "--body", "reference-foot"]) == 1
    assert "was captured with the reference system lego-20" in last_line()


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["--bar", "1", "1", "1"], "are known; leave them out"),
        (["--unit", "mm"], "are known; leave them out"),
        (["--diameter", "120"], "tell the size themselves"),
        (["--callipers", "104", "80", "40", "131", "131"], "The print is off by"),
        (["--callipers", "10", "8", "4", "12.8", "12.8"], "Check the readings, in mm"),
        (["--callipers", "100", "80", "40", "120", "120"], "measure edges and diagonals again"),
    ],
)
def test_wrong_calls(words: list[str], told: str, tmp_path: Path, last_line) -> None:
    assert run(["evaluate", "chain", str(tmp_path), "--body", "reference-foot", *words]) != 0
    assert told in last_line()
