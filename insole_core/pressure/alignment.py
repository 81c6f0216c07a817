"""Lays a map of pressures, or a footprint, under its foot, as the sole is seen from above."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.messages import Message
from insole_core.pressure.laid_map import LOADED_KPA, Placement, PressureMap, centres_mm
from insole_core.pressure.recording import SeenFrom

CELL_MM = 2.0
AWAY_MM = 30.0
"""Height beside the sole; higher points of it never press on the ground."""
_AROUND_MM = 60.0
_FACING = -0.2
_GAP_CELLS = 5
_TURNS = np.arange(0.0, 360.0, 15.0)
_STARTS = 2  # directions that are refined, at least this far apart
_APART_DEG = 40.0
_DEEP_MM, _DEPTH_SPREAD_MM, _SOFT_MM = 6.0, 2.0, 1.0  # of the plane of contact above the sole
_PRINT_SOFT_MM, _PRINT_BLUR_MM = 2.0, 4.0
_OUTSIDE, _OUTSIDE_MM = 0.3, 10.0  # price of contact beside the sole, from this distance on
_PITCH, _ROLL = 0.01, 0.015  # usual slopes of the plane, along and across
_HALF_LOAD = 0.15  # of the peak: pressures count by contact more than by height
_AROUND = 3  # cells around the contact that say where nothing presses
_UNLOADED = 0.5  # weight of these, since toes may be missing and a map may be a part
_ROBUST = 0.3
_LEAST_SHARE = 0.45  # of the foot's length that the contact covers at least
_LEAST_CELLS, _LEAST_GROUP = 20, 4
_OTHER_SIDE = 1.1  # how much better one side fits than the other where the map tells them apart
_NO_FOOT = 0.35
"""Disagreement from which on the contact is not that of this foot."""


@dataclass(frozen=True, eq=False)
class SolePrint:
    """Heights of the sole over the ground.

    Parameters
    ----------
    heights_mm : (ny, nx) float64
        On cells of 2 mm; `AWAY_MM` beside the sole.
    first_mm
        x and y of the cell [0, 0], insole frame.
    is_beside : (ny, nx) bool
        Where there is no sole.
    length_mm
        Of the foot.
    """

    heights_mm: FloatArray
    first_mm: tuple[float, float]
    is_beside: BoolArray
    length_mm: float

    @staticmethod
    def of(foot: Foot) -> SolePrint:
        """Return the print of a foot; computed once."""
        made: SolePrint = foot.derived.get("sole print", (), lambda: _print_of(foot))
        return made

    def cells(self, points: FloatArray) -> FloatArray:
        """Return rows and columns (2, n) of points (n, 2) of the insole frame."""
        return np.asarray((points[:, ::-1] - self.first_mm[::-1]).T / CELL_MM)


def _print_of(foot: Foot) -> SolePrint:
    from scipy import ndimage

    even = foot.even
    facing = (even.normals[:, 2] < _FACING) & (even.points[:, 2] < AWAY_MM)
    points = even.points[facing if facing.any() else slice(None)]
    low = np.floor(points[:, :2].min(axis=0)) - _AROUND_MM
    size = np.ceil((points[:, :2].max(axis=0) + _AROUND_MM - low) / CELL_MM).astype(int) + 1
    heights = np.full((size[1], size[0]), AWAY_MM)
    column, row = np.round((points[:, :2] - low) / CELL_MM).astype(int).T
    np.minimum.at(heights, (row, column), points[:, 2])
    # Holes between points and small ones of the scan get the height around them.
    heights = ndimage.grey_opening(heights, size=(_GAP_CELLS, _GAP_CELLS), mode="nearest")
    return SolePrint(
        heights, (float(low[0]), float(low[1])), heights >= AWAY_MM, float(foot.length_mm)
    )


@dataclass(frozen=True, eq=False)
class Contact:
    """Where something presses on a grid.

    Parameters
    ----------
    load : (rows, columns) float64
        0 to 1.
    pitch_mm
        Of the cells, across and along.
    """

    load: FloatArray
    pitch_mm: tuple[float, float]

    @property
    def points(self) -> FloatArray:
        """(n, 2) centres of the loaded cells, frame of the map, mm."""
        return self._centres[self.load > 0]

    @property
    def _centres(self) -> FloatArray:
        return centres_mm((self.load.shape[0], self.load.shape[1]), self.pitch_mm)

    def surroundings(self) -> tuple[FloatArray, FloatArray]:
        """Return centres (m, 2) and loads (m,) of the loaded cells and those around them."""
        from scipy import ndimage

        padded = np.pad(self.load, _AROUND)
        near = ndimage.binary_dilation(padded > 0, iterations=_AROUND)
        centres = centres_mm((padded.shape[0], padded.shape[1]), self.pitch_mm)
        return centres[near], padded[near]


@dataclass(frozen=True, eq=False)
class Alignment:
    """Where a map lies under a foot.

    Parameters
    ----------
    placement
    disagreement
        Root mean square difference of loaded and expected cells, 0 to 1.
    doubt
        Why it may be wrong, in a sentence; empty if it is sure.
    """

    placement: Placement
    disagreement: float
    doubt: str = ""


def contact_of_map(laid: PressureMap) -> Contact:
    """Return where a map shows contact: pressures saturate, so that peaks do not decide."""
    kpa = np.nan_to_num(laid.kpa)
    kpa = without_specks(np.where(kpa >= min(LOADED_KPA, 0.2 * laid.peak_kpa), kpa, 0.0))
    usual = float(np.percentile(kpa[kpa > 0], 95))
    return Contact(kpa / (kpa + _HALF_LOAD * usual), laid.pitch_mm)


def without_specks(load: FloatArray) -> FloatArray:
    """Return a load without what presses on a few cells alone, such as noise."""
    from scipy import ndimage

    groups, _ = ndimage.label(load > 0, structure=np.ones((3, 3)))
    sizes = np.bincount(groups.ravel())
    sizes[0] = 0
    return np.where(sizes[groups] >= _LEAST_GROUP, load, 0.0)


def align_pressure(foot: Foot, laid: PressureMap, seen_from: SeenFrom) -> Alignment:
    """Find where a map of pressures lies under a foot.

    Parameters
    ----------
    seen_from
        From where the map shows the foot.
    """
    return align_contact(foot, contact_of_map(laid), seen_from)


def align_contact(foot: Foot, contact: Contact, seen_from: SeenFrom) -> Alignment:
    """Find where a contact lies under a foot, such as a print on a picture."""
    return _align(foot, contact, seen_from is SeenFrom.BELOW)


def _align(foot: Foot, contact: Contact, mirrored: bool) -> Alignment:
    print_ = SolePrint.of(foot)
    points = contact.points
    if len(points) < _LEAST_CELLS or _length(points) < _LEAST_SHARE * foot.length_mm:
        return Alignment(
            _in_the_middle(print_, points, mirrored),
            1.0,
            Message(
                "The contact is {length:.0f} mm long on a foot of {foot:.0f} mm, too little to "
                "find its place; lay it by hand.",
                length=_length(points),
                foot=foot.length_mm,
            ),
        )
    asked, other = (_fit(print_, contact, one) for one in (mirrored, not mirrored))
    doubt = _doubt(foot, asked.disagreement, other.disagreement)
    return Alignment(asked.placement.rounded(), asked.disagreement, doubt)


def _doubt(foot: Foot, asked: float, other: float) -> str:
    """Return what the disagreements with both sides make doubtful; empty for nothing."""
    if min(asked, other) > _NO_FOOT:
        return Message(
            "The contact does not look like the sole of this foot; check the patient and the "
            "distance of the sensors, or lay it by hand."
        )
    if asked > _OTHER_SIDE * other:
        return Message(
            "This looks like the map of a {other} foot, and it was laid under the {side} one; "
            "check the side, and whether it is seen from above or below.",
            other=foot.side.other,
            side=foot.side,
        )
    if other < _OTHER_SIDE * asked:
        return Message(
            "The map does not show whether it is that of a left or a right foot; check that it is "
            "that of the {side} one.",
            side=foot.side,
        )
    return ""


def _fit(print_: SolePrint, contact: Contact, mirrored: bool) -> Alignment:
    starts = _coarse(print_, contact, mirrored)
    fits = (_refined(print_, contact, start) for start in starts)
    return min(fits, key=lambda fit: fit.disagreement)


def _coarse(print_: SolePrint, contact: Contact, mirrored: bool) -> list[Placement]:
    """Correlate the contact with the print in all directions; return the best ones."""
    from scipy import fft

    points, load = contact.points, contact.load[contact.load > 0]
    middle = np.average(points, axis=0, weights=load)
    away = float(np.linalg.norm(points - middle, axis=1).max())
    margin = int(np.ceil(away / CELL_MM)) + 1
    template = np.pad(_template(print_), margin, mode="edge")
    shape = [fft.next_fast_len(size + 2 * margin, real=True) for size in template.shape]
    spectrum = fft.rfft2(template, s=shape)
    found: list[tuple[float, Placement]] = []
    for turn_deg in _TURNS:
        place = Placement(0.0, 0.0, float(turn_deg), mirrored)
        offsets = place.to_insole(points - middle)
        column, row = np.round(offsets / CELL_MM).astype(int).T
        spots = np.zeros(shape)
        np.add.at(spots, (row, column), load)  # negative ones count from the end
        overlap = fft.irfft2(spectrum * np.conj(fft.rfft2(spots)), s=shape)
        overlap = overlap[: template.shape[0], : template.shape[1]]
        best_row, best_column = np.unravel_index(int(overlap.argmax()), overlap.shape)
        at = np.array([best_column - margin, best_row - margin]) * CELL_MM + print_.first_mm
        x, y = at - place.to_insole(middle[None])[0]
        found.append((float(overlap.max()), place.moved(float(x), float(y))))
    found.sort(key=lambda one: -one[0])
    starts: list[Placement] = []
    for _, place in found:
        if len(starts) < _STARTS and all(_apart(place, other) for other in starts):
            starts.append(place)
    return starts


def _apart(one: Placement, other: Placement) -> bool:
    return abs((one.turn_deg - other.turn_deg + 180) % 360 - 180) > _APART_DEG


def _template(print_: SolePrint) -> FloatArray:
    """Return how likely a cell presses, less what contact beside the sole costs."""
    from scipy import ndimage

    presses = _presses(_DEEP_MM - print_.heights_mm, _PRINT_SOFT_MM)
    presses = ndimage.gaussian_filter(presses * ~print_.is_beside, _PRINT_BLUR_MM / CELL_MM)
    beside_mm = ndimage.distance_transform_edt(print_.is_beside) * CELL_MM
    return np.asarray(presses - _OUTSIDE * np.clip(beside_mm / _OUTSIDE_MM, 0, 1))


def _refined(print_: SolePrint, contact: Contact, start: Placement) -> Alignment:
    """Refine a placement together with the plane of contact."""
    from scipy import ndimage
    from scipy.optimize import least_squares

    points, load = contact.surroundings()
    middle = points.mean(axis=0)
    weights = np.where(load > 0, 1.0, _UNLOADED)
    heights = ndimage.gaussian_filter(print_.heights_mm, 1.0)
    at = start.to_insole(middle[None])[0]
    centre_y = 0.5 * print_.length_mm

    def place(values: FloatArray) -> Placement:
        turned = Placement(0.0, 0.0, float(start.turn_deg + values[2]), start.mirrored)
        x, y = at + values[:2] - turned.to_insole(middle[None])[0]
        return turned.moved(float(x), float(y))

    def differences(values: FloatArray) -> FloatArray:
        lying = place(values).to_insole(points)
        sole = ndimage.map_coordinates(heights, print_.cells(lying), order=1, mode="nearest")
        depth, pitch, roll = values[3] + _DEEP_MM, values[4] * _PITCH, values[5] * _ROLL
        plane = depth + pitch * (lying[:, 1] - centre_y) + roll * lying[:, 0]
        return np.asarray(weights * (_presses(plane - sole, _SOFT_MM) - load))

    def residuals(values: FloatArray) -> FloatArray:
        usual = values[3:] / [_DEPTH_SPREAD_MM, 1.0, 1.0]
        return np.concatenate([differences(values), 0.5 * usual])

    found = least_squares(
        residuals, np.zeros(6), loss="soft_l1", f_scale=_ROBUST, x_scale=[2, 2, 1, 1, 1, 1],
        max_nfev=60,
    )  # fmt: skip
    left = differences(found.x)
    disagreement = float(np.sqrt((left**2).sum() / (weights**2).sum()))
    return Alignment(place(found.x), disagreement)


def _presses(over_mm: FloatArray, soft_mm: float) -> FloatArray:
    """Return how much a cell is loaded whose plane of contact lies above the sole."""
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(over_mm / soft_mm, -30, 30))))


def _length(points: FloatArray) -> float:
    """Return the length of a contact in its longest direction, mm."""
    if len(points) < 2:
        return 0.0
    centred = points - points.mean(axis=0)
    _, ways = np.linalg.eigh(centred.T @ centred)
    return float(np.ptp(centred @ ways[:, -1]))


def _in_the_middle(print_: SolePrint, points: FloatArray, mirrored: bool) -> Placement:
    place = Placement(mirrored=mirrored)
    middle = points.mean(axis=0) if len(points) else np.zeros(2)
    x, y = np.array([0.0, 0.5 * print_.length_mm]) - place.to_insole(middle[None])[0]
    return place.moved(float(x), float(y)).rounded()
