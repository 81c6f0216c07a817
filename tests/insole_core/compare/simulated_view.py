"""One sensor looks down on a thing that lies on a table: a mould, a finished insole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.recording.session import View
from insole_core.simulate.color_image import record_color
from insole_core.simulate.depth_image import record_depth
from insole_core.simulate.device import make_device
from insole_core.simulate.poses import look_at
from insole_core.simulate.scene import SceneCaster, joined
from insole_core.simulate.simulation import Recorder

_PLASTER: tuple[int, int, int] = (226, 222, 212)
_WOOD: tuple[int, int, int] = (150, 118, 84)
_TABLE_MM = 1200.0
_TILT_DEG = 8.0


def simulate_view(
    thing: TriangleMesh, seed: int, *, distance_mm: float = 750.0, frames: int = 10
) -> View:
    """Record what stands on z = 0 of its frame, from above and a little aslant.

    Parameters
    ----------
    thing : mm
        In plaster white where it has no colours.
    seed
    distance_mm
        From the sensor to the thing.
    frames
        Depth frames; colour has one.
    """
    rng = np.random.default_rng([seed, 7])
    low, high = thing.bounds_mm
    middle = np.append((low + high)[:2] / 2, high[2] / 2)
    caster = SceneCaster(joined([_colored(thing), _table(middle)]))
    device = make_device(f"SIM{seed:05d}7", (), distance_mm, (640, 480), rng)
    tilt = rotation_about(np.array([1.0, 0.0, 0.0]), float(rng.uniform(-_TILT_DEG, _TILT_DEG)))
    above = middle + distance_mm * tilt[:, 2]
    pose = look_at(above, middle, np.array([0.0, -1.0, 0.0]))
    recorder = Recorder(
        record_depth(caster, device, pose, rng),
        record_color(caster, device.sensor, pose),
        [seed, 8],
    )
    return View("above", device.sensor, frames, 1, recorder.read_depth, recorder.read_color)


def _colored(thing: TriangleMesh) -> TriangleMesh:
    if thing.colors is not None:
        return thing
    return replace(thing, colors=_even(len(thing.vertices), _PLASTER))


def _table(middle: FloatArray) -> TriangleMesh:
    half = _TABLE_MM / 2
    corners = np.array([(-half, -half), (half, -half), (half, half), (-half, half)])
    places = np.column_stack([corners + middle[:2], np.zeros(4)])
    triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    return TriangleMesh(places, triangles, _even(4, _WOOD))


def _even(count: int, color: tuple[int, int, int]) -> ByteArray:
    return np.tile(np.array(color, np.uint8), (count, 1))
