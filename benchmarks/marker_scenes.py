"""Random pictures of random marker systems: are all markers identified correctly by colour?

Each scene draws a marker system, a camera with its distortion and resolution, a stand-off, slant
and turn about the axis, exposure, noise, blur, blue objects that are not markers, and hides up to a
third of the markers. It counts accepted scenes with a wrong identity, or with a
pose off by more than 5 mm at the markers (neither may occur), and scenes refused.

``python -c "import benchmarks.marker_scenes as b; b.main(3000)"`` runs all; ``main()`` a sample.
"""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass

import cv2
import numpy as np

from benchmarks._measure import print_table
from insole_core.errors import ReconstructionError
from insole_core.geometry.transforms import inverse, rigid, rotation_about, transform
from insole_core.reconstruct.markers.blobs import find_blobs, sharpened
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.poses.registration import PoseSearch
from insole_core.recording.session import Marker, ReferenceSystem
from insole_core.sensing.disparity import LinearInverseDisparity
from insole_core.sensing.pinhole_camera import PinholeCamera
from insole_core.sensing.sensor import Sensor

SAMPLE = 150
FULL = 3000
WRONG_MM = 5.0
LEAST_SEEN, HALF_WIDTH_PX = 6, 18
BLOCK_MM, BLOCK_DEPTH_MM = 15.8, 11.2
BLUE = np.array([22.0, 52, 168])


@dataclass(frozen=True)
class Scene:
    picture: np.ndarray
    sensor: Sensor
    system: ReferenceSystem
    reference2color: np.ndarray
    pixels: dict[str, np.ndarray]
    seen: int


def random_scene(rng: np.random.Generator) -> Scene:
    """Draw scenes until at least six markers, and two thirds of all, are entirely visible."""
    while True:
        scene = _scene(rng)
        if scene.seen >= max(LEAST_SEEN, 2 * len(scene.system.markers) / 3):
            return scene


def _scene(rng: np.random.Generator) -> Scene:
    positions = _positions(rng)
    camera = _camera(rng)
    pose = _pose(rng, positions)
    hidden = rng.permutation(len(positions))[: _hidden_count(rng, len(positions))]
    pixels = camera.project(transform(pose, positions))
    covers = [(pixels[i], camera.width / 1280 * rng.uniform(23, 30)) for i in hidden]
    room = np.full((2 * camera.height, 2 * camera.width, 3), rng.uniform(15, 60), np.float32)
    _paint_clutter(rng, room)
    clear = camera.width / 1280 * HALF_WIDTH_PX
    seen = sum(
        all(np.linalg.norm(pixel - at) > radius + clear for at, radius in covers)
        and _stands_free(room, pixel, clear)
        for pixel in pixels
    )
    picture = _picture(rng, room, (camera, pose), positions, covers)
    sensor = Sensor(
        "kinect-v1", "SCENE", camera, camera, np.eye(4), LinearInverseDisparity(3.33, -0.00307),
        faces=("sole",),
    )  # fmt: skip
    named = {f"S{i}": pixel for i, pixel in enumerate(pixels)}
    return Scene(picture, sensor, _system(positions), pose, named, seen)


def _stands_free(room: np.ndarray, pixel: np.ndarray, clear: float) -> bool:
    """Return whether a marker is in the picture with no blue clutter behind it."""
    (u, v), reach = np.rint(2 * pixel).astype(int), round(2 * clear)
    if not (reach < u < room.shape[1] - reach and reach < v < room.shape[0] - reach):
        return False
    around = room[v - reach : v + reach, u - reach : u + reach]
    return bool((around[..., 2] <= around[..., :2].max(-1)).all())


def _positions(rng: np.random.Generator) -> np.ndarray:
    """Draw blocks in a frame around the foot at random positions, at least 28 mm apart."""
    count = int(rng.integers(8, 15))
    half = np.array([rng.uniform(75, 100), rng.uniform(120, 165)])
    chosen: list[np.ndarray] = []
    while len(chosen) < count:
        place = rng.uniform(-half, half)
        side = rng.integers(0, 2)
        place[side] = half[side] * rng.choice([-1, 1]) + rng.uniform(-10, 10)
        if all(np.linalg.norm(place - other[:2]) > 28 for other in chosen):
            chosen.append(np.array([*place, rng.choice([-9.6, 0, 9.6, 19.2, 28.8])]))
    return np.array(chosen)


def _system(positions: np.ndarray) -> ReferenceSystem:
    markers = tuple(
        Marker(f"S{i}", (float(x), float(y), float(z)), "sole")
        for i, (x, y, z) in enumerate(positions)
    )
    return ReferenceSystem("random", markers)


