"""What spoils an infrared picture: sunlight, hair, a glossy nail, a pattern that drifts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, get_args

import numpy as np

from insole_core.geometry.arrays import FloatArray
from insole_core.simulate.scene import Hits

if TYPE_CHECKING:
    from insole_core.simulate.block_matching import Matcher

Disturbance = Literal["speckle", "noise", "sunlight", "drift", "skin"]
DISTURBANCES: tuple[Disturbance, ...] = get_args(Disturbance)
_SPECKLE_CONTRAST = 0.5
_NOISE = 2.0
_SUNLIGHT = 2.0
"""Brightness of a surface that faces the sun; a wall at 800 mm has 1 by the dots."""
_SUN = np.array([0.6, -0.3, -0.74])
_DRIFT_PX = 0.1
_HAIR_ABOVE_MM = 45.0
_HAIR_STEP_MM, _HAIR_SHARE, _HAIR_REFLECTS = 2.2, 0.1, 0.25
_NAIL_MM = 9.0
_MATT, _GLOSS, _GLOSS_POWER = 0.5, 12.0, 60


@dataclass(frozen=True)
class Surroundings:
    """The light that is not the projector's, and skin that does not reflect evenly.

    Parameters
    ----------
    sunlight
        Brightness that the sun adds to a surface that faces it, on one half of the scene (x > 0).
    drift_px
        By which the dots have moved along the rows since the chip's reference and the walls.
    hairy
        Whether strands darken the skin above the foot.
    nail_y_mm
        The skin is glossy from here towards the toes; None where it is matt.
    """

    sunlight: float = 0.0
    drift_px: float = 0.0
    hairy: bool = False
    nail_y_mm: float | None = None

    def seen(
        self, hits: Hits, light: FloatArray, camera_mm: FloatArray, projector_mm: FloatArray
    ) -> FloatArray:
        """Return the brightness (n,) of surfaces.

        Parameters
        ----------
        hits
            Reference frame.
        light : (n,) float64
            The projector's, from matt and even skin.
        camera_mm, projector_mm : (3,) float64, reference frame
        """
        if self.hairy:
            light = np.where(_under_hair(hits.points), _HAIR_REFLECTS, 1.0) * light
        if self.nail_y_mm is not None:
            shine = _MATT + _GLOSS * _mirrored(hits, camera_mm, projector_mm)
            light = np.where(hits.points[:, 1] > self.nail_y_mm, shine, 1.0) * light
        if self.sunlight:
            light = light + self.sunlight * np.where(
                hits.points[:, 0] > 0, np.clip(hits.normals @ _SUN, 0, 1), 0.0
            )
        return light


BARE = Surroundings()


def disturbed(
    matcher: Matcher, kinds: Iterable[Disturbance], front_mm: float
) -> tuple[Matcher, Surroundings]:
    """Return sensor and surroundings with some disturbances.

    Parameters
    ----------
    matcher
    kinds
    front_mm
        Position of the foremost point of the foot, y, reference frame.
    """
    around = BARE
    for kind in kinds:
        if kind == "speckle":
            matcher = replace(matcher, speckle_contrast=_SPECKLE_CONTRAST)
        elif kind == "noise":
            shot, read = _NOISE * matcher.shot_noise, _NOISE * matcher.read_noise
            matcher = replace(matcher, shot_noise=shot, read_noise=read)
        elif kind == "sunlight":
            around = replace(around, sunlight=_SUNLIGHT)
        elif kind == "drift":
            around = replace(around, drift_px=_DRIFT_PX)
        else:
            around = replace(around, hairy=True, nail_y_mm=front_mm - _NAIL_MM)
    return matcher, around


def _under_hair(points: FloatArray) -> FloatArray:
    """Return which points (n, 3) lie under a strand of the lower leg."""
    x, y, z = points.T
    way = (x - y) / _HAIR_STEP_MM
    waved = way + 0.3 * np.sin(z / 4 + np.floor(way))
    return np.asarray((waved % 1 < _HAIR_SHARE) & (z > _HAIR_ABOVE_MM))


def _mirrored(hits: Hits, camera_mm: FloatArray, projector_mm: FloatArray) -> FloatArray:
    """Return how much (n,) of the projector's light surfaces mirror into the camera (Blinn)."""
    half = sum(_unit(place - hits.points) for place in (camera_mm, projector_mm))
    facing = np.einsum("nc,nc->n", _unit(np.asarray(half)), hits.normals)
    return np.asarray(np.clip(facing, 0, 1) ** _GLOSS_POWER)


def _unit(vectors: FloatArray) -> FloatArray:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=1, keepdims=True))
