"""Where vertices lie under the map of pressure: kept as long as they lie there, and no longer."""

from __future__ import annotations

import numpy as np
from round_foot import round_foot

from insole_core.contact.stance import Sole
from insole_core.geometry.side import Side
from insole_studio.features.design.models.color_maps import LoadedVertices, is_sole


def test_places_hold_while_only_heights_change_on_the_same_sole() -> None:
    foot = round_foot(Side.LEFT)
    sole, vertices = Sole.of(foot), foot.mesh.vertices
    kept = LoadedVertices.of(sole, vertices, is_sole(foot.mesh))
    assert kept.are_those_of(sole, vertices + np.array([0.0, 0.0, 2.0]))
    moved = vertices.copy()
    for axis in (0, 1):
        moved[-1, axis] += 0.1
        assert not kept.are_those_of(sole, moved)
        moved[-1, axis] = vertices[-1, axis]
    assert not kept.are_those_of(Sole.of(foot, step_mm=4.0), vertices)