def _hidden_count(rng: np.random.Generator, count: int) -> int:
    return int(rng.integers(0, min(count // 3, count - 6) + 1))


def _camera(rng: np.random.Generator) -> PinholeCamera:
    width, height = ((1280, 1024), (1280, 960), (640, 480))[rng.integers(0, 3)]
    focal = rng.uniform(1015, 1060) * width / 1280
    center = np.array([width, height]) / 2 + rng.normal(0, 8, 2)
    bend = (rng.uniform(0.05, 0.2), rng.uniform(-0.4, -0.1), 0.0, 0.0, 0.0)
    cx, cy = center.tolist()
    return PinholeCamera(width, height, focal, focal, cx, cy, bend)


def _pose(rng: np.random.Generator, positions: np.ndarray) -> np.ndarray:
    """Draw a camera facing the markers (at negative z), tilted by up to 40°, rotated at random."""
    slant = rotation_about(np.array([*rng.normal(size=2), 0.0]), rng.uniform(0, 40))
    turn = rotation_about(np.array([0.0, 0, 1]), rng.uniform(0, 360))
    rotation = turn @ slant
    ahead = np.array([*rng.uniform(-25, 25, 2), rng.uniform(620, 1000)])
    return rigid(rotation, ahead - rotation @ positions.mean(0))


def _picture(
    rng: np.random.Generator,
    room: np.ndarray,
    seen_by: tuple[PinholeCamera, np.ndarray],
    positions: np.ndarray,
    covers: list[tuple[np.ndarray, float]],
) -> np.ndarray:
    """Paint from far to near at twice the resolution, then blur, expose and add noise."""
    image, (camera, pose) = room.copy(), seen_by
    for i in np.argsort(-transform(pose, positions)[:, 2]):
        _paint_block(image, camera, pose, positions[i], rng.uniform(0.85, 1.1))
    for at, radius in covers:
        _paint_cover(rng, image, at, radius)
    image = cv2.GaussianBlur(image, (0, 0), rng.uniform(1.0, 2.4))
    small = cv2.resize(image, (camera.width, camera.height), interpolation=cv2.INTER_AREA)
    noise = rng.standard_normal(small.shape, np.float32) * rng.uniform(1, 5)
    exposed = small * rng.uniform(0.45, 1.6) + noise
    return np.asarray(np.clip(np.rint(exposed), 0, 255).astype(np.uint8))


def _paint_block(
    image: np.ndarray, camera: PinholeCamera, pose: np.ndarray, face: np.ndarray, light: float
) -> None:
    half = BLOCK_MM / 2
    square = np.array([[-half, -half, 0], [half, -half, 0], [half, half, 0], [-half, half, 0]])
    front = face + square
    back = front + np.array([0, 0, BLOCK_DEPTH_MM])
    eye = -pose[:3, :3].T @ pose[:3, 3]
    for i in range(4):
        j = (i + 1) % 4
        outward = square[i] + square[j]
        if (eye - front[i]) @ outward > 0:
            _paint(image, camera, pose, np.array([front[i], front[j], back[j], back[i]]), 80.0)
    _paint(image, camera, pose, front, BLUE * light)


def _paint(
    image: np.ndarray,
    camera: PinholeCamera,
    pose: np.ndarray,
    corners: np.ndarray,
    color: np.ndarray | float,
) -> None:
    pixels = camera.project(transform(pose, corners)) * 2 + 0.5
    fixed = np.rint(pixels * 16).astype(np.int32)
    shade = tuple(np.broadcast_to(color, 3).tolist())
    cv2.fillConvexPoly(image, fixed, shade, cv2.LINE_8, 4)


def _paint_cover(
    rng: np.random.Generator, image: np.ndarray, center: np.ndarray, radius: float
) -> None:
    """Paint a hand or a cloth in front of a marker."""
    skin = (200.0, 150.0, 125.0) if rng.random() < 0.5 else (90.0, 90.0, 95.0)
    at = tuple(np.rint(2 * center).astype(int).tolist())
    cv2.circle(image, at, round(2 * radius), skin, cv2.FILLED)


def _paint_clutter(rng: np.random.Generator, image: np.ndarray) -> None:
    height, width = image.shape[:2]
    foot = (width // 2, height // 2)
    size = (round(0.06 * width), round(0.16 * width))
    cv2.ellipse(image, foot, size, rng.uniform(0, 360), 0, 360, (205.0, 155.0, 130.0), cv2.FILLED)
    for _ in range(rng.integers(0, 12)):
        at = (rng.uniform(0.05, 0.95, 2) * [width, height]).astype(int)
        shade = tuple((BLUE * rng.uniform(0.5, 1.3)).tolist())
        side = rng.uniform(0.006, 0.05, 2) * width
        corners = cv2.boxPoints((at.astype(float).tolist(), side.tolist(), rng.uniform(0, 90)))
        cv2.fillConvexPoly(image, np.rint(corners).astype(np.int32), shade)


def judge(scene: Scene) -> str:
    """Return the outcome of a scene: right, refused, wrong name, wrong pose."""
    blobs = sharpened(scene.picture, find_blobs(scene.picture))
    try:
        found = PoseSearch(scene.system, scene.sensor).in_image(blobs)
    except ReconstructionError as error:
        return f"refused: {str(error)[:40]}"
    return _verdict(scene, found)


def _verdict(scene: Scene, found: Registration) -> str:
    near_px = 6 * scene.sensor.color_camera.width / 1280
    for fix in found.fixes:
        if fix.used and np.linalg.norm(scene.pixels[fix.id] - fix.pixel) > near_px:
            return "WRONG NAME"
    positions = np.array([marker.position_mm for marker in scene.system.markers])
    color2true = inverse(scene.reference2color)
    moved = transform(color2true, transform(inverse(found.sensor2reference), positions))
    if np.linalg.norm(moved - positions, axis=1).mean() > WRONG_MM:
        return "WRONG POSE"
    return "right"


def main(count: int = SAMPLE) -> None:
    verdicts: Counter[str] = Counter()
    start = time.perf_counter()
    for seed in range(count):
        verdicts[judge(random_scene(np.random.default_rng(seed)))] += 1
    seconds = time.perf_counter() - start
    refused = sum(number for verdict, number in verdicts.items() if verdict.startswith("refused"))
    rows = [
        [verdict, number, f"{number / count:.2%}"] for verdict, number in verdicts.most_common()
    ]
    print_table(["verdict", "scenes", "share"], rows)
    print(
        f"{count} scenes, refused {refused / count:.2%} (limit 1 %), {seconds / count:.2f} s each"
    )
