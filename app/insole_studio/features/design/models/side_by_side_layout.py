"""Layout of two meshes side by side: positions and names."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.cases.case_record import FootRecord
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_studio.document.case_names import variant_heading
from insole_studio.document.side_by_side import Beside, SideBySide
from insole_studio.scene.guide_lines import NameLabel
from insole_studio.texts import tr
from insole_studio.widgets.side_switch import COLORS

GAP_MM = 64.0
"""Gap between the two, wide enough for their anatomical directions."""
NAME_OVER_MM = 72.0
"""Clear of the word for the toes, also where a millimetre is less than a pixel."""
NAME_ROOM_MM = NAME_OVER_MM + 10.0
"""Height added to the view for the names."""
_LONGEST_NAME = 14
AT_HAND, OTHER = "#1668b8", "#5f666d"


def is_right(foot: FootRecord, counterpart: SideBySide) -> bool:
    """Return whether the subject goes to the right (+x) of its counterpart.

    Feet go to their own side, variants in the order of their names.
    """
    if counterpart.kind is Beside.VARIANT:
        names = [variant.name for variant in foot.variants]
        return names.index(foot.chosen) > names.index(counterpart.variant)
    return foot.side is Side.RIGHT


def placed_beside(mesh: TriangleMesh, other: TriangleMesh, is_right: bool) -> TriangleMesh:
    """Return the counterpart moved beside the subject, which keeps its place.

    Parameters
    ----------
    mesh, other : mm, insole frame
        Subject and counterpart.
    is_right
        Whether the subject goes to the right (+x).
    """
    low, high = mesh.bounds_mm[:, 0]
    other_low, other_high = other.bounds_mm[:, 0]
    shift = low - GAP_MM - other_high if is_right else high + GAP_MM - other_low
    return replace(other, vertices=other.vertices + np.array([shift, 0.0, 0.0]))


def names_over(
    foot: FootRecord, counterpart: SideBySide, mesh: TriangleMesh, other: TriangleMesh
) -> tuple[NameLabel, NameLabel]:
    """Return the names of both, above the toes, in the colours of their sides.

    Parameters
    ----------
    foot
        The active foot.
    counterpart
        What is shown beside it.
    mesh, other : mm, insole frame
        Meshes of subject and counterpart, in their places.
    """
    colors = COLORS[foot.side], COLORS[foot.side.other]
    if counterpart.kind is Beside.VARIANT:
        colors = AT_HAND, OTHER
    y = max(mesh.bounds_mm[1, 1], other.bounds_mm[1, 1]) + NAME_OVER_MM
    own, its = _words(foot, counterpart)
    if counterpart.kind is Beside.VARIANT:
        own, its = (_shortened(variant_heading(name)) for name in (own, its))
    return NameLabel(own, _over(mesh, y), colors[0]), NameLabel(its, _over(other, y), colors[1])


def pair_text(foot: FootRecord, counterpart: SideBySide) -> str:
    """Return a text that says what is compared with what."""
    own, its = _words(foot, counterpart)
    if counterpart.is_mirrored:
        return tr("{this} − {other} mirrored").format(this=own, other=its)
    return f"{own} − {its}"


def _words(foot: FootRecord, counterpart: SideBySide) -> tuple[str, str]:
    if counterpart.kind is Beside.VARIANT:
        return foot.chosen, counterpart.variant
    words = {Side.LEFT: tr("LEFT"), Side.RIGHT: tr("RIGHT")}
    return words[foot.side], words[foot.side.other]


def _shortened(name: str) -> str:
    """Return a name so short that it ends before that beside it begins; names differ at the end."""
    half = _LONGEST_NAME // 2
    return name if len(name) <= _LONGEST_NAME else f"{name[: half - 1].rstrip()}…{name[-half:]}"


def _over(mesh: TriangleMesh, y_mm: float) -> FloatArray:
    low, high = mesh.bounds_mm
    return np.array([(low[0] + high[0]) / 2, y_mm, low[2]])
