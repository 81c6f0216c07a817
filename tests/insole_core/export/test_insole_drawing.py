"""Sections of the drawing: ends, heights and the thinnest place of a known face."""

from __future__ import annotations

import numpy as np
import pytest

from insole_core.export.insole_drawing import Section


def test_a_section_tells_the_dimensions_of_its_face() -> None:
    # 40 mm wide, flat below, 10 mm high at both rims, sloping to 2 mm at 25.
    face = np.array([(0, 0), (40, 0), (40, 10), (25, 2), (0, 10)], float)
    section = Section("heel", 0.0, (face,))
    assert section.ends_mm == (0, 40)
    assert section.heights_mm(12.5) == pytest.approx((0, 6))
    assert section.thinnest_mm() == pytest.approx(25)
    assert (section.rim_mm(0), section.rim_mm(1)) == (10, 10)


def test_a_section_of_two_faces_spans_both() -> None:
    faces = (np.array([(0, 0), (4, 0), (4, 3), (0, 3)], float),)
    faces += (faces[0] + [6, 5],)
    section = Section("heel", 0.0, faces)
    assert section.ends_mm == (0, 10)
    assert section.heights_mm(8.0) == pytest.approx((5, 8))
