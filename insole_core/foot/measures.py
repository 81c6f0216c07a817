"""The clinical measures of a foot, each with its definition.

Lengths lie along the foot axis (pternion to tip of the 2nd toe), widths across it. What was not
scanned has no measure: it is None, and `MISSING` says why.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from insole_core.foot.foot import Foot
from insole_core.foot.foot_proportions import is_within
from insole_core.foot.landmarks import AXES, TOE_TIPS, Landmarks
from insole_core.foot.levelling import OUTLINE_HEIGHT_MM
from insole_core.foot.rear_axes import Axis
from insole_core.foot.tape import tape_length
from insole_core.foot.toe_end import GUESS, MERGED
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.sections import boundary_crossings, section_segments
from insole_core.geometry.weighted import weighted_quantile
from insole_core.messages import Message, joined

_FOOTPRINT_MM = 5.0  # height of the unloaded sole that touches the ground under load
_FOOTING_MM = 12.0
_TOE_GAP = 0.07  # share of the length ahead of the heads, where the toeless footprint ends
_INSTEP = 0.5
_LEAST_DORSAL_MM = 25.0
_RIM_MM, _MOST_CUT_OFF = 3.0, 0.03  # beside the edge of a scan, and share of a footprint there
_PROPORTION = 0.22  # confidence of a place between guessed ones
_SPOT_MM, _LEAST_SPOT = 8.0, 0.5  # about a landmark, and share of it that must be scanned
_SHOE_ALLOWANCE_MM = 15.0
FOOTINGS = ("heel_centre", "metatarsal_head_1", "metatarsal_head_5")
PARIS_MM, _ENGLISH_MM, _MONDOPOINT_MM = 20 / 3, 25.4 / 3, 5.0
SIZES = {
    "shoe_size_eu": (PARIS_MM, 0.5),
    "shoe_size_uk": (_ENGLISH_MM, 0.5),
    "shoe_size_us": (_ENGLISH_MM, 0.5),
    "mondopoint": (1.0, _MONDOPOINT_MM),
}
"""What follows from the length of the foot: mm for each unit, and the steps in which it is told."""
Measured: TypeAlias = Mapping[str, float | None]
"""The measures of a foot by name; None for what was not scanned."""


@dataclass(frozen=True)
class Definition:
    """Unit and meaning of a measure.

    Parameters
    ----------
    unit
        "mm", "degrees" or "" for a ratio or a size.
    text
    deviation
        Standard deviation from the measure of the true surface, in its unit, over simulated
        captures (`benchmarks/measures.py`); None where they do not tell it. What the outlines in
        the pictures tell of a size takes its place: `deviations_mm`.
    decimals
        That are shown.
    positive, negative
        What an angle above and below 0 is called.
    """

    unit: str
    text: str
    deviation: float | None = None
    decimals: int = 1
    positive: str = ""
    negative: str = ""


DEFINITIONS = {
    "foot_length": Definition(
        "mm", "pternion to the tip of the longest toe, along the foot axis", 0.7
    ),
    "ball_width": Definition(
        "mm", "metatarsale tibiale to metatarsale fibulare, seen from below", 1.0
    ),
    "ball_width_across": Definition(
        "mm", "the same two points, perpendicular to the foot axis", 0.8
    ),
    "ball_length": Definition("mm", "pternion to metatarsale tibiale, along the foot axis", 1.0),
    "heel_width": Definition("mm", "greatest width of the heel at 10 to 22 % of the length", 1.0),
    "ball_girth": Definition("mm", "tape round the foot through the two points of the ball"),
    "instep_height": Definition("mm", "highest dorsal point at half of the foot length"),
    "arch_height": Definition("mm", "arch apex over the plane of heel, 1st and 5th head", 0.6),
    "arch_height_index": Definition("", "instep height / length from heel to 1st head", decimals=2),
    "arch_index": Definition(
        "", "middle third of the toeless footprint / all of it", 0.0155, decimals=2
    ),
    "navicular_height": Definition("mm", "navicular, where it is marked, over the ground"),
    "rearfoot_angle_deg": Definition(
        "degrees",
        "bisection of the calcaneus against the Achilles axis; > 0 is valgus",
        1.2,
        positive="valgus",
        negative="varus",
    ),
    "achilles_angle_deg": Definition(
        "degrees",
        "Achilles axis against the normal of the sole; > 0 leans medially (valgus)",
        0.8,
        positive="valgus",
        negative="varus",
    ),
    "achilles_lean_deg": Definition(
        "degrees",
        "Achilles axis against the upright of the scan; > 0 leans medially",
        0.65,
        positive="medial",
        negative="lateral",
    ),
    "forefoot_angle_deg": Definition(
        "degrees",
        "line of the 1st to 5th head against the heel's ground; > 0 is varus",
        0.31,
        positive="varus",
        negative="valgus",
    ),
    "shoe_size_eu": Definition("", "Paris points of 6.67 mm, with 15 mm before the toes"),
    "shoe_size_uk": Definition("", "English sizes of 8.47 mm, with 15 mm before the toes"),
    "shoe_size_us": Definition("", "men's: the English size and one"),
    "mondopoint": Definition("mm", "foot length, rounded up to 5 mm"),
}
_NO_LENGTH = "the heel or the toes were not scanned"
_NO_SIZE = "the heel or the toes were not scanned, or no shoe of adults is as long"
_NO_BALL = "the sides of the ball were not scanned"
_NO_SOLE = "the sole was not scanned under heel, ball and arch"
MISSING = {
    "foot_length": _NO_LENGTH,
    "ball_width": _NO_BALL,
    "ball_width_across": _NO_BALL,
    "ball_length": "the heel or the medial side of the ball was not scanned",
    "heel_width": "the sides of the heel were not scanned",
    "ball_girth": "the back of the foot was not scanned",
    "instep_height": "the back of the foot was not scanned",
    "arch_height": _NO_SOLE,
    "arch_height_index": "the back of the foot was not scanned",
    "arch_index": _NO_SOLE,
    "navicular_height": "the navicular is not marked",
    "rearfoot_angle_deg": "the back of the heel or the leg was not scanned, or in pieces only",
    "achilles_angle_deg": "the leg was not scanned, or in pieces only",
    "achilles_lean_deg": "the leg was not scanned, or in pieces only, or the scan does not stand "
    "upright",
    "forefoot_angle_deg": _NO_SOLE,
    "shoe_size_eu": _NO_SIZE,
    "shoe_size_uk": _NO_SIZE,
    "shoe_size_us": _NO_SIZE,
    "mondopoint": _NO_LENGTH,
}

NOT_MARKED = frozenset({"navicular_height"})
"""Measures that are missing until the user marks a place, whatever was scanned."""

_LENGTH = ("pternion", "toe_tip_1", "toe_tip_2")
_BALL = ("metatarsale_tibiale", "metatarsale_fibulare")
_SIDES = (*_BALL, "heel_medial", "heel_lateral")
"""Of ball and heel, between which the places below heel and heads are found."""
_STANDS_ON = {
    "foot_length": _LENGTH,
    "ball_width": _BALL,
    "ball_width_across": _BALL,
    "ball_length": ("pternion", "metatarsale_tibiale"),
    "heel_width": ("heel_medial", "heel_lateral"),
    "ball_girth": _BALL,
    "instep_height": _LENGTH,
    "arch_height": _SIDES,
    "arch_height_index": (*_LENGTH, *_BALL),
    "arch_index": _SIDES,
    "forefoot_angle_deg": _SIDES,
    "shoe_size_eu": _LENGTH,
    "shoe_size_uk": _LENGTH,
    "shoe_size_us": _LENGTH,
    "mondopoint": _LENGTH,
}
_AXES = {
    "rearfoot_angle_deg": ("achilles_lower", "calcaneus_lower"),
    "achilles_angle_deg": ("achilles_lower",),
    "achilles_lean_deg": ("achilles_lower",),
}
_RESTS_ON: Mapping[str, tuple[str, ...]] = {
    **_STANDS_ON,
    "foot_length": ("pternion", *TOE_TIPS),
    "ball_width_across": ("pternion", "toe_tip_2", *_BALL),
    "ball_length": ("pternion", "toe_tip_2", "metatarsale_tibiale"),
    "instep_height": ("pternion", *TOE_TIPS),
    "arch_height": (*FOOTINGS, "arch_apex"),
    "arch_height_index": ("pternion", *TOE_TIPS, "metatarsal_head_1"),
    "arch_index": FOOTINGS,
    "navicular_height": ("navicular",),
    "rearfoot_angle_deg": AXES,
    "achilles_angle_deg": ("achilles_lower", "achilles_upper"),
    "achilles_lean_deg": ("achilles_lower", "achilles_upper"),
    "forefoot_angle_deg": FOOTINGS,
}
"""All places that move a measure: its ends, and those of the foot axis where it lies along it."""
_SIZES_EU, _SIZES_UK = (15.0, 55.0), (1.0, 17.0)  # that exist; children's English are others
_DOUBTFUL = 0.5
_DOUBTFUL_MM = {
    "foot_length": 1.2,
    "ball_width": 1.4,
    "ball_width_across": 1.7,
    "ball_length": 2.45,
    "heel_width": 1.3,
}
"""Standard deviation of a size from which it is told; what its sides always add is in it."""
_SIZES = ("foot_length", "ball_width", "ball_width_across", "ball_length", "heel_width")
_PLACING_MM = 0.3  # of the views against each other, in every size
_LESS = 0.65
"""Of what the fits say of heel and toe ends, which is too much where toes stand out."""
_MERGED_TOES_MM = 1.2
"""Of a toe that does not stand out from the others: which of them reaches farthest, and where."""
_SIDES_MM = {"ball_width": 0.7, "ball_width_across": 1.0, "heel_width": 0.6}
_ALONG_SIDE_MM = 1.5
"""Of an end at the side of a foot: across it, because its section is not quite round, and along it,
because it is nearly straight. Over 180 simulated captures of feet of four origins."""


def deviations_mm(landmarks: Landmarks) -> dict[str, float]:
    """Compute the standard deviations, mm, by measure, of the sizes whose ends lie on contours."""
    found = {}
    for name in _SIZES:
        ends = _ends(name, landmarks)
        if all(landmarks[end].deviation_mm is not None for end in ends):
            parts = [_end_deviation_mm(landmarks, end, name) for end in ends]
            found[name] = float(np.linalg.norm([*parts, _PLACING_MM]))
    return found


def _end_deviation_mm(landmarks: Landmarks, end: str, size: str) -> float:
    """Return what one end adds to the standard deviation of a size, mm."""
    own = landmarks[end].deviation_mm or 0.0
    if end not in _SIDES:
        is_merged = end in TOE_TIPS and landmarks[end].confidence <= MERGED
        return float(np.hypot(_LESS * own, _MERGED_TOES_MM * is_merged))
    if size == "ball_length":
        return _ALONG_SIDE_MM
    across = float(np.hypot(own, _SIDES_MM[size]))
    if size != "ball_width":
        return across
    tibiale, fibulare = (landmarks[name].point[:2] for name in _BALL)
    way = np.abs(tibiale - fibulare) / np.linalg.norm(tibiale - fibulare)
    return float(np.hypot(way[0] * across, way[1] * _ALONG_SIDE_MM))


def _ends(name: str, landmarks: Landmarks) -> tuple[str, ...]:
    if name != "foot_length":
        return _STANDS_ON[name]
    return "pternion", max(TOE_TIPS, key=lambda tip: float(landmarks[tip].point[1]))


def doubts(landmarks: Landmarks) -> dict[str, str]:
    """Explain why a measure is uncertain, by the names in `DEFINITIONS`; only those that are."""
    found: dict[str, str] = {}
    for name, stands_on in _STANDS_ON.items():
        seen_badly = [
            mark.replace("_", " ") for mark in stands_on if landmarks[mark].confidence < _DOUBTFUL
        ]
        if seen_badly:
            found[name] = Message(
                "the surface is too coarse there: {places}"
                if any(landmarks[mark].is_coarse for mark in stands_on)
                else "seen in part only, and continued by the usual shape: {places}",
                places=joined(seen_badly, " and "),
            )
    for name, axes in _AXES.items():
        if any(axis in landmarks and landmarks[axis].confidence < _DOUBTFUL for axis in axes):
            found[name] = Message("the back of the heel or the leg was seen in part only")
    for name, deviation_mm in deviations_mm(landmarks).items():
        if name not in found and deviation_mm > _DOUBTFUL_MM[name]:
            found[name] = Message(
                "known to about {deviation_mm:.1f} mm only", deviation_mm=deviation_mm
            )
    return found


def by_hand(landmarks: Landmarks) -> set[str]:
    """Return the measures, by the names in `DEFINITIONS`, that rest on a place set by hand."""
    placed = {name for name, mark in landmarks.items() if mark.origin == "hand"}
    return {name for name, places in _RESTS_ON.items() if placed.intersection(places)}


def measure(foot: Foot, landmarks: Landmarks) -> dict[str, float | None]:
    """Measure a foot by its landmarks.

    Parameters
    ----------
    foot
    landmarks
        Of the foot, mm, insole frame.

    Returns
    -------
    dict
        Keys and units as in `DEFINITIONS`; None for what was not scanned (see `MISSING`).
    """
    at = _Along(foot, landmarks)
    measures = {
        **at.lengths(),
        **at.heights(),
        "navicular_height": float(at["navicular"][2]) if "navicular" in landmarks else None,
        **_angles(foot, landmarks),
    }
    if not at.is_on_sole(FOOTINGS):
        measures["forefoot_angle_deg"] = None
    measures |= _sizes(measures["foot_length"])
    return {name: measures[name] for name in DEFINITIONS}


def is_length_seen(landmarks: Landmarks) -> bool:
    """Return whether heel and toes were scanned, so that the foot's length is no guess."""
    return all(landmarks[name].confidence > GUESS for name in _ends("foot_length", landmarks))


