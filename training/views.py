"""Simulated readings of a foot with the truth beside them: the examples for the network."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_about
from insole_core.reconstruct.fusion.depth_view import DepthView, read_volume
from insole_core.recording.box import Box
from insole_core.sensing.frames import average_raw
from insole_core.sensing.sensor import Sensor
from insole_core.simulate.block_matching import Matcher, record_matched_depth
from insole_core.simulate.device import Device, make_device
from insole_core.simulate.poses import look_at
from insole_core.simulate.scene import SceneCaster, build_scene, load_reference_system
from training.feet import varied_foot
from training.light import varied_shading
from training.random_objects import varied_stack, varied_thing

_FRAMES = 6
_NO_FOOT = 5
"""Every how many-th object is not a foot."""
_NARROW = 0.5
"""Fraction of devices with the window that fits real sensors best."""
_SOLE_MM, _ACHILLES_MM = np.array([0.0, 12.0, 5.0]), np.array([0.0, -112.0, 96.0])
_VOLUME = Box((-80.0, -160.0, -40.0), (80.0, 160.0, 165.0))
_OUTLINE_MM = 0.8
"""How far beside the foot the colour image lets a reading pass."""


@dataclass(frozen=True, eq=False)
class Example:
    """One view, rotated so that the toes, or the sole, are at the lower edge.

    Parameters
    ----------
    raw : (height, width) float32, raw units
        As averaged and corrected; NaN = no reading.
    true_raw : (height, width) float32
        What an ideal sensor would report; NaN = no foot there.
    cosine : (height, width) float32
        Cosine of the angle between ray and true normal.
    pixel_mm : (height, width) float32
        Width of a pixel at the depth of the reading.
    shading : (height, width) float32
        As returned by `find_shading`.
    """

    raw: FloatArray
    true_raw: FloatArray
    cosine: FloatArray
    pixel_mm: FloatArray
    shading: Float32Array

    def save(self, path: Path) -> None:
        """Write the example as .npz."""
        arrays = {name: value.astype(np.float32) for name, value in vars(self).items()}
        np.savez_compressed(path, **arrays)

    @staticmethod
    def load(path: Path) -> Example:
        """Read an example that `save` wrote."""
        with np.load(path) as stored:
            arrays = {name: stored[name].astype(float) for name in stored.files}
        return Example(**arrays | {"shading": arrays["shading"].astype(np.float32)})


def simulate_examples(seed: int, *, is_stack: bool = False) -> dict[str, Example]:
    """Simulate one foot, or another object, seen by three sensors at random positions."""
    rng = np.random.default_rng([seed, 15])
    draw = varied_stack if is_stack else varied_foot if seed % _NO_FOOT else varied_thing
    shown = _Shown.between_markers(draw(rng), rng)
    distance_mm, half_deg = rng.uniform(600, 950), rng.uniform(15, 40)
    poses = {
        "left": _stand(_SOLE_MM, (rng.normal(-3, 7), half_deg, 0), distance_mm, rng),
        "right": _stand(_SOLE_MM, (rng.normal(-3, 7), -half_deg, 0), distance_mm, rng),
        "top": _stand(
            _ACHILLES_MM, (-90 - rng.uniform(4, 18), 0, rng.normal(0, 8)), distance_mm, rng
        ),
    }
    examples = {}
    for name, pose in poses.items():
        device = make_device(name, (), distance_mm, (640, 480), rng)
        examples[name] = shown.seen(device, pose, _matcher(rng), rng)
    return examples


def seen_by_stations(
    thing: TriangleMesh, distance_mm: float, matcher: Matcher, rng: np.random.Generator
) -> Iterator[tuple[Example, Sensor]]:
    """Yield what two sensors see of an object: one beside the sole, and the upper one."""
    shown = _Shown.between_markers(thing, rng)
    for target, angles_deg in ((_SOLE_MM, (-3, 25, 0)), (_ACHILLES_MM, (-100, 0, 0))):
        pose = _stand(target, angles_deg, distance_mm, rng)
        device = make_device("station", (), distance_mm, (640, 480), rng)
        yield shown.seen(device, pose, matcher, rng), device.sensor


@dataclass(frozen=True, eq=False)
class _Shown:
    """An object, between the markers and alone, to be seen by sensors."""

    thing: TriangleMesh
    scene: SceneCaster
    alone: SceneCaster

    @staticmethod
    def between_markers(thing: TriangleMesh, rng: np.random.Generator) -> _Shown:
        """Set an object between the markers, with what lies about there."""
        scene = SceneCaster(build_scene(thing, load_reference_system(), rng))
        return _Shown(thing, scene, SceneCaster(TriangleMesh(thing.vertices, thing.triangles)))

    def seen(
        self, device: Device, pose: FloatArray, matcher: Matcher, rng: np.random.Generator
    ) -> Example:
        """Return what a sensor at a place reads."""
        recording = record_matched_depth(
            self.scene, device, pose, rng, things=self.thing.vertices, matcher=matcher
        )
        average = average_raw(recording.frame(rng) for _ in range(_FRAMES))
        return _example(average.raw, device, pose, self.alone, rng)


def _matcher(rng: np.random.Generator) -> Matcher:
    """Draw a device's matcher: like real ones, or with a larger window and more noise."""
    window_px = (7, 9) if rng.random() < _NARROW else (9, 9)
    noise = rng.uniform(0.6, 1.1)
    return Matcher(window_px, rng.uniform(0.15, 0.3), 0.27 * noise, 0.09 * noise)


