"""A simulated foot: a closed coloured surface and its true landmarks in the reference frame."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import transform
from insole_core.simulate.foot_field import LEG_HEIGHT_MM, TOES, FootField, Toe
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.iso_surface import extract_surface
from insole_core.simulate.skin import paint_skin

DEFAULT_CELL_MM = 2.2
_MARGIN_MM = 8.0
_SMOOTHING_CELLS = 0.8
_RELIEF_MM = 0.15
_RELIEF_CELLS = 1.5
_HEEL_HEIGHT_MM = 45.0


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
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    mirrored = {name: transform(mirror, point) for name, point in landmarks.items()}
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
