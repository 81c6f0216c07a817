"""A printed body is compared in the size and skew in which the printer made it."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.errors import CalibrationError
from insole_core.evaluation.find_form import find_scan
from insole_core.evaluation.known_form import Scan
from insole_core.evaluation.known_object import KnownScan
from insole_core.evaluation.printed_body import PrintedBar
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

DRAWN = (100.0, 80.0, 60.0)


def bar(sizes: tuple[float, float, float], skew_deg: float) -> PrintedBar:
    """Return what callipers read of a print, from where its corners come to lie."""
    x, y, z = np.multiply(DRAWN, sizes)
    skew = np.radians(skew_deg)
    along, beside = np.array([x, 0]), y * np.array([np.sin(skew), np.cos(skew)])
    diagonals = np.linalg.norm(along + beside), np.linalg.norm(along - beside)
    return PrintedBar(
        DRAWN, (float(x), float(y), float(z)), (float(diagonals[0]), float(diagonals[1]))
    )


@pytest.fixture(scope="module")
def drawn() -> TriangleMesh:
    """A coarse foot."""
    return build_foot(FootShape(), np.random.default_rng(3), 5.0).mesh


def test_size_and_skew_follow_from_the_readings() -> None:
    read = bar((1.02, 0.99, 1.01), -0.6)
    assert read.sizes == pytest.approx([1.02, 0.99, 1.01])
    assert read.skew_deg == pytest.approx(-0.6)
    assert read.text == "x +2.00 %, y -1.00 %, z +1.00 %, skew -0.60°"


def test_the_bar_itself_is_printed_as_it_was_read() -> None:
    read = bar((1.02, 0.99, 1.01), 0.6)
    x, y, z = DRAWN
    corners = TriangleMesh(
        np.array([[0, 0, 0], [x, 0, 0], [0, y, 0], [0, 0, z], [x, y, 0.0]]),
        np.array([[0, 1, 2], [0, 1, 3]]),
    )
    made = read.printed(corners).vertices
    assert np.linalg.norm(made[1:4], axis=1) == pytest.approx(read.edges_mm)
    found = np.linalg.norm(made[4]), np.linalg.norm(made[1] - made[2])
    assert found == pytest.approx(read.diagonals_mm)


@pytest.mark.parametrize(("sizes", "skew_deg"), [((1.02, 1.02, 1.02), 0.0), ((1, 1, 1), 0.9)])
def test_a_print_that_is_off_fits_once_its_bar_is_entered(
    drawn: TriangleMesh, sizes: tuple[float, float, float], skew_deg: float
) -> None:
    read = bar(sizes, skew_deg)
    made = read.printed(drawn)
    captured = made.transformed(
        rigid(rotation_about(np.array([1.0, 2.0, 0.5]), 20), np.array([5.0, -3.0, 8.0]))
    )
    known = KnownScan(Scan(made), "foot.stl", read)
    errors = known.find(captured).errors(captured.vertices)[0]
    uncorrected = find_scan(captured, Scan(drawn), "foot.stl").errors(captured.vertices)[0]
    assert np.percentile(np.abs(errors), 95) < 0.05
    assert np.percentile(np.abs(uncorrected), 95) > 0.2
    assert read.text in known.text


@pytest.mark.parametrize(
    ("drawn_mm", "edges_mm", "diagonals_mm", "said"),
    [
        (DRAWN, (104.0, 80, 60), (131.21, 131.21), "x \\+4.00 %, .*calibrate the printer"),
        (DRAWN, (100.0, 80, 60), (129.9, 126.2), "skew \\+1.70°.*print the body again"),
        (DRAWN, (100.0, 80, 60), (129.0, 129.0), "measure edges and diagonals again"),
        (DRAWN, (0.0, 80, 60), (128.0, 128.0), "not above 0"),
        (DRAWN, (float("nan"), 80, 60), (128.0, 128.0), "not above 0"),
    ],
)
def test_readings_that_cannot_be_are_refused(
    drawn_mm: tuple[float, float, float],
    edges_mm: tuple[float, float, float],
    diagonals_mm: tuple[float, float],
    said: str,
) -> None:
    with pytest.raises(CalibrationError, match=said):
        PrintedBar(drawn_mm, edges_mm, diagonals_mm)