def _sizes(length: float | None) -> dict[str, float | None]:
    if length is None:
        return dict.fromkeys(("shoe_size_eu", "shoe_size_uk", "shoe_size_us", "mondopoint"))
    english = round(2 * ((length + _SHOE_ALLOWANCE_MM) / _ENGLISH_MM - 25)) / 2
    continental = shoe_size_eu(length)
    return {
        "shoe_size_eu": continental if is_within(continental, _SIZES_EU) else None,
        "shoe_size_uk": english if is_within(english, _SIZES_UK) else None,
        "shoe_size_us": english + 1 if is_within(english, _SIZES_UK) else None,
        "mondopoint": float(np.ceil(length / _MONDOPOINT_MM) * _MONDOPOINT_MM),
    }


def shoe_size_eu(foot_length_mm: float) -> float:
    """Return the shoe size in Paris points, to the half, with 15 mm before the toes."""
    return round(2 * (foot_length_mm + _SHOE_ALLOWANCE_MM) / PARIS_MM) / 2


def usual_size_eu(foot: Foot, landmarks: Landmarks) -> float | None:
    """Return the shoe size of a foot; None where its length is a guess."""
    return shoe_size_eu(foot.length_mm) if is_length_seen(landmarks) else None


class _Along:
    """Foot and landmarks with y along the foot axis and medial = +x."""

    def __init__(self, foot: Foot, landmarks: Landmarks) -> None:
        heel, toe = landmarks["pternion"].point, landmarks["toe_tip_2"].point
        mirror = np.diag([foot.side.medial_sign, 1.0, 1.0])
        x, y = ((toe - heel) @ mirror)[:2] / np.hypot(*(toe - heel)[:2])
        self._turn = np.array([[y, -x, 0.0], [x, y, 0.0], [0.0, 0.0, 1.0]]) @ mirror
        self._landmarks, self._mesh, even = landmarks, foot.measured, foot.even
        plantar = (even.normals[:, 2] < 0) & (even.points[:, 2] < OUTLINE_HEIGHT_MM)
        self._sole = even.points[plantar] @ self._turn.T
        self._sole_mm2 = even.area_mm2[plantar] * -even.normals[plantar, 2]
        self._sole_rim_mm = even.rim_mm[plantar]
        self._points = {name: self._turn @ mark.point for name, mark in landmarks.items()}

    def __getitem__(self, name: str) -> FloatArray:
        return self._points[name]

    @property
    def length_mm(self) -> float:
        longest = max(float(self[tip][1]) for tip in TOE_TIPS)
        return longest - float(self["pternion"][1])

    @property
    def heel_to_first_head_mm(self) -> float:
        return float(self["metatarsal_head_1"][1] - self["pternion"][1])

    def lengths(self) -> dict[str, float | None]:
        """Return the measures between outermost points; None where one of them was not seen."""
        tibiale, fibulare = self["metatarsale_tibiale"], self["metatarsale_fibulare"]
        heel, tip = _ends("foot_length", self._landmarks)
        lengths = {
            "foot_length": (self.length_mm, (heel, tip)),
            "ball_width": (np.hypot(*(tibiale - fibulare)[:2]), _BALL),
            "ball_width_across": (tibiale[0] - fibulare[0], _BALL),
            "ball_length": (tibiale[1] - self[heel][1], _STANDS_ON["ball_length"]),
            "heel_width": (
                self["heel_medial"][0] - self["heel_lateral"][0],
                _STANDS_ON["heel_width"],
            ),
        }
        found = {n: float(v) if self._is_seen(ends) else None for n, (v, ends) in lengths.items()}
        return {**found, "ball_girth": self._girth() if self._is_seen(_BALL) else None}

    def heights(self) -> dict[str, float | None]:
        """Return the measures of arch and instep; None where sole or back were not scanned."""
        has_length = self._is_seen(_ends("foot_length", self._landmarks))
        instep = self._dorsal_height(_INSTEP * self.length_mm) if has_length else None
        arch = float(self.over_ground(self["arch_apex"][None])[0])
        return {
            "instep_height": instep,
            "arch_height": arch if self.is_on_sole((*FOOTINGS, "arch_apex")) else None,
            "arch_height_index": None if instep is None else instep / self.heel_to_first_head_mm,
            "arch_index": self._arch_index() if self.is_on_sole(FOOTINGS) else None,
        }

    def is_on_sole(self, names: Sequence[str]) -> bool:
        """Return whether the heel and the sole about landmarks were scanned."""
        known = all(self._landmarks[name].confidence > _PROPORTION for name in names)
        return known and self._is_seen(["pternion"]) and all(map(self._is_spot, names))

    def _is_seen(self, ends: Sequence[str]) -> bool:
        return all(self._landmarks[name].confidence > GUESS for name in ends)

    def _is_spot(self, name: str) -> bool:
        scanned_mm2 = float(self._sole_mm2[self._near(name, _SPOT_MM)].sum())
        return scanned_mm2 > _LEAST_SPOT * np.pi * _SPOT_MM**2

    def over_ground(self, points: FloatArray) -> FloatArray:
        """Compute the heights (n,) over the plane through heel, 1st and 5th head."""
        corner, first, fifth = (self._footing(name) for name in FOOTINGS)
        up = np.cross(first - corner, fifth - corner)
        up = up / np.linalg.norm(up) * np.sign(up[2])
        return np.asarray((points - corner) @ up)

    def _near(self, name: str, reach_mm: float) -> BoolArray:
        return np.asarray(np.hypot(*(self._sole[:, :2] - self[name][:2]).T) < reach_mm)

    def _footing(self, name: str) -> FloatArray:
        """Return the lowest point (3,) of the sole about a landmark, but for 1 % of noise."""
        point = self[name]
        near = self._near(name, _FOOTING_MM)
        if not near.any():
            return point
        lowest = weighted_quantile(self._sole[near, 2], self._sole_mm2[near], 0.01)
        return np.array([*point[:2], lowest])

    def _dorsal_height(self, from_heel_mm: float) -> float | None:
        """Return the height of a section over the ground; None where its top was not scanned."""
        ahead = self._turn[1]
        y = float(self["pternion"][1]) + from_heel_mm
        section = section_segments(self._mesh, y * ahead, ahead).reshape(-1, 3)
        if len(section) == 0:
            return None
        top = section[section[:, 2].argmax()]
        away = np.linalg.norm(boundary_crossings(self._mesh, y * ahead, ahead) - top, axis=1)
        if top[2] < _LEAST_DORSAL_MM or away.min(initial=np.inf) < _RIM_MM:
            return None
        return float(top[2])

    def _girth(self) -> float | None:
        """Return the length of a tape round the vertical section through two points.

        None where the tape would have to bridge a part that was not scanned.
        """
        tibiale, fibulare = self["metatarsale_tibiale"], self["metatarsale_fibulare"]
        across = self._turn.T @ [*(tibiale - fibulare)[:2], 0.0]
        across /= np.linalg.norm(across)
        up = np.array([0.0, 0.0, 1.0])
        origin = self._turn.T @ fibulare
        section = section_segments(self._mesh, origin, np.cross(across, up))
        return tape_length(np.stack([section @ across, section[..., 2]], axis=-1))

    def _arch_index(self) -> float | None:
        """Compute the index of Cavanagh & Rodgers 1987 on the part of the sole near the ground.

        None where this part ends at the edge of the scan.
        """
        touches = self._touching()
        y, area_mm2 = self._sole[touches, 1], self._sole_mm2[touches]
        cut_off = area_mm2 @ (self._sole_rim_mm[touches] < _RIM_MM)
        if len(y) == 0 or cut_off > _MOST_CUT_OFF * area_mm2.sum():
            return None
        start, third = float(y.min()), float(np.ptp(y)) / 3
        middle = (y >= start + third) & (y < start + 2 * third)
        return float(area_mm2[middle].sum() / area_mm2.sum())

    def _touching(self) -> BoolArray:
        (x5, y5), (x1, y1) = (self[f"metatarsal_head_{n}"][:2] for n in (5, 1))
        line = np.interp(self._sole[:, 0], [x5, x1], [y5, y1])
        toeless = self._sole[:, 1] < line + _TOE_GAP * self.length_mm
        low = self.over_ground(self._sole) < _FOOTPRINT_MM
        return np.asarray(toeless & low)


