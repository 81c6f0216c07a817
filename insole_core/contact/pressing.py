"""Press a rigid bone with soft tissue on layers: where it touches, and how hard.

At a node the beds sink by what presses on it and around it. The pressure is found that is nowhere
negative, is zero where a gap is left, and adds up to the load about its centre; sinking and two
tilts of the bone follow. What touches is sought by an active set (as Hintermüller, Ito and
Kunisch, SIAM J. Optim. 13, 2002), its pressures by conjugate gradients, and the sinking by Fourier
transforms.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import cv2
import numpy as np
import numpy.typing as npt
import scipy

from insole_core.contact.elastic_layers import Layer, compliance
from insole_core.errors import InputError
from insole_core.geometry.arrays import BoolArray, Float32Array, FloatArray

BESIDE = 2.0
"""Room beside a grid, in thicknesses of the thickest stack, in which what a load makes sink fades
out before it comes round again; enough for all that gives way sideways as easily as a foot does."""
_TABLE = 600
_SPECTRA = 512
"""Stacks of layers whose sinking is kept: while a pad is drawn, they stay the same."""
_LEAST_TISSUE_MM = 1e-3
_LEAST_SOFT = 1e-6
"""Share of the softest place's softness: what is harder is taken to be as hard."""
_ROUNDS, _STEPS = 40, 80
_ROUGH, _FINE = 3e-2, 1e-3
"""What is left of overlaps and gaps where all should touch, as a share of what the load makes sink:
while it is still sought what touches, and at the end."""
_FEW = 0.02
"""Share of what touches that may still change when the fine search begins."""
_SLIGHT = 1e-3
"""Of the greatest pressure and sinking: less of it, of the wrong sign, changes nothing."""
_SAME = 2e-3
"""Strain of the tissue that may still change."""
_SENSOR_MM = 10.0
"""Side of a usual sensor: peaks are those of the mean over so much, as a measurement shows them."""
_FOLLOWED, _FOLLOWED_SAME, _FOLLOWED_ROUNDS = 1e-2, 1e-2, 4
"""As `_FINE`, `_SAME` and `_ROUNDS`, while a support is followed as it is drawn."""
_TOO_MANY = 0.05
"""Share of what touches that changes at a step too long to be followed."""


@dataclass(frozen=True, eq=False)
class Bed:
    """A stack of layers below a part of a grid.

    Parameters
    ----------
    layers
        From the loaded face down.
    share : (ny, nx) float64
        How much each node has of this bed.
    tissue_mm
        Thickness of tissue, whose pressure goes with its strain e as e / (1 - e); 0 for what is
        linear.
    counted
        Layers whose part of the sinking another bed gives already.
    """

    layers: tuple[Layer, ...]
    share: FloatArray
    tissue_mm: float = 0.0
    counted: tuple[Layer, ...] = ()

    @property
    def thickness_mm(self) -> float:
        """Of all layers."""
        return sum(layer.thickness_mm for layer in self.layers)


