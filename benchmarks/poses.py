"""How well the poses of the sensors are known, from one colour frame and from ten.

Random scenes with ideal depth are simulated with colour pictures of two sizes. For every view, the
errors of its turn and of its place (of a point in the middle of the foot), and beside them the
Cramér-Rao bound of the turn: what the noise of the colour pictures alone would leave, if the edges
of the markers' faces were the only information. The bound is that of the same markers, with a
centre's deviation from the blueness's noise and the steepness of its rim.

The limits are those of the top view, which sees the fewest markers.

``python -c "import benchmarks.poses as b; b.run(50)"`` runs more; ``main()`` a sample.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from benchmarks._measure import print_table
from insole_core.calibration.boards.printed_page import MARKER_MM
from insole_core.geometry.arrays import Float32Array, FloatArray
from insole_core.geometry.transforms import inverse, rotation_angle_deg, transform
from insole_core.reconstruct.markers.marker_observation import Registration
from insole_core.reconstruct.views.measured_view import measure_view
from insole_core.recording.session import ReferenceSystem, View
from insole_core.simulate import SimulationOptions, simulate_session

SAMPLE = 6
LARGEST_TOP_TURN_DEG = {(1280, 1024): 0.1, (640, 480): 0.2}
"""Root mean square, by the size of the picture; 0.1 is wanted for both."""
FRAMES = (1, 10)
MIDDLE_MM = np.array([0.0, 0.0, 20.0])


@dataclass(frozen=True)
class PoseError:
    """The errors of one pose, and the bound of its turn."""

    turn_deg: float
    place_mm: float
    bound_deg: float


def main() -> None:
    run(SAMPLE)


def run(scenes: int, first: int = 1) -> None:
    errors: dict[tuple[tuple[int, int], str, int], list[PoseError]] = defaultdict(list)
    for size in LARGEST_TOP_TURN_DEG:
        for seed in range(first, first + scenes):
            for view, frames, error in _errors(seed, size):
                errors[size, view, frames].append(error)
    rows = []
    for (size, view, frames), found in errors.items():
        turns = np.array([error.turn_deg for error in found])
        rows.append(
            [
                f"{size[0]} x {size[1]}",
                view,
                frames,
                f"{_rms(turns):.3f}",
                f"{turns.max():.3f}",
                f"{_rms([error.place_mm for error in found]):.2f}",
                f"{_rms([error.bound_deg for error in found]):.4f}",
            ]
        )
    print_table(
        ["picture", "view", "frames", "turn (deg)", "largest", "place (mm)", "bound (deg)"], rows
    )
    for (size, view, frames), found in errors.items():
        turn_deg = _rms([error.turn_deg for error in found])
        limit_deg = LARGEST_TOP_TURN_DEG[size]
        if view == "top" and turn_deg > limit_deg:
            raise SystemExit(
                f"the top view of {size[0]} x {size[1]} px, {frames} frames, is turned by "
                f"{turn_deg:.3f} degrees, limit {limit_deg}"
            )


def _errors(seed: int, size: tuple[int, int]) -> Iterator[tuple[str, int, PoseError]]:
    rng = np.random.default_rng(seed)
    simulated = simulate_session(
        SimulationOptions(
            seed=seed,
            distance_mm=rng.uniform(650, 850),
            frames=3,
            color_frames=max(FRAMES),
            color_size=size,
            foot_cell_mm=4.0,
            ideal=True,
        )
    )
    system = simulated.session.manifest.reference_system
    for view in simulated.session.views:
        true = simulated.sensor2reference[view.name]
        noise = _blueness_noise(view)
        for frames in FRAMES:
            registration = measure_view(replace(view, color_count=frames)).register(system)
            pose = registration.sensor2reference
            yield (
                view.name,
                frames,
                PoseError(
                    rotation_angle_deg(pose[:3, :3] @ true[:3, :3].T),
                    float(np.linalg.norm(transform(pose @ inverse(true), MIDDLE_MM) - MIDDLE_MM)),
                    _bound_deg(registration, view, system, true, noise / np.sqrt(frames)),
                ),
            )


def _blueness_noise(view: View) -> float:
    """Return the deviation of the blueness from frame to frame, where it is a marker's."""
    first, second = (view.read_color(index).astype(np.float32) for index in (0, 1))
    change = _blueness(first) - _blueness(second)
    return float(change[_blueness(first) > _MARKER_LEVEL].std() / np.sqrt(2))


def _blueness(color: Float32Array) -> Float32Array:
    return np.asarray(color[..., 2] - color[..., :2].max(axis=2))


_MARKER_LEVEL = 60.0
_USUAL_LEVEL = 100.0
_BLUR_PX = 0.66
"""Of the lens and of the area of a pixel together."""


def _bound_deg(
    registration: Registration,
    view: View,
    system: ReferenceSystem,
    true: FloatArray,
    noise: float,
) -> float:
    """Compute the Cramér-Rao bound of the turn, all axes together.

    An edge that rises over a Gaussian of deviation s by a level A is known, from one row of pixels
    with noise n, to n² 2 √π s / A² px²; a centre is the mean of two edges as many rows long as the
    face is wide.
    """
    camera = view.sensor.color_camera
    reference2color = view.sensor.depth2color @ inverse(true)
    used = {fix.id for fix in registration.fixes if fix.used}
    markers = np.array([m.position_mm for m in system.markers if m.id in used])
    seen = transform(reference2color, markers)
    rows = camera.fx * MARKER_MM / seen[:, 2].mean()
    row_variance = noise**2 * 2 * np.sqrt(np.pi) * _BLUR_PX / _USUAL_LEVEL**2
    deviation_px = np.sqrt(row_variance / (2 * rows))
    step = 1e-4
    arms = seen - seen.mean(0)
    moves = [step * np.cross(axis, arms) for axis in np.eye(3)]
    moves += [np.broadcast_to(step * axis, arms.shape) for axis in np.eye(3)]
    design = np.stack(
        [(camera.project(seen + move) - camera.project(seen)).ravel() / step for move in moves],
        axis=1,
    )
    covariance = deviation_px**2 * np.linalg.inv(design.T @ design)
    return float(np.degrees(np.sqrt(np.trace(covariance[:3, :3]))))


def _rms(values: FloatArray | list[float]) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
