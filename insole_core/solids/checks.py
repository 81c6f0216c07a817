"""Checks that a solid must pass before manufacture, each with its value and worst position."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
import scipy

from insole_core.errors import DesignError
from insole_core.geometry.arrays import BoolArray, FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.ray_casting import RayCaster, RayHits
from insole_core.geometry.transforms import transform
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message, Value
from insole_core.progress import SILENT, Progress
from insole_core.solids.ball_offset import left_by_cutter
from insole_core.solids.export_rules import CheckName, ExportRules, Policy

DECIMALS: dict[CheckName, int] = {
    "thickness": 1, "cutter": 2, "undercut": 0, "step": 1, "block": 1, "shoe_height": 1, "grid": 2,
}  # fmt: skip
"""To which a value is rounded before it is compared with its limit, recorded and printed."""

_PITCH_MM = 1.0
_OFF_LATTICE = 0.3137  # rays avoid round coordinates, where lattices have their vertices
_RIM_PIXELS = 3  # the rim tapers to an edge, which has no thickness
_SKIN_MM = 0.01
_CLEAR_MM = 0.05  # facets of one curved wall do not cover each other
_DOWNWARD = -0.02
_LEVEL, _SHAPED_SHARE = -0.7, 0.1
"""z of normals that face down, walls left out; share of their area off the base from which on an
underside is shaped."""
_UNDERSIDE = -0.3  # z of a normal: faces down by more than a wall of the greatest inward draft

Place = tuple[float, float, float]


@dataclass(frozen=True)
class Finding:
    """The outcome of one check.

    Parameters
    ----------
    value, limit, unit
        Measured value, rounded to `DECIMALS`, and the permitted one.
    place_mm
        Position of the worst value, in the frame of the solid; None if there is no single one.
    spots_mm : (n, 3) float64
        All positions that break the limit, about a millimetre apart, for display.
    """

    name: CheckName
    policy: Policy
    passed: bool
    value: float
    limit: float
    unit: str
    sentence: str
    place_mm: Place | None = None
    spots_mm: FloatArray = field(default_factory=lambda: np.zeros((0, 3)), compare=False)

    @property
    def blocks(self) -> bool:
        """Whether the export is refused unless someone overrides the rule."""
        return self.policy == "blocking" and not self.passed

    @property
    def margin(self) -> float:
        """How far the value is from its limit; negative where it breaks the limit."""
        more_is_better = self.name in ("thickness", "watertight")
        return self.value - self.limit if more_is_better else self.limit - self.value

    def moved(self, a2b: FloatArray) -> Finding:
        """Return the finding with its places, and the sentence about them, in another frame.

        Parameters
        ----------
        a2b : (4, 4) float64, mm
            From the frame of the solid to the other one.
        """
        if self.place_mm is None:
            return replace(self, spots_mm=transform(a2b, self.spots_mm))
        place = _rounded(transform(a2b, np.array([self.place_mm]))[0])
        sentence = self.sentence
        if isinstance(sentence, Message) and "place" in sentence.values:
            sentence = Message(sentence.template, **{**sentence.values, "place": _at(place)})
        spots = transform(a2b, self.spots_mm)
        return replace(self, place_mm=place, spots_mm=spots, sentence=sentence)

    def as_json(self) -> dict[str, Any]:
        """Return what is recorded, for `json.dump`."""
        return {key: value for key, value in vars(self).items() if key != "spots_mm"}


@dataclass(frozen=True)
class Override:
    """A person's decision to export a solid against a blocking rule, with the reason."""

    author: str
    reason: str
    at: str


def check_solid(
    solid: TriangleMesh,
    rules: ExportRules,
    progress: Progress = SILENT,
    *,
    unmarked: TriangleMesh | None = None,
    grid_mm: float = 0.0,
    least_thickness: HeightField | None = None,
) -> tuple[Finding, ...]:
    """Run every check that is not switched off.

    Parameters
    ----------
    solid : mm
        The side to be milled upwards.
    unmarked : mm, optional
        The solid before letters were put on its bottom, which no cutter from above need reach.
    grid_mm
        Of the surface that the solid was made of; 0 for one that was made without a grid.
    least_thickness : mm, frame of the solid, optional
        What the material needs at each place, where that is more than the rule's limit.

    Returns
    -------
    tuple of Finding
        One for each check, passed or not.
    """
    survey = _Survey(solid, unmarked, grid_mm, least_thickness)
    policies = dict(rules.policies)
    if rules.block_mm is None:
        policies.pop("block", None)
    checks = {
        "watertight": _watertight, "thickness": _thickness, "cutter": _cutter,
        "undercut": _undercut, "step": _step, "block": _block, "shoe_height": _shoe_height,
        "grid": _grid,
    }  # fmt: skip
    findings = []
    for number, (name, policy) in enumerate(policies.items()):
        progress.step(number / len(policies), "Checking: {check}", check=name.replace("_", " "))
        if policy != "off":
            findings.append(checks[name](survey, rules, policy))
    return tuple(findings)