@dataclass(frozen=True, eq=False)
class Pressed:
    """A foot that is pressed on its support.

    Parameters
    ----------
    mpa : (ny, nx) float64
        Pressure at the nodes, nowhere negative; its sum is the load.
    sunk_mm : (ny, nx) float64
        How far the beds that are no tissue have sunk.
    strain : (ny, nx) float64
        Of the tissue.
    sinking_mm
        Of the bone at the load's centre.
    slope
        Of the bone, along x and y.
    step_mm
        Distance of the nodes.
    """

    mpa: FloatArray
    sunk_mm: FloatArray
    strain: FloatArray
    sinking_mm: float
    slope: tuple[float, float]
    step_mm: float

    @cached_property
    def sensed_kpa(self) -> FloatArray:
        """(ny, nx) kPa as sensors show it: means over squares of `_SENSOR_MM` about nodes."""
        steps = _SENSOR_MM / self.step_mm
        whole = 2 * int((steps - 1) // 2) + 1
        inner, outer = (
            cv2.blur(self.mpa, (side, side), borderType=cv2.BORDER_CONSTANT)
            for side in (whole, whole + 2)
        )
        share = (steps**2 - whole**2) / ((whole + 2) ** 2 - whole**2)
        by_area = (1 - share) * whole**2 * inner + share * (whole + 2) ** 2 * outer
        return np.asarray(1000 * by_area / steps**2)


class Support:
    """All that gives way under a bone, its tissue included, on a grid of nodes.

    Parameters
    ----------
    shape
        Rows and columns of the grid; a single row is a section of something long.
    step_mm
        Distance of the nodes.
    beds
    beside
        As `BESIDE`.
    """

    def __init__(
        self, shape: tuple[int, int], step_mm: float, beds: Sequence[Bed], beside: float = BESIDE
    ) -> None:
        self.shape, self.step_mm = shape, step_mm
        room = int(np.ceil(beside * max(bed.thickness_mm for bed in beds) / step_mm))
        self._padded = tuple(
            1 if n == 1 else scipy.fft.next_fast_len(n + room, real=True) for n in shape
        )
        self._spectra = np.stack(
            [_spectrum(bed.layers, bed.counted, self._padded, step_mm) for bed in beds]
        )
        shares = np.stack([bed.share for bed in beds])
        thickness = np.array([bed.tissue_mm for bed in beds])
        self._roots, self._is_tissue = np.sqrt(shares).astype(np.float32), thickness > 0
        self._tissue_mm = np.maximum(np.tensordot(thickness, shares, 1), _LEAST_TISSUE_MM)

    def roots(self, strain: FloatArray) -> Float32Array:
        """(beds, ny, nx) square roots of what gives way, with tissue strained by (ny, nx)."""
        roots = self._roots.copy()
        roots[self._is_tissue] *= np.sqrt(1 - strain).astype(np.float32)
        return roots

    def sunk(self, mpa: FloatArray, roots: Float32Array) -> Float32Array:
        """(beds, ny, nx) how far each bed sinks under pressures (ny, nx), mm."""
        (rows, columns), (padded_rows, padded_columns) = self.shape, self._padded
        # Not by rfft2, which transforms the rows of the padding too: they hold and give nothing.
        waves = scipy.fft.rfft(mpa.astype(np.float32) * roots, padded_columns, axis=2)
        waves = scipy.fft.fft(waves, padded_rows, axis=1)
        waves *= self._spectra
        waves = scipy.fft.ifft(waves, axis=1, overwrite_x=True)[:, :rows]
        return np.asarray(roots * scipy.fft.irfft(waves, padded_columns, axis=2)[:, :, :columns])

    def softness(self, roots: Float32Array) -> FloatArray:
        """(ny, nx) how far each node sinks where all are pressed alike, mm/MPa."""
        alike = self._spectra[:, 0, 0]
        return np.asarray(np.tensordot(alike, roots * roots, 1), dtype=np.float64)

    def strain(self, sunk: Float32Array, before: FloatArray) -> FloatArray:
        """(ny, nx) strain of tissue that has sunk, as stiff as with a strain before.

        Without stiffening it would sink by v; with the thickness h its strain is v / (h + v), so
        that the pressure goes as e / (1 - e).
        """
        v = np.maximum(sunk[self._is_tissue].sum(axis=0), 0.0) / (1 - before)
        return np.asarray(v / (self._tissue_mm + v), dtype=np.float64)

    def layers_sunk(self, sunk: Float32Array) -> FloatArray:
        """(ny, nx) how far all that is no tissue has sunk, of what each bed has."""
        return np.asarray(sunk[~self._is_tissue].sum(axis=0), dtype=np.float64)

    def press(
        self,
        gap_mm: FloatArray,
        load_n: float,
        centre_mm: tuple[float, float],
        start: Pressed | None = None,
        *,
        follows: bool = False,
    ) -> Pressed:
        """Find the pressures under a load.

        Parameters
        ----------
        gap_mm : (ny, nx) float64
            Height of the sole over its support before it is pressed, up to a constant and two
            tilts; NaN where there is no sole.
        load_n
        centre_mm
            Of the load, along columns and rows from the first node.
        start
            What was found on a support much like this one, to start from.
        follows
            Go only a few rounds, from the start or from nothing, while the support is being drawn;
            where it has moved too far for that, as many as are needed.

        Raises
        ------
        InputError
            When no pressure has this centre.
        """
        return _Search(self, gap_mm, load_n, centre_mm).found(start, follows=follows)


@lru_cache(maxsize=_SPECTRA)
def _spectrum(
    layers: tuple[Layer, ...], counted: tuple[Layer, ...], shape: tuple[int, int], step_mm: float
) -> npt.NDArray[np.float32]:
    """(ny, nx // 2 + 1) sinking, mm/MPa, of layers without those counted, by waves on a grid."""
    along = 2 * np.pi * np.fft.fftfreq(shape[0], step_mm)
    across = 2 * np.pi * np.fft.rfftfreq(shape[1], step_mm)
    wave_number = np.hypot(along[:, None], across)
    sinking = np.maximum(_compliances(layers, step_mm) - _compliances(counted, step_mm), 0.0)
    spectrum = np.asarray(np.interp(wave_number, _wave_numbers(step_mm), sinking), np.float32)
    spectrum.flags.writeable = False
    return spectrum


def _wave_numbers(step_mm: float) -> FloatArray:
    """(n,) of all waves on a grid, 1/mm."""
    return np.linspace(0.0, np.pi * np.sqrt(2) / step_mm, _TABLE)


@lru_cache(maxsize=_SPECTRA)
def _compliances(layers: tuple[Layer, ...], step_mm: float) -> FloatArray:
    """(n,) sinking of layers, mm/MPa, by `_wave_numbers`."""
    return compliance(layers, _wave_numbers(step_mm))


class _Search:
    def __init__(
        self, support: Support, gap_mm: FloatArray, load_n: float, centre_mm: tuple[float, float]
    ) -> None:
        self._support = support
        self._sole: BoolArray = np.isfinite(gap_mm)
        self._gap = np.where(self._sole, gap_mm, 0.0)
        rows, columns = support.shape
        self._length = max(rows, columns) * support.step_mm
        x = (support.step_mm * np.arange(columns) - centre_mm[0]) / self._length
        y = (support.step_mm * np.arange(rows) - centre_mm[1]) / self._length
        across, along = np.broadcast_arrays(x, y[:, None])
        self._motions = np.stack([np.ones(support.shape), across, along])
        self._sums = np.array([load_n / support.step_mm ** (2 if rows > 1 else 1), 0.0, 0.0])

    def found(self, start: Pressed | None, *, follows: bool) -> Pressed:
        support, fine = self._support, start is not None
        rounds, finest, same = _ROUNDS, _FINE, _SAME
        mpa = strain = np.zeros(support.shape)
        touches = self._sole
        if start is not None:
            mpa, strain, touches = start.mpa, start.strain, self._sole & (start.mpa > 0)
        if follows:
            rounds, finest, same = _FOLLOWED_ROUNDS, _FOLLOWED, _FOLLOWED_SAME
        while rounds > 0:
            rounds -= 1
            roots = support.roots(strain)
            bone = _Bone(self._motions, touches, support.softness(roots))
            mpa, beds = self._balanced(mpa, bone, roots, finest if fine else _ROUGH)
            sunk = beds.sum(axis=0)
            motion = bone.motion(self._gap + sunk)
            overlap = np.tensordot(motion, self._motions, 1) - self._gap - sunk
            stays, joins = mpa > -_SLIGHT * mpa.max(), overlap > _SLIGHT * sunk.max()
            after = self._sole & np.where(touches, stays, joins)
            changed, touches = int((after != touches).sum()), after
            before, strain = strain, support.strain(beds, strain)
            is_settled = changed <= (_TOO_MANY * touches.sum() if follows else 0)
            if fine and is_settled and np.abs(strain - before).max() < same:
                break
            if follows and (rounds == 0 or not is_settled):
                follows = False  # the step is too long for that: the search goes on from here
                rounds, finest, same = _ROUNDS, _FINE, _SAME
            fine = changed <= _FEW * touches.sum()
        mpa = np.maximum(mpa, 0.0)
        mpa *= self._sums[0] / mpa.sum()
        if not self._is_centred(mpa):
            if follows:
                return self.found(start, follows=False)
            raise InputError(
                "No pressure on this sole has its centre where the load is; a part of the foot is "
                "missing in the scan, so scan the whole sole."
            )
        slope = float(motion[1] / self._length), float(motion[2] / self._length)
        return Pressed(
            mpa, support.layers_sunk(beds), strain, float(motion[0]), slope, support.step_mm
        )

    def _balanced(
        self, mpa: FloatArray, bone: _Bone, roots: Float32Array, left_over: float
    ) -> tuple[FloatArray, Float32Array]:
        """Return the pressures under which what touches lies together, and how the beds sink.

        Some may be negative. Every step of the conjugate gradients keeps load and centre; they are
        preconditioned by what each node sinks where all are pressed alike, which differs much
        between the heel and the hollow of the arch.
        """
        touches = bone.touches
        mpa = bone.with_sums(mpa * touches, self._sums)
        beds = self._support.sunk(mpa, roots)
        sunk = beds.sum(axis=0) * touches
        least = left_over**2 * _square(sunk)
        left = bone.without_motion(-self._gap * touches - sunk)
        way = bone.hardness * left
        work = float((left * way).sum())
        for _ in range(_STEPS):
            if _square(left) <= least:
                break
            answers = self._support.sunk(way, roots)
            answer = answers.sum(axis=0) * touches
            along = work / float((way * answer).sum())
            mpa, beds = mpa + along * way, beds + np.float32(along) * answers
            left = bone.without_motion(left - along * answer)
            more = bone.hardness * left
            before, work = work, float((left * more).sum())
            way = more + (work / before) * way
        return mpa, beds

    def _is_centred(self, mpa: FloatArray) -> bool:
        off = np.tensordot(self._motions[1:], mpa, 2) / mpa.sum() * self._length
        return bool(np.abs(off).max() < self._support.step_mm)


class _Bone:
    """The sinking and the two tilts of a rigid bone, where it touches.

    Heights and pressures are weighed by how hard the nodes are, so that a node of the soft hollow
    counts for little.

    Parameters
    ----------
    motions : (3, ny, nx) float64
        How far each node comes down by one of sinking and tilts.
    touches
    softness : (ny, nx) float64
        How far each node sinks where all are pressed alike, mm/MPa.
    """

    def __init__(self, motions: FloatArray, touches: BoolArray, softness: FloatArray) -> None:
        self.touches = touches
        self.hardness = 1 / np.maximum(softness, _LEAST_SOFT * softness.max())
        self._motions = (motions * touches).reshape(len(motions), -1)
        self._pressing = self._motions * self.hardness.ravel()
        # Of a single row a tilt is missing: the pseudo-inverse leaves it out. Of three rows numpy's
        # takes 0.08 ms, a third of all else that is made anew in a round, and OpenCV's 0.003.
        self._inverse = cv2.invert(self._pressing @ self._motions.T, flags=cv2.DECOMP_SVD)[1]

    def motion(self, heights: FloatArray) -> FloatArray:
        """(3,) at which the bone lies on heights (ny, nx) best."""
        return np.asarray(self._inverse @ (self._pressing @ heights.ravel()))

    def without_motion(self, heights: FloatArray) -> FloatArray:
        """(ny, nx) what is left of heights beside a motion; weighed, it has no load or moments."""
        return np.asarray(heights - (self.motion(heights) @ self._motions).reshape(heights.shape))

    def with_sums(self, mpa: FloatArray, sums: FloatArray) -> FloatArray:
        """(ny, nx) the nearest pressures that have sums (3,) over the motions."""
        missing = sums - self._motions @ mpa.ravel()
        return np.asarray(mpa + (self._inverse @ missing @ self._pressing).reshape(mpa.shape))


def _square(values: FloatArray) -> float:
    return float((values * values).sum())
