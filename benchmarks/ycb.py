"""The learnt correction on real frames of the Kinect's chip, of neither balls nor feet.

Three demo frames of PoseCNN (an Asus Xtion Pro Live, one depth frame each), in which objects stand
whose scans are known. Their depth was resampled to the colour picture; here each pixel of the depth
camera takes the median of what fell on it, which undoes that as far as it goes: what was lost
between two pixels stays lost, and the conversion to mm is that of any Kinect. Each object is fitted
to its readings by the points of its scan (closest planes, the farthest tenth left out), before and
after the correction anew. Printed is what remains: mean, root mean square and 95 %, mm, and the
share of the readings that the correction moves.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks._measure import print_table
from benchmarks._scan_variants import SHARED
from insole_core.geometry.arrays import FloatArray, IntArray
from insole_core.geometry.point_tree import point_tree
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.reconstruct.fusion.depth_view import DepthView
from insole_core.reconstruct.fusion.matching_error import without_matching_error
from insole_core.sensing.sensor import Sensor, nominal_kinect

FOLDER = SHARED.parent / "kinect_v1" / "ycb"
_UNIT_MM = 0.1
_ABOVE_MM, _DEEP_MM = (
    8.0,
    260.0,
)  # over the table, and how far from the nearest reading an object is
_KEPT, _ROUNDS, _STARTS, _OWN_MM = 0.9, 40, 16, 8.0
_NEAREST = 12


@dataclass(frozen=True)
class Standing:
    """An object on the table of a frame, and the box (u, v, u, v) that shows it alone."""

    frame: str
    name: str
    box: tuple[int, int, int, int]


OBJECTS = (
    Standing("000001", "006_mustard_bottle", (318, 200, 407, 452)),
    Standing("000001", "005_tomato_soup_can", (404, 246, 466, 380)),
    Standing("000002", "021_bleach_cleanser", (208, 30, 306, 294)),
    Standing("000002", "002_master_chef_can", (303, 150, 374, 322)),
    Standing("000003", "005_tomato_soup_can", (178, 296, 280, 456)),
    Standing("000003", "024_bowl", (332, 256, 538, 418)),
)


@dataclass(frozen=True, eq=False)
class Form:
    """Points and normals (n, 3) of an object's scan, mm; it stands along z."""

    points: FloatArray
    normals: FloatArray

    @staticmethod
    def read(name: str) -> Form:
        points = np.loadtxt(FOLDER / f"{name}.xyz") * 1000
        near = points[point_tree(points).query(points, k=_NEAREST)[1]]
        away = near - near.mean(axis=1, keepdims=True)
        return Form(points, np.linalg.eigh(np.swapaxes(away, 1, 2) @ away)[1][:, :, 0])

    def off_mm(self, points: FloatArray) -> tuple[FloatArray, IntArray]:
        """Return the distances (n,) of points from the closest planes, and the planes' indices."""
        index = np.asarray(point_tree(self.points).query(points)[1])
        return np.einsum("nc,nc->n", points - self.points[index], self.normals[index]), index

    def away_mm(self, points: FloatArray) -> FloatArray:
        """Return the distances (n,) of points from the closest ones of the object."""
        return np.asarray(point_tree(self.points).query(points)[0])

    def fitted(self, points: FloatArray, start: FloatArray) -> FloatArray:
        """Return the points (n, 3) moved onto the object from a start (4, 4)."""
        points = transform(start, points)
        for _ in range(_ROUNDS):
            off, index = self.off_mm(points)
            far = np.linalg.norm(points - self.points[index], axis=1)
            kept = far <= np.quantile(far, _KEPT)
            normals, middle = self.normals[index][kept], points[kept].mean(axis=0)
            rows = np.hstack([np.cross(points[kept] - middle, normals), normals])
            step = np.linalg.lstsq(rows, -off[kept])[0]
            angle = float(np.linalg.norm(step[:3]))
            axis = step[:3] / max(angle, 1e-12)
            turn = rotation_about(axis, float(np.degrees(angle)))
            points = (points - middle) @ turn.T + middle + step[3:]
        return points


def main() -> None:
    rows = []
    for standing in OBJECTS:
        before, after, moved = left_mm(standing)
        figures = [f"{f(before):.2f} → {f(after):.2f}" for f in (np.mean, _rms, _at_95)]
        rows.append([standing.frame, standing.name, str(len(before)), *figures, f"{moved:.0%}"])
        print(".", end="", flush=True)
    print()
    print_table(("frame", "object", "readings", "mean, mm", "rms", "95 %", "moved"), rows)


def left_mm(standing: Standing) -> tuple[FloatArray, FloatArray, float]:
    """Return what readings leave (n,) without and with the correction, and the share it moves."""
    view, up = seen(standing)
    form = Form.read(standing.name)
    start = _start(form, view.surface_points, up)
    corrected = without_matching_error(view)
    moved = float((np.abs(corrected.raw - view.raw)[view.known] > 0.05).mean())
    without, left = (form.fitted(one.surface_points, start) for one in (view, corrected))
    own = form.away_mm(without) < _OWN_MM  # the others are of what stands behind
    return np.abs(form.off_mm(without[own])[0]), np.abs(form.off_mm(left[own])[0]), moved


