"""A simulated foot: a closed surface in the colour of skin, with its landmarks."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import MIRROR, transform
from insole_core.simulate.foot_field import LEG_HEIGHT_MM, TOES, FootField, Toe
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.iso_surface import extract_surface

_SKIN = np.array([206.0, 158.0, 132.0])
_RED = np.array([10.0, -20.0, -16.0])
_PALE = np.array([16.0, 18.0, 16.0])
_DORSAL = np.array([-14.0, -12.0, -12.0])
_INK = np.array([26.0, 28.0, 62.0])
_MOTTLE = 7.0
_PEN_LENGTH_MM = 24.0
_PEN_WIDTH_MM = 3.4
DEFAULT_CELL_MM = 2.2
_MARGIN_MM = 8.0
_SMOOTHING_CELLS = 0.8
_RELIEF_MM = 0.15
_RELIEF_CELLS = 1.5
_HEEL_HEIGHT_MM = 45.0


def paint_skin(
    mesh: TriangleMesh, landmarks_mm: dict[str, FloatArray], rng: np.random.Generator
) -> TriangleMesh:
    """Colour the surface of a left foot.

    Parameters
    ----------
    mesh : mm, reference frame
    landmarks_mm
        As in `FootModel`; the positions of heel, ball and toes.
    rng
        For the mottling and the position of the pen mark.

    Returns
    -------
    TriangleMesh
        The same mesh with colours.
    """
    plantar = np.clip(0.35 - 0.9 * mesh.vertex_normals[:, 2], 0, 1)[:, None]
    colors = _SKIN + (1 - plantar) * _DORSAL
    colors = colors + plantar * _loaded(mesh.vertices, landmarks_mm)[:, None] * _RED
    colors = colors + plantar * _arch(mesh.vertices, landmarks_mm)[:, None] * _PALE
    colors = colors + _MOTTLE * _mottling(mesh.vertices, rng)[:, None] * np.array([0.5, 1, 1])
    head = landmarks_mm["metatarsal_head_2"]
    centre = head[:2] + np.array([-4.0, -26.0]) + rng.uniform(-3, 3, 2)
    inked = _pen_cross(mesh, centre, rng.uniform(-15, 15))
    colors[inked] = _INK
    return replace(mesh, colors=np.clip(colors, 0, 255).astype(np.uint8))


def _loaded(points: FloatArray, landmarks_mm: dict[str, FloatArray]) -> FloatArray:
    """Compute the load (n,) of points, 0 to 1: heel, metatarsal heads, toe pulps."""
    heel = landmarks_mm["pternion"] * [1, 1, 0] + [0, 32.0, 0]
    spots = [(heel, 26.0, 1.0)]
    for number in range(1, 6):
        spots.append((landmarks_mm[f"metatarsal_head_{number}"], 15.0, 0.8))
        tip = landmarks_mm[f"toe_tip_{number}"]
        spots.append((tip * [1, 1, 0] - [0, 8.0, 0], 8.0, 0.7))
    bell = [w * np.exp(-((points - p) ** 2).sum(1) / (2 * s * s)) for p, s, w in spots]
    return np.asarray(np.clip(np.sum(bell, axis=0), 0, 1))


def _arch(points: FloatArray, landmarks_mm: dict[str, FloatArray]) -> FloatArray:
    """Compute how far points (n,) lie in the medial arch, 0 to 1."""
    heel, head = landmarks_mm["pternion"], landmarks_mm["metatarsal_head_1"]
    centre = heel + 0.58 * (head - heel)
    return np.asarray(np.exp(-(((points - centre) / [26.0, 38.0, 30.0]) ** 2).sum(axis=1) / 2))


def _mottling(points: FloatArray, rng: np.random.Generator) -> FloatArray:
    """Draw a smooth random pattern (n,) of unit strength: plane waves of 15 to 60 mm length."""
    count = 24
    direction = rng.standard_normal((3, count))
    direction /= np.linalg.norm(direction, axis=0)
    waves = points @ (direction * 2 * np.pi / rng.uniform(15, 60, count))
    return np.asarray(np.cos(waves + rng.uniform(0, 2 * np.pi, count)).sum(1) / np.sqrt(count / 2))


def _pen_cross(mesh: TriangleMesh, centre: FloatArray, turn_deg: float) -> BoolArray:
    """Return which vertices (n,) lie on the cross drawn on the sole."""
    turn = np.radians(turn_deg)
    along = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    offset = np.abs((mesh.vertices[:, :2] - centre) @ along.T)
    stroke = (offset.max(1) < _PEN_LENGTH_MM / 2) & (offset.min(1) < _PEN_WIDTH_MM / 2)
    return np.asarray(stroke & (mesh.vertex_normals[:, 2] < -0.3))


@dataclass(frozen=True, eq=False)
class FootModel:
    """A simulated foot whose measures are known.

    Parameters
    ----------
    shape
    mesh : mm, reference frame, with colours
        Closed; the lower leg is cut flat at the top. y = 0 in the middle of the length, z = 0 at
        the lowest point of the sole.
    landmarks_mm : name -> (3,) float64, mm, reference frame
        pternion, metatarsale_tibiale, metatarsale_fibulare, toe_tip_1 ... 5 and
        metatarsal_head_1 ... 5 (medial to lateral, the heads on the sole).
    """

    shape: FootShape
    mesh: TriangleMesh
    landmarks_mm: dict[str, FloatArray]


def build_foot(
    shape: FootShape,
    rng: np.random.Generator,
    cell_mm: float = DEFAULT_CELL_MM,
    toes: tuple[Toe, ...] = TOES,
) -> FootModel:
    """Build the foot of a shape; a right foot is the exact mirror image of the left one.

    Parameters
    ----------
    shape
    rng
        For skin relief and skin colour.
    cell_mm
        Resolution of the surface.
    toes
        Of the model's foot of 245 mm, before it is scaled to the shape.

    Returns
    -------
    FootModel
    """
    field = FootField(shape, toes)
    model = _surface(field, rng, cell_mm)
    model2reference = _placement(model.vertices, shape.length_mm)
    mesh = model.transformed(model2reference)
    landmarks = {
        **_extremes(mesh.vertices),
        **_numbered("toe_tip", transform(model2reference, field.toe_tips())),
        **_numbered("metatarsal_head", transform(model2reference, field.metatarsal_heads())),
    }
    mesh = paint_skin(mesh, landmarks, rng)
    if shape.side is Side.LEFT:
        return FootModel(shape, mesh, landmarks)
    mirrored = {name: point * MIRROR for name, point in landmarks.items()}
    return FootModel(shape, mesh.mirrored(), mirrored)


def _surface(field: FootField, rng: np.random.Generator, cell_mm: float) -> TriangleMesh:
    half_width = 0.65 * max(field.shape.ball_width_mm, field.shape.heel_width_mm) + _MARGIN_MM
    low = np.array([-half_width, -_MARGIN_MM, -_MARGIN_MM])
    length_mm = max(field.shape.length_mm, float(field.toe_tips()[:, 1].max()))
    high = np.array([half_width, length_mm + _MARGIN_MM, LEG_HEIGHT_MM + _MARGIN_MM])
    x, y, z = (np.arange(a, b, cell_mm) for a, b in zip(low, high, strict=True))
    values = scipy.ndimage.gaussian_filter(field.sample(x, y, z), _SMOOTHING_CELLS)
    relief = scipy.ndimage.gaussian_filter(rng.standard_normal(values.shape), _RELIEF_CELLS)
    return extract_surface(values + _RELIEF_MM / relief.std() * relief, low, cell_mm)


def _placement(vertices: FloatArray, length_mm: float) -> FloatArray:
    """Return the transform (4, 4) to the exact length, y = 0 in its middle, z = 0 at the lowest."""
    sole = vertices[vertices[:, 2] < _HEEL_HEIGHT_MM]
    low, high = sole.min(axis=0), sole.max(axis=0)
    stretch = length_mm / (high[1] - low[1])
    placement = np.diag([1.0, stretch, 1.0, 1.0])
    placement[1:3, 3] = -stretch * (low[1] + high[1]) / 2, -low[2]
    return placement


def _extremes(vertices: FloatArray) -> dict[str, FloatArray]:
    """Find the landmarks that are outermost points of a left foot."""
    share = (vertices[:, 1] - vertices[:, 1].min()) / np.ptp(vertices[:, 1])
    low = vertices[:, 2] < _HEEL_HEIGHT_MM
    inner = vertices[low & (share > 0.60) & (share < 0.80)]
    outer = vertices[low & (share > 0.50) & (share < 0.75)]
    rear = vertices[low]
    return {
        "pternion": rear[np.argmin(rear[:, 1])],
        "metatarsale_tibiale": inner[np.argmax(inner[:, 0])],
        "metatarsale_fibulare": outer[np.argmin(outer[:, 0])],
    }


def _numbered(name: str, points: FloatArray) -> dict[str, FloatArray]:
    return {f"{name}_{number}": point for number, point in enumerate(points, start=1)}