def require_export(findings: Sequence[Finding], override: Override | None = None) -> dict[str, Any]:
    """Return the record of an export for `json.dump`, with the override if one was needed.

    Parameters
    ----------
    override
        Its reason must not be empty.

    Returns
    -------
    dict
        "findings", and "override" or None.

    Raises
    ------
    DesignError
        If a blocking check failed and is not overridden.
    """
    blocking = [finding for finding in findings if finding.blocks]
    if blocking and (override is None or not override.reason.strip()):
        raise DesignError(
            "{finding} Change the design, or override the rule with a reason.",
            finding=blocking[0].sentence,
        )
    return {
        "findings": [finding.as_json() for finding in findings],
        "override": asdict(override) if blocking and override is not None else None,
    }


def worst_findings(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Return the worst finding of each check, such as those of the two parts of a pair.

    It has the spots of all, so they must be in one frame.
    """
    of_check: dict[CheckName, list[Finding]] = {}
    for finding in findings:
        of_check.setdefault(finding.name, []).append(finding)
    return tuple(map(_worst_of, of_check.values()))


def _worst_of(findings: Sequence[Finding]) -> Finding:
    worst = min(findings, key=lambda finding: (finding.passed, finding.margin))
    failed = [finding.spots_mm for finding in findings if not finding.passed]
    return replace(worst, spots_mm=np.concatenate(failed)) if failed else worst


def survey_heights(solid: TriangleMesh) -> HeightMap:
    """Return the heights of a solid, mm, in its own frame."""
    survey = _Survey(solid)
    return HeightMap(survey.heights(-1.0), survey.heights(1.0), survey.first_mm)


def survey_side(solid: TriangleMesh, *, from_above: bool) -> tuple[FloatArray, tuple[float, float]]:
    """Return the heights of one side of a solid, at half the cost of both.

    Returns
    -------
    heights_mm : (ny, nx) float64
        On pixels of 1 mm; NaN beside the solid.
    first_mm
        x and y of the centre of the pixel [0, 0].
    """
    survey = _Survey(solid)
    return survey.heights(-1.0 if from_above else 1.0), survey.first_mm


class _Survey:
    """The solid as seen from above, on a grid."""

    def __init__(
        self,
        solid: TriangleMesh,
        unmarked: TriangleMesh | None = None,
        grid_mm: float = 0.0,
        least_thickness: HeightField | None = None,
    ) -> None:
        self.solid = solid
        self.unmarked = unmarked or solid
        self.grid_mm = grid_mm
        self.least_thickness = least_thickness
        self.caster = RayCaster(solid)
        low, high = solid.bounds_mm[:, :2]
        first = np.floor(low) - 2 + _OFF_LATTICE
        x, y = (np.arange(a, b + 2, _PITCH_MM) for a, b in zip(first, high, strict=True))
        self.places = np.stack(np.meshgrid(x, y), axis=-1)

    @cached_property
    def unmarked_caster(self) -> RayCaster:
        return self.caster if self.unmarked is self.solid else RayCaster(self.unmarked)

    @property
    def first_mm(self) -> tuple[float, float]:
        """x and y of the centre of the pixel [0, 0]."""
        x, y = self.places[0, 0]
        return float(x), float(y)

    def heights(self, towards_z: float) -> FloatArray:
        """Return the heights (ny, nx) met from above (-1) or below (+1), NaN beside the solid."""
        return self._heights_of(self._look(towards_z))

    @cached_property
    def seen(self) -> tuple[FloatArray, FloatArray]:
        """Heights (ny, nx) from above, NaN beside the solid, and normals (ny, nx, 3)."""
        hits = self._look(-1.0)
        normals = np.zeros((*self.places.shape[:2], 3))
        normals.reshape(-1, 3)[hits.ray] = self.solid.triangle_normals[hits.triangle]
        return self._heights_of(hits), normals

    def _look(self, towards_z: float) -> RayHits:
        flat = self.places.reshape(-1, 2)
        low, high = self.solid.bounds_mm[:, 2]
        start = high + 10 if towards_z < 0 else low - 10
        origins = np.column_stack([flat, np.full(len(flat), start)])
        return self.caster.cast(origins, np.broadcast_to([0.0, 0, towards_z], origins.shape))

    def _heights_of(self, hits: RayHits) -> FloatArray:
        heights = np.full(self.places.shape[:2], np.nan)
        corners = self.solid.vertices[self.solid.triangles[hits.triangle], 2]
        heights.ravel()[hits.ray] = (hits.weights * corners).sum(axis=1)
        return heights

    @cached_property
    def inner(self) -> BoolArray:
        """(ny, nx) pixels away from the rim."""
        return np.asarray(
            scipy.ndimage.binary_erosion(np.isfinite(self.seen[0]), iterations=_RIM_PIXELS)
        )

    def place(self, index: tuple[int, ...]) -> Place:
        return _rounded(np.array([*self.places[index], self.seen[0][index]]))


def _rounded(place: FloatArray) -> Place:
    x, y, z = (round(float(value), 2) + 0.0 for value in place)
    return x, y, z


def _at(place: Place) -> Message:
    x, y = (round(value) + 0.0 for value in place[:2])  # + 0.0: never "-0"
    return Message("x = {x_mm:.0f} mm, y = {y_mm:.0f} mm", x_mm=x, y_mm=y)


def _worst(values: FloatArray) -> tuple[int, ...]:
    index = np.unravel_index(np.nanargmax(values), values.shape)
    return tuple(int(i) for i in index)


def _watertight(survey: _Survey, _rules: ExportRules, policy: Policy) -> Finding:
    passed = survey.solid.is_closed and survey.solid.volume_mm3 > 0
    sentence = "The solid is closed." if passed else "The solid is open or inside out."
    return Finding("watertight", policy, passed, float(passed), 1.0, "", sentence)


def _thickness(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    """Measure from each point of the upper side along the inward normal to the underside.

    Where the normal leaves through a wall instead, it measures how broad the rim is there, which
    is no thickness: the rim tapers to an edge.
    """
    heights, normals = survey.seen
    limit: float | FloatArray = rules.limits["thickness"]
    thickness = np.full(heights.shape, np.nan)
    inner = np.flatnonzero(survey.inner)
    into = -normals.reshape(-1, 3)[inner]
    points = np.dstack([survey.places, heights]).reshape(-1, 3)[inner]
    hits = survey.caster.cast(points + _SKIN_MM * into, into)
    below = survey.solid.triangle_normals[hits.triangle, 2] < _UNDERSIDE
    ray, triangle, weights = hits.ray[below], hits.triangle[below], hits.weights[below]
    ends = np.einsum("nk,nkc->nc", weights, survey.solid.vertices[survey.solid.triangles[triangle]])
    thickness.flat[inner[ray]] = np.linalg.norm(ends - points[ray], axis=1)
    if survey.least_thickness is not None:
        needed = survey.least_thickness.height_at(survey.places).round(DECIMALS["thickness"])
        limit = np.fmax(limit, needed)
    return _graded(survey, "thickness", policy, -thickness, limit, unit="mm thick", least=True)


def _cutter(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    heights = survey.seen[0]
    radius = rules.cutter_diameter_mm / 2
    left = left_by_cutter(np.nan_to_num(heights, nan=0.0), _PITCH_MM, radius)
    left = np.where(survey.inner, left, np.nan)
    unit = Message(
        "mm of material left by the {diameter_mm:g} mm cutter in a hollow",
        diameter_mm=rules.cutter_diameter_mm,
    )
    return _graded(survey, "cutter", policy, left, rules.limits["cutter"], unit=unit)


def _step(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    heights = np.where(survey.inner, survey.seen[0], np.nan)
    rise = np.full(heights.shape, np.nan)
    along_y, along_x = np.abs(np.diff(heights, axis=0)), np.abs(np.diff(heights, axis=1))
    rise[:-1, :-1] = np.fmax(along_y[:, :-1], along_x[:-1])
    return _graded(survey, "step", policy, rise, rules.limits["step"], unit="mm of rise over 1 mm")


def _shoe_height(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    limit, heights = rules.limits["shoe_height"], survey.seen[0] - survey.solid.bounds_mm[0, 2]
    return _graded(survey, "shoe_height", policy, heights, limit, unit="mm high")


def _graded(
    survey: _Survey,
    name: CheckName,
    policy: Policy,
    badness: FloatArray,
    limits: FloatArray | float,
    *,
    unit: str,
    least: bool = False,
) -> Finding:
    """Judge the value of a map that is worst against its limit, the same or one for each place.

    With `least` the map holds the negative of the quantity.
    """
    limits = np.broadcast_to(limits, badness.shape)
    if not np.isfinite(badness).any():
        sentence = Message(
            "Too little of the solid is seen from above to check its {what}.", what=name
        )
        return Finding(name, policy, False, 0.0, float(limits.min()), unit, sentence)
    over = badness + limits if least else badness - limits
    worst, badness = _worst(over), badness.round(DECIMALS[name])
    value = float(-badness[worst] if least else badness[worst])
    limit = float(limits[worst])
    passed = value >= limit if least else value <= limit
    place = survey.place(worst)
    bad = badness > (-limits if least else limits)
    spots = np.dstack([survey.places, survey.seen[0]])[bad]
    sentence = Message(
        "{value:g} {unit} at {place}; {limit:g} is the {bound} allowed.",
        value=value,
        unit=unit,
        place=_at(place),
        limit=limit,
        bound="least" if least else "most",
    )
    return Finding(name, policy, passed, value, limit, unit, sentence, place, spots)


def _undercut(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    """Sum the area that no cutter reaches.

    A flat bottom lies on the machine's table, so that the cutter comes from above alone. A part
    whose underside is shaped is turned over: only what neither side sees is an undercut.
    """
    solid, limit = survey.unmarked, rules.limits["undercut"]
    corners = solid.vertices[solid.triangles]
    up = solid.triangle_normals[:, 2]
    lifted = corners[..., 2].max(axis=1) > solid.bounds_mm[0, 2] + _SKIN_MM
    sides = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = np.linalg.norm(np.cross(*sides), axis=1) / 2
    below = np.where(up < _LEVEL, areas, 0.0)
    is_turned = bool(below[lifted].sum() > _SHAPED_SHARE * below.sum())
    hidden = lifted & (up < _DOWNWARD)
    if is_turned:
        hidden = _covered(survey, hidden, -1.0) | _covered(survey, up > -_DOWNWARD, 1.0)
    area = round(float(areas[hidden].sum()), DECIMALS["undercut"])
    place, spots = None, corners[hidden].mean(axis=1)
    if area > 0:
        place = _rounded(corners[np.where(hidden, areas, 0.0).argmax()].mean(axis=0))
    sentence = _undercut_sentence(area, limit, place, is_turned=is_turned)
    return Finding("undercut", policy, area <= limit, area, limit, "mm²", sentence, place, spots)


def _covered(survey: _Survey, chosen: BoolArray, towards_z: float) -> BoolArray:
    """Return which of the chosen triangles (n,) have material over them (+1) or below them (-1)."""
    solid, numbers = survey.unmarked, np.flatnonzero(chosen)
    towards = np.broadcast_to([0.0, 0.0, towards_z], (len(numbers), 3))
    centres = solid.vertices[solid.triangles[numbers]].mean(axis=1)
    hits = survey.unmarked_caster.cast(centres + _CLEAR_MM * towards, towards)
    covered = np.zeros(len(chosen), dtype=bool)
    covered[numbers[hits.ray]] = True
    return covered


def _undercut_sentence(
    area_mm2: float, limit: float, place: Place | None, *, is_turned: bool
) -> Message:
    values: dict[str, Value] = {"area_mm2": area_mm2, "limit": limit}
    if place is None:
        return (
            Message(
                "{area_mm2:.0f} mm² cannot be reached from above, nor from below with the part "
                "turned over; {limit:g} are allowed.",
                **values,
            )
            if is_turned
            else Message(
                "{area_mm2:.0f} mm² cannot be reached from above; {limit:g} are allowed.", **values
            )
        )
    values["place"] = _at(place)
    return (
        Message(
            "{area_mm2:.0f} mm² at {place} cannot be reached from above, nor from below with the "
            "part turned over; {limit:g} are allowed.",
            **values,
        )
        if is_turned
        else Message(
            "{area_mm2:.0f} mm² cannot be reached from above at {place}; {limit:g} are allowed.",
            **values,
        )
    )


def _block(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    assert rules.block_mm is not None
    extent = np.ptp(survey.solid.vertices, axis=0)
    size = np.concatenate([np.sort(extent[:2])[::-1], extent[2:]])
    stock = np.concatenate([np.sort(rules.block_mm[:2])[::-1], rules.block_mm[2:]])
    size = size.round(DECIMALS["block"])
    over = round(float((size - stock).max()), DECIMALS["block"])
    needed = " × ".join(f"{value:g}" for value in size)
    there = " × ".join(f"{value:g}" for value in stock)
    sentence = Message(
        "The solid needs {needed} mm, and the block has {there} mm.", needed=needed, there=there
    )
    return Finding("block", policy, over <= 0, over, 0.0, "mm too large", sentence)


def _grid(survey: _Survey, rules: ExportRules, policy: Policy) -> Finding:
    """Judge the grid itself: a coarse one makes facets that no other check sees."""
    grid_mm, limit = round(survey.grid_mm, DECIMALS["grid"]), rules.limits["grid"]
    sentence = Message(
        "The surface is computed on a grid of {grid_mm:g} mm; {limit:g} is the most allowed.",
        grid_mm=grid_mm,
        limit=limit,
    )
    return Finding("grid", policy, grid_mm <= limit, grid_mm, limit, "mm", sentence)