def _stand(
    target: FloatArray,
    angles_deg: tuple[float, float, float],
    distance_mm: float,
    rng: np.random.Generator,
) -> FloatArray:
    turn = np.eye(3)
    for axis, angle_deg in zip(np.eye(3), angles_deg, strict=True):
        turn = rotation_about(axis, angle_deg) @ turn
    position = target + turn @ [0, 0, -distance_mm] + rng.normal(0, 12, 3)
    down = rotation_about(turn[:, 2], rng.normal(0, 8)) @ turn[:, 1]
    return look_at(position, target + rng.normal(0, 7, 3), down)


def _example(
    raw: FloatArray, device: Device, pose: FloatArray, foot: SceneCaster, rng: np.random.Generator
) -> Example:
    sensor = device.sensor
    black = np.zeros((480, 640, 3), np.uint8)
    reading = read_volume("x", sensor, pose, _VOLUME, raw=sensor.corrected(raw), color=black)
    true_raw, cosine = _truth(reading, foot)
    depth_mm = sensor.disparity.depth_mm(reading.raw)
    pixel_mm = depth_mm / sensor.depth_camera.fx
    kept = reading.without(_beside(np.isfinite(true_raw), pixel_mm))
    return Example(kept.raw, true_raw, cosine, pixel_mm, varied_shading(kept, foot, rng))


def _truth(reading: DepthView, foot: SceneCaster) -> tuple[FloatArray, FloatArray]:
    """Return the raw numbers of the foot itself, and the cosines of its normals to the rays."""
    rays = reading.directions(reading.pixels).reshape(-1, 3)
    hits = foot.cast(reading.origin_mm, rays)
    raw, cosine = np.full(reading.raw.shape, np.nan), np.zeros(reading.raw.shape)
    raw.flat[hits.ray] = reading.sensor.disparity.raw(hits.distance)
    along = np.einsum("nc,nc->n", hits.normals, rays[hits.ray])
    cosine.flat[hits.ray] = -along / np.linalg.norm(rays[hits.ray], axis=1)
    return raw, cosine


def _beside(foot: BoolArray, pixel_mm: FloatArray) -> BoolArray:
    """Return what the colour image would classify as beside the foot."""
    outside_px = cv2.distanceTransform((~foot).astype(np.uint8), cv2.DIST_L2, 5) - 0.5
    return np.asarray(outside_px * np.nan_to_num(pixel_mm, nan=1.0) > _OUTLINE_MM)