def _angles(foot: Foot, landmarks: Landmarks) -> dict[str, float | None]:
    x, y, z = np.eye(3)
    medial = foot.side.medial_sign * x
    leg, heel = _axis(landmarks, "achilles"), _axis(landmarks, "calcaneus")
    first, fifth = (landmarks[f"metatarsal_head_{n}"].point for n in (1, 5))
    rise = (first - fifth)[2], (first - fifth) @ medial
    lean = None if leg is None else leg.lean_deg(z, y, medial)
    heel_lean = None if heel is None else heel.lean_deg(z, y, medial)
    return {
        "rearfoot_angle_deg": _difference(heel_lean, lean),
        "achilles_angle_deg": lean,
        "achilles_lean_deg": _upright_lean(foot, leg),
        "forefoot_angle_deg": float(np.degrees(np.arctan2(*rise))),
    }


def _upright_lean(foot: Foot, leg: Axis | None) -> float | None:
    """Compute the lean in the frame of the scan if its toes point ahead and its back upwards."""
    x, y, z = foot.source2insole[:3, :3].T
    if leg is None or z[2] < np.cos(np.radians(20)) or y[1] < np.cos(np.radians(20)):
        return None
    return leg.lean_deg(z, y, foot.side.medial_sign * x)


def _axis(landmarks: Landmarks, name: str) -> Axis | None:
    """Return an axis; None where the back was not seen, or so ragged that it is no more a line."""
    if f"{name}_lower" not in landmarks or f"{name}_upper" not in landmarks:
        return None
    lower, upper = landmarks[f"{name}_lower"], landmarks[f"{name}_upper"]
    confidence = min(lower.confidence, upper.confidence)
    return Axis(lower.point, upper.point, confidence) if confidence > GUESS else None


def _difference(left: float | None, right: float | None) -> float | None:
    return None if left is None or right is None else left - right
