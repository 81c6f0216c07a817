"""Where vertices lie under the map of pressure: kept as long as they lie there, and no longer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from round_foot import round_foot

from insole_core.contact.change import Assumptions, Change, Loading, Shown, inside
from insole_core.contact.pressing import Pressed
from insole_core.contact.stance import Sole, shoe_floor
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


def test_what_has_no_figure_has_colours_of_its_own_known_by_their_stripes() -> None:
    foot = round_foot(Side.LEFT)
    sole = Sole.of(foot)
    nowhere = np.zeros(sole.known.shape)
    rest = Pressed(nowhere, nowhere, nowhere, 0.0, (0.0, 0.0), 2.0)
    heel, toes = (inside(sole, name) for name in ("heel", "toes"))
    floor = shoe_floor(sole)
    change = Change(
        Loading(sole, 75),
        (floor, floor),
        Assumptions(),
        replace(rest, mpa=0.1 * heel),
        replace(rest, mpa=0.05 * heel + 0.1 * toes),
    )
    vertices = sole.field.nodes[sole.known.ravel()]
    loaded = LoadedVertices.of(sole, vertices, np.ones(len(vertices), dtype=bool))

    def colors(untold: tuple[str, ...], kind: Shown) -> set[str]:
        coloring = loaded.coloring(change, untold)
        assert coloring.painted is not None
        here = change.shown(untold)[sole.known] == kind
        assert here.any()
        return {f"#{bytes(one).hex()}" for one in coloring.painted[here]}

    swatches = {
        swatch.text: {swatch.color, swatch.stripe} - {""}
        for swatch in loaded.coloring(change, ()).swatches
    }
    assert colors((), Shown.NEWLY) == swatches["newly pressed"]
    assert colors((), Shown.IDLE) == swatches["nothing presses"]
    assert colors(("heel",), Shown.UNTOLD) == swatches["nothing told"]
    own = [*swatches.values(), colors((), Shown.PERCENT)]
    assert sum(map(len, own)) == len(set().union(*own))  # none is taken for another
