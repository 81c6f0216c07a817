"""What is told of the density and mass of a print: by geometry, and beside the real slicer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
import trimesh

from insole_core.formats.slicer_3mf import Infill, PrintedPart
from insole_core.geometry.mesh import TriangleMesh
from insole_core.solids.print_density import PrintedDensities, printed_densities

LAYER_MM = 0.2
PLATE_MM = (80.0, 50.0)


def plate(height_mm: float, percent: float, **settings: int) -> PrintedPart:
    box = trimesh.creation.box((*PLATE_MM, height_mm))
    box.apply_translation([0, 0, height_mm / 2])
    mesh = TriangleMesh(np.asarray(box.vertices), np.asarray(box.faces, np.int32))
    shell = {"walls": 2, "top_layers": 3, "bottom_layers": 3, **settings}
    return PrintedPart(mesh, "plate", infill=Infill(percent, "grid"), **shell)


def told(printed: PrintedPart) -> PrintedDensities:
    return printed_densities(printed, LAYER_MM, g_per_cm3=1.2)


@pytest.mark.parametrize("height_mm", [3.0, 12.0])
def test_walls_and_solid_layers_count(height_mm: float) -> None:
    (whole,) = told(plate(height_mm, 20)).zones
    assert whole.volume_mm3 == pytest.approx(PLATE_MM[0] * PLATE_MM[1] * height_mm, rel=0.01)
    inner = (PLATE_MM[0] - 1.6) * (PLATE_MM[1] - 1.6) / (PLATE_MM[0] * PLATE_MM[1])
    hollow = inner * (height_mm - 6 * LAYER_MM) / height_mm
    assert whole.percent == pytest.approx(100 - 80 * hollow, abs=1.5)
    assert whole.mass_g == pytest.approx(
        whole.volume_mm3 / 1000 * 1.2 * whole.percent / 100, rel=1e-6
    )


def test_a_thin_piece_is_solid_and_that_is_told() -> None:
    thin = told(plate(1.2, 50))
    assert thin.zones[0].percent == pytest.approx(100, abs=2)
    (note,) = thin.notes
    assert note.startswith("Walls and solid layers make the print denser than its infill (rest 50")
    assert told(replace(plate(12.0, 80), walls=1)).notes == ()
    facts = told(plate(12.0, 50)).facts
    assert list(facts) == ["with walls and solid layers of 0.2 mm", "rest 50 %"]
    assert facts["rest 50 %"] == "57 %, 33.0 g"


def test_small_islands_and_slopes_are_solid() -> None:
    cone = trimesh.creation.cone(radius=40, height=8, sections=64)
    mesh = TriangleMesh(np.asarray(cone.vertices), np.asarray(cone.faces, np.int32))
    flat = told(plate(8.0, 20)).zones[0].percent
    (sloped,) = told(replace(plate(8.0, 20), mesh=mesh)).zones
    assert sloped.percent > flat + 15