def _rms(values: FloatArray) -> float:
    return float(np.sqrt((values**2).mean()))


def _at_95(values: FloatArray) -> float:
    return float(np.quantile(values, 0.95))


def seen(standing: Standing) -> tuple[DepthView, FloatArray]:
    """Return the readings of an object, in the depth camera's own pixels, and the upright (3,)."""
    sensor = _sensor()
    depth, color = (_picture(f"{standing.frame}-{kind}.png") for kind in ("depth", "color"))
    v, u = np.nonzero(depth)
    z = depth[v, u] * _UNIT_MM
    rays = sensor.color_camera.normalised(np.column_stack([u, v]).astype(float))
    points = transform(inverse(sensor.depth2color), np.column_stack([rays * z[:, None], z]))
    first_u, first_v, last_u, last_v = standing.box
    boxed = (u >= first_u) & (u <= last_u) & (v >= first_v) & (v <= last_v)
    near = points[:, 2] < np.quantile(points[boxed, 2], 0.02) + 2 * _DEEP_MM
    normal, height = _table(points[near], v[near])
    over = points @ normal - height
    own = boxed & (over > _ABOVE_MM)
    middle = np.median(points[own], axis=0)
    own &= np.linalg.norm(points - middle, axis=1) < _DEEP_MM / 2
    camera = sensor.depth_camera
    where = np.round(camera.project(points[own])).astype(int)
    corner = where.min(axis=0) - 3
    width, rows = where.max(axis=0) - corner + 4
    cell = (where - corner) @ [1, width]
    order = np.argsort(cell, kind="stable")
    cells, starts = np.unique(cell[order], return_index=True)
    raw = np.full(rows * width, np.nan)
    for number, part in zip(cells, np.split(points[own][order, 2], starts[1:]), strict=True):
        raw[number] = sensor.disparity.raw(np.median(part))
    view = DepthView(
        standing.frame, sensor, np.eye(4), tuple(corner), raw.reshape(rows, width), color
    )
    return view, normal


def _picture(name: str) -> NDArray[Any]:
    picture = cv2.imread(str(FOLDER / name), cv2.IMREAD_UNCHANGED)
    assert picture is not None, name
    return np.asarray(picture if picture.ndim == 2 else picture[..., ::-1])


def _sensor() -> Sensor:
    rig = json.loads((FOLDER / "camera.json").read_text("utf-8"))["rig"]["camera"]
    nominal = nominal_kinect("xtion")
    cameras = []
    for one, camera in zip(rig, (nominal.color_camera, nominal.depth_camera), strict=True):
        fx, fy, cx, cy = one["camera_model"]["params"][:4]
        plain = replace(camera, width=640, height=480, fx=fx, fy=fy, cx=cx, cy=cy)
        cameras.append(plain)
    color2depth = np.vstack([rig[0]["pose"], [0, 0, 0, 1]]) * np.array([1, 1, 1, 1000.0])
    color2depth[3, 3] = 1.0
    return replace(
        nominal, color_camera=cameras[0], depth_camera=cameras[1], depth2color=inverse(color2depth)
    )


def _table(points: FloatArray, row: FloatArray) -> tuple[FloatArray, float]:
    """Find the plane on which most points lie, its normal (3,) upwards and its distance, mm."""
    rng, best = np.random.default_rng(1), (0, np.eye(3)[1], 0.0)
    some = points[rng.permutation(len(points))[:8000]]
    for _ in range(400):
        a, b, c = some[rng.integers(len(some), size=3)]
        normal = np.cross(b - a, c - a)
        if np.linalg.norm(normal) < 100:
            continue
        normal = normal / np.linalg.norm(normal) * (-1 if normal[1] > 0 else 1)
        count = int((np.abs((some - a) @ normal) < 4).sum())
        if count > best[0]:
            best = (count, normal, float(a @ normal))
    near = some[np.abs(some @ best[1] - best[2]) < 6]
    middle = near.mean(axis=0)
    normal = np.linalg.svd(near - middle, full_matrices=False)[2][2]
    normal *= np.sign(normal @ best[1])
    return normal, float(middle @ normal)


def _start(form: Form, points: FloatArray, up: FloatArray) -> FloatArray:
    """Find the turn about the upright from which an object fits the readings best."""
    aside = np.cross(up, [0.0, 0.0, 1.0])
    aside /= np.linalg.norm(aside)
    upright = np.stack([aside, np.cross(up, aside), up])
    starts = []
    points = points[::8]
    for number in range(_STARTS):
        turn = rotation_about(np.array([0.0, 0.0, 1.0]), 360.0 * number / _STARTS) @ upright
        # The far side is not seen: the readings lie on the near one.
        toward = turn @ np.array([0.0, 0.0, -1.0])
        middle = points.mean(axis=0) @ turn.T
        reach = np.quantile(form.points @ toward, 0.8) * toward * [1, 1, 0]
        top = form.points[:, 2].max() - np.quantile(points @ turn.T, 0.98, axis=0)[2]
        move = np.array([*(reach - middle)[:2], top])
        start = rigid(turn, move)
        away = form.away_mm(form.fitted(points, start))
        starts.append((float(np.minimum(away, _OWN_MM).mean()), number, start))
    return min(starts, key=lambda one: one[:2])[2]
