"""The simulated sensor beside real ones: a ball, in single frames.

Of every frame the best ball (in centre and radius) and a quadratic over the image (for what a
device's calibration leaves) are subtracted. What remains is the error of matching: its size, over
how many pixels it is alike, and how it grows with the slant. The figures of real sensors are those
of nine captures of a ball at 0.88 - 1.43 m; the temporal noise is that on a wall.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
import trimesh

from benchmarks._measure import print_table
from insole_core.geometry.mesh import TriangleMesh
from insole_core.sensing.disparity import NO_READING
from insole_core.simulate.block_matching import MatchedRecording, Matcher, record_matched_depth
from insole_core.simulate.device import Device, make_device
from insole_core.simulate.scene import SceneCaster

DISTANCES_MM = (880, 900, 920, 940, 960, 980, 1000, 1100, 1430)
RADIUS_MM = 100.0
LAGS_PX = (1, 2, 4, 6, 9)
SLANTS_DEG = ((0, 20), (20, 35), (35, 45), (45, 55))
REAL = {
    "rms, raw": (0.58,),
    "alike in x at 1/2/4/6/9 px": (0.64, 0.48, 0.24, 0.06, -0.02),
    "alike in y": (0.67, 0.53, 0.32, 0.15, 0.03),
    "rms at 0-20/20-35/35-45/45-55 deg": (0.52, 0.57, 0.56, 0.64),
    "from frame to frame on a wall": (0.39,),
}
FORMER = Matcher((9, 9), speckle_contrast=0.2, shot_noise=0.27, read_noise=0.09, px_per_dot=9.0)
"""The matcher that the first weights of the correction were trained with."""
LARGEST_DIFFERENCE = 0.1


def main() -> None:
    now, former = _figures(Matcher()), _figures(FORMER)
    rows = [
        (name, _shown(real), _shown(now[name]), _shown(former[name])) for name, real in REAL.items()
    ]
    print_table(("figure", "real", "simulated", "formerly"), rows)
    worst = max(np.abs(np.subtract(now[name], real)).max() for name, real in REAL.items())
    print(f"largest difference {worst:.2f}, limit {LARGEST_DIFFERENCE}")
    if worst > LARGEST_DIFFERENCE:
        raise SystemExit("the simulated sensor is unlike real ones")


def _figures(matcher: Matcher) -> dict[str, tuple[float, ...]]:
    balls = [_ball_errors(d, seed, matcher) for seed in (0, 100) for d in DISTANCES_MM]
    rms = [np.sqrt(np.nanmean(ball.error**2)) for ball in balls]
    across = np.mean([_alike(ball.error) for ball in balls], axis=0)
    down = np.mean([_alike(ball.error.T) for ball in balls], axis=0)
    slant = np.mean([ball.rms_by_slant() for ball in balls], axis=0)
    wall = [_changing(distance_mm, matcher) for distance_mm in (750, 1100)]
    values = ([np.mean(rms)], across, down, slant, [np.mean(wall)])
    return {name: tuple(map(float, value)) for name, value in zip(REAL, values, strict=True)}


@dataclass(frozen=True, eq=False)
class _Ball:
    """What is left of a frame: error (480, 640), raw units, NaN elsewhere; slant likewise."""

    error: np.ndarray
    slant_deg: np.ndarray

    def rms_by_slant(self) -> list[float]:
        within = [(self.slant_deg >= low) & (self.slant_deg < high) for low, high in SLANTS_DEG]
        return [float(np.sqrt(np.nanmean(self.error[part] ** 2))) for part in within]


def _ball_errors(distance_mm: float, seed: int, matcher: Matcher) -> _Ball:
    rng = np.random.default_rng([seed, int(distance_mm)])
    ball = trimesh.creation.icosphere(subdivisions=5, radius=RADIUS_MM)
    middle = [*rng.uniform(-60, 60, 2), distance_mm + RADIUS_MM]
    mesh = TriangleMesh(np.asarray(ball.vertices) + middle, np.asarray(ball.faces))
    device = make_device("ball", (), distance_mm, (640, 480), rng)
    frame = _recording(mesh, device, rng, matcher).frame(rng)
    v, u = np.nonzero(frame < NO_READING)
    pixels = np.column_stack([u, v]).astype(float)
    flat = np.full(len(pixels), device.reference_raw)
    raw = frame[v, u] - (device.distort_at(flat, pixels) - flat)
    error, slant_deg = _off_the_ball(raw, pixels, device)
    used = (slant_deg < SLANTS_DEG[-1][1]) & (np.abs(error) < 4)
    images = np.full((2, *frame.shape), np.nan)
    images[:, v[used], u[used]] = _without_quadratic(error[used], pixels[used]), slant_deg[used]
    return _Ball(*images)


def _recording(
    mesh: TriangleMesh, device: Device, rng: np.random.Generator, matcher: Matcher
) -> MatchedRecording:
    caster, pose = SceneCaster(mesh), np.eye(4)
    return record_matched_depth(caster, device, pose, rng, things=mesh.vertices, matcher=matcher)


def _off_the_ball(
    raw: np.ndarray, pixels: np.ndarray, device: Device
) -> tuple[np.ndarray, np.ndarray]:
    """Return the raw error (n,) of readings against the ball that fits them, and the slant."""
    sensor = device.sensor
    rays = np.column_stack([sensor.depth_camera.normalised(pixels), np.ones(len(pixels))])
    points = rays * sensor.disparity.depth_mm(raw)[:, None]
    square = (rays**2).sum(axis=1)

    def depth_mm(ball: np.ndarray) -> np.ndarray:
        along = rays @ ball[:3]
        within = along**2 - square * (ball[:3] @ ball[:3] - ball[3] ** 2)
        return np.where(within > 0, (along - np.sqrt(np.maximum(within, 0))) / square, np.nan)

    def error(ball: np.ndarray) -> np.ndarray:
        return np.asarray(raw - sensor.disparity.raw(depth_mm(ball)))

    def robust(ball: np.ndarray) -> np.ndarray:
        off = np.nan_to_num(error(ball))
        return np.where(np.abs(off) < 6, off, 0)

    line = np.linalg.lstsq(np.c_[2 * points, np.ones(len(raw))], (points**2).sum(axis=1))[0]
    start = np.r_[line[:3], np.sqrt(line[3] + line[:3] @ line[:3])]
    ball = scipy.optimize.least_squares(robust, start, loss="soft_l1").x
    normals = (rays * depth_mm(ball)[:, None] - ball[:3]) / ball[3]
    cosine = -np.einsum("nc,nc->n", normals, rays) / np.sqrt(square)
    return error(ball), np.degrees(np.arccos(np.clip(np.nan_to_num(cosine), 0, 1)))


def _without_quadratic(error: np.ndarray, pixels: np.ndarray) -> np.ndarray:
    x, y = ((pixels - pixels.mean(axis=0)) / 50).T
    terms = np.column_stack([np.ones(len(x)), x, y, x**2, y**2, x * y])
    return np.asarray(error - terms @ np.linalg.lstsq(terms, error)[0])


def _alike(error: np.ndarray) -> np.ndarray:
    """Return the autocorrelation along the rows at the lags."""
    pairs = [error[:, :-lag] * error[:, lag:] for lag in LAGS_PX]
    return np.asarray([np.nanmean(pair) for pair in pairs] / np.nanmean(error**2))


def _changing(distance_mm: float, matcher: Matcher) -> float:
    rng = np.random.default_rng(int(distance_mm))
    corners = 140.0 * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    wall = TriangleMesh(corners + np.array([0, 0, distance_mm]), np.array([[0, 1, 2], [0, 2, 3]]))
    device = make_device("wall", (), distance_mm, (640, 480), rng)
    recording = _recording(wall, device, rng, matcher)
    frames = np.stack([recording.frame(rng).astype(float) for _ in range(5)])
    always = np.asarray((frames < NO_READING).all(axis=0))
    inner = scipy.ndimage.binary_erosion(always, iterations=12)
    return float(np.sqrt(frames.var(axis=0, ddof=1)[inner].mean()))


def _shown(values: tuple[float, ...]) -> str:
    return " / ".join(f"{value:.2f}" for value in values)
