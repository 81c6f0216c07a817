"""The closed bodies of the zones of a print: prisms under places of the plan, and layers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import cv2
import manifold3d
import numpy as np

from insole_core.errors import DesignError
from insole_core.foot.landmarks import Landmarks, find_landmarks
from insole_core.formats.slicer_3mf import Infill, Modifier, PrintedPart
from insole_core.formats.solid_content import merged
from insole_core.geometry.arrays import BoolArray, FloatArray, IntArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.build import Insole
from insole_core.insole.elements import Pelott
from insole_core.insole.pads.pad_heights import pad_outline
from insole_core.insole.primitives.height_field import HeightField
from insole_core.messages import Message, joined
from insole_core.pressure.laid_map import PressureMap
from insole_core.solids.layers import everything_below
from insole_core.solids.order import Part
from insole_core.solids.print_presets import REGIONS
from insole_core.solids.print_zones import PrintPlan, Zone
from insole_core.solids.simplification import from_manifold, to_manifold

OVERLAP_MM = 0.5
"""By which a body reaches over the part: faces that coincide are a matter of rounding."""
LINE_MM = 0.45
"""Width of a wall that a usual nozzle of 0.4 mm prints."""
LEAST_WIDTH_MM = 2 * LINE_MM
_HEEL, _BEHIND_HEADS = 0.31, 0.08
"""Shares of the foot's length, as the regions of pressure have them (`pressure/regions.py`)."""
_FAR_MM = 1000.0
_STEPS, _STEP_MM = 3, 4.0
"""Of a graded border: how many densities lie between those of two zones, and how wide each is."""
_LEAST_APART = 5.0
"""Densities in per cent that are nearer to each other are not graded."""
_LEAST_MM3 = 1.0
_LAYERS = ("cover", "shell", "base")


@dataclass(frozen=True, eq=False)
class ZonedPart:
    """A part with its zones, in the insole frame.

    Parameters
    ----------
    notes
        Which zone is obeyed where two overlap, and which zones of the table the part does not
        reach; one sentence each.
    """

    printed: PrintedPart
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Body:
    """A zone with its body, and its plan where it is the same at all heights."""

    zone: Zone
    body: manifold3d.Manifold
    plan: manifold3d.CrossSection | None


def zoned_part(part: Part, plan: PrintPlan, pressure: PressureMap | None = None) -> ZonedPart:
    """Make the bodies of the zones of a part.

    Parameters
    ----------
    part
        An insole in one piece.
    pressure
        Under its foot, for zones of pressure.

    Returns
    -------
    ZonedPart
        Its bodies are closed and reach over the part by `OVERLAP_MM`.

    Raises
    ------
    DesignError
        If the part is no insole, or a zone is not on it, has no pad, layer or map, or is thinner
        than two walls.
    """
    if part.order.kind != "insole":
        raise DesignError(
            "Zones of other density are for insoles only; choose the insole as the piece, or no "
            "printer."
        )
    maker = _BodyMaker(part, pressure)
    bodies: list[_Body] = []
    notes: list[str] = []
    for zone in plan.zones:
        if zone.side not in (None, part.side):
            continue
        area = maker.plan(zone)
        body = maker.layer(zone) if area is None else maker.prism(area)
        within = body ^ maker.solid
        if within.volume() > _LEAST_MM3:
            _require_two_walls(within, zone)
            bodies.append(_Body(zone, body, area))
        elif zone.kind in REGIONS:
            notes.append(Message("The insole does not reach the zone {zone}.", zone=_quoted(zone)))
        else:
            raise DesignError(
                "The zone {zone} does not lie on the {side} insole; leave it out.",
                zone=_quoted(zone),
                side=str(part.side),
            )
    notes += _overlaps(bodies, maker.solid)
    modifiers: list[Modifier] = []
    for number, each in enumerate(bodies):
        if plan.graded:
            modifiers += maker.graded(bodies[:number], each)
        modifiers.append(Modifier(from_manifold(each.body), _named(each.zone), each.zone.infill))
    printed = PrintedPart(
        part.solid, part.name, plan.walls, plan.top_layers, plan.bottom_layers, plan.rest,
        tuple(modifiers),
    )  # fmt: skip
    return ZonedPart(printed, tuple(notes))


def _named(zone: Zone) -> Message:
    return Message("{zone} {density:g} %", zone=zone.name, density=zone.infill.density_percent)


def _quoted(zone: Zone) -> Message:
    return Message("“{zone}”", zone=zone.name)


def cut_by_zones(printed: PrintedPart) -> tuple[TriangleMesh, IntArray]:
    """Cut the surface of a part along its zones, to show which of them is obeyed where.

    Returns
    -------
    surface : TriangleMesh
        Vertices on a border are there once for each zone.
    zones : (n,) int
        The modifier of each vertex; -1 where there is none.
    """
    solid = to_manifold(printed.mesh).as_original()
    rest, pieces = solid, []
    for number in reversed(range(len(printed.modifiers))):
        body = to_manifold(printed.modifiers[number].mesh)
        pieces.append((number, rest ^ body))
        rest -= body
    surfaces = [
        (number, _of_surface(piece, solid.original_id()))
        for number, piece in ((-1, rest), *pieces)
        if not piece.is_empty()
    ]
    counts = [len(surface.vertices) for _, surface in surfaces]
    return (
        merged([surface for _, surface in surfaces]),
        np.repeat([number for number, _ in surfaces], counts),
    )


def _of_surface(piece: manifold3d.Manifold, original: int) -> TriangleMesh:
    """Return the triangles of a piece that lie on the solid that it was cut from."""
    mesh, whole = piece.to_mesh64(), from_manifold(piece)
    ends = np.array(mesh.run_index) // 3
    runs = np.repeat(np.array(mesh.run_original_id), np.diff(ends))
    keep = np.zeros(len(whole.vertices), bool)
    triangles = whole.triangles[runs == original]
    keep[triangles] = True
    index = np.cumsum(keep) - 1
    return TriangleMesh(whole.vertices[keep], index[triangles].astype(np.int32))


def _require_two_walls(within: manifold3d.Manifold, zone: Zone) -> None:
    """Refuse a zone without room for two walls: in plan, or in height."""
    low, high = within.bounding_box()[2], within.bounding_box()[5]
    if within.project().offset(-LINE_MM, manifold3d.JoinType.Round).is_empty():
        thin = True
    else:
        thin = high - low < LEAST_WIDTH_MM
    if thin:
        raise _thin(zone)


def _thin(zone: Zone) -> DesignError:
    return DesignError(
        "The zone {zone} is thinner than two walls ({least:g} mm), so no infill finds room in it; "
        "make it larger or leave it out.",
        zone=_quoted(zone),
        least=LEAST_WIDTH_MM,
    )


def _overlaps(bodies: Sequence[_Body], solid: manifold3d.Manifold) -> list[str]:
    """Say which of two zones is obeyed; a pad or a layer within a third of the foot is expected."""
    notes: list[str] = []
    for first, second in combinations(bodies, 2):
        is_expected = first.zone.kind in REGIONS and second.zone.kind not in REGIONS
        if is_expected or (first.body ^ second.body ^ solid).volume() <= _LEAST_MM3:
            continue
        notes.append(
            Message(
                "The zones {first} and {second} overlap; there, {second} is obeyed.",
                first=_quoted(first.zone),
                second=_quoted(second.zone),
            )
        )
    return notes


class _BodyMaker:
    """Makes the bodies of the zones of one part."""

    def __init__(self, part: Part, pressure: PressureMap | None) -> None:
        self._insole: Insole = part.insole
        self._pressure = pressure
        self.solid = to_manifold(part.solid)
        low, high = part.solid.bounds_mm
        self._low, self._high = low - OVERLAP_MM, high + OVERLAP_MM
        self._around = manifold3d.CrossSection.square(
            tuple(self._high[:2] - self._low[:2])
        ).translate(tuple(self._low[:2]))

    def plan(self, zone: Zone) -> manifold3d.CrossSection | None:
        """Return the area of a zone that is the same at all heights; None of a layer."""
        if zone.kind in _LAYERS:
            return None
        if zone.kind == "pad":
            return self._pads(zone)
        if zone.kind == "pressure":
            return self._pressed(zone)
        return _region(zone, find_landmarks(self._insole.foot))

    def graded(self, before: Sequence[_Body], last: _Body) -> Iterator[Modifier]:
        """Yield strips around a zone in which the density of those below it goes over to its own.

        Parameters
        ----------
        before
            The zones that are obeyed less.
        """
        if last.plan is None:
            return
        over = manifold3d.CrossSection()
        for each in reversed(before):
            if each.plan is None:
                continue
            free = each.plan - over
            over += each.plan
            asked, wanted = (b.zone.infill.density_percent for b in (each, last))
            if abs(asked - wanted) <= _LEAST_APART:
                continue
            for step in range(_STEPS, 0, -1):
                round_ = manifold3d.JoinType.Round
                strip = free ^ last.plan.offset(step * _STEP_MM, round_)
                body = self.prism(strip)
                if (body ^ self.solid).volume() <= _LEAST_MM3:
                    continue
                density = round(wanted + (asked - wanted) * step / (_STEPS + 1))
                name = Message(
                    "{zone} to {other} {density:g} %",
                    zone=each.zone.name,
                    other=last.zone.name,
                    density=density,
                )
                infill = Infill(density, each.zone.infill.pattern)
                yield Modifier(from_manifold(body), name, infill, is_strip=True)

    def prism(self, plan: manifold3d.CrossSection) -> manifold3d.Manifold:
        """Return the body over an area, within a box around the part."""
        height = float(self._high[2] - self._low[2])
        return (plan ^ self._around).extrude(height).translate((0.0, 0.0, float(self._low[2])))

    def layer(self, zone: Zone) -> manifold3d.Manifold:
        """Return the body of a layer of the design."""
        layers = self._insole.design.layers
        thickness = {"cover": layers.cover_mm, "shell": layers.shell_mm}
        if zone.kind != "base" and thickness[zone.kind] <= 0:
            raise DesignError(
                "The zone {zone} is a layer that the design does not have; give the layer a "
                "thickness or leave the zone out.",
                zone=_quoted(zone),
            )
        if zone.kind != "base" and thickness[zone.kind] < LEAST_WIDTH_MM:
            raise _thin(zone)
        over = 0.0 if zone.kind == "cover" else layers.cover_mm
        under = over + layers.shell_mm if zone.kind != "cover" else layers.cover_mm
        body = self.prism(self._around)
        if zone.kind == "base":
            return body ^ self._below(under) if under > 0 else body
        return (body ^ self._below(over) if over > 0 else body) - self._below(under)

    def _below(self, depth_mm: float) -> manifold3d.Manifold:
        return to_manifold(everything_below(self._insole.contact, depth_mm))

    def _pads(self, zone: Zone) -> manifold3d.CrossSection:
        pads = self._insole.design.of(Pelott)
        names = tuple(dict.fromkeys(pad.noun for pad in pads))
        wanted = [pad for pad in pads if zone.pad in ("", pad.noun)]
        if not pads:
            raise DesignError(
                "The {side} insole has no pad, so there is no zone {zone}; leave it out.",
                side=str(self._insole.design.side),
                zone=_quoted(zone),
            )
        if not wanted:
            raise DesignError(
                "The {side} insole has no pad {zone}; its pads are: {names}.",
                side=str(self._insole.design.side),
                zone=_quoted(zone),
                names=joined(names),
            )
        outlines = [pad_outline(pad, 120) for pad in wanted]
        return manifold3d.CrossSection(outlines, manifold3d.FillRule.NonZero)

    def _pressed(self, zone: Zone) -> manifold3d.CrossSection:
        if self._pressure is None:
            raise DesignError(
                "The zone {zone} needs a map of pressures under the {side} foot; lay one under it, "
                "or leave the zone out.",
                zone=_quoted(zone),
                side=str(self._insole.design.side),
            )
        contact = self._insole.contact
        kpa = self._pressure.at(contact.nodes[:, :2]).reshape(contact.heights_mm.shape)
        low, high = zone.kpa
        plan = _outlined((kpa >= low) & (kpa < high), contact)
        # Spots and necks too narrow to print are left out.
        round_ = manifold3d.JoinType.Round
        opened = plan.offset(-LEAST_WIDTH_MM, round_).offset(LEAST_WIDTH_MM, round_)
        if opened.is_empty():
            raise DesignError(
                "The pressure under the {side} foot lies nowhere {zone}; change the limits or "
                "leave the zone out.",
                side=str(self._insole.design.side),
                zone=zone.name,
            )
        return opened.simplify(0.1)


def _region(zone: Zone, landmarks: Landmarks) -> manifold3d.CrossSection:
    """Return a third of the foot, as far as it may reach to the sides."""
    heel_y = float(landmarks["pternion"].point[1])
    length = float(landmarks["toe_tip_2"].point[1]) - heel_y
    first, fifth = (landmarks[f"metatarsal_head_{n}"].point[:2] for n in (1, 5))
    left, right = sorted((first, fifth), key=lambda point: float(point[0]))
    ball = np.array([left + 3 * (left - right), left, right, right + 3 * (right - left)])
    ball[:, 1] -= _BEHIND_HEADS * length
    heel = np.array([[ball[0, 0], heel_y + _HEEL * length], [ball[3, 0], heel_y + _HEEL * length]])
    behind, ahead = (np.array([[ball[0, 0], y], [ball[3, 0], y]]) for y in (-_FAR_MM, _FAR_MM))
    rear, front = {
        "heel": (behind, heel),
        "arch": (heel, ball),
        "forefoot": (ball, ahead),
    }[zone.kind]
    outline: FloatArray = np.concatenate([rear, front[::-1]])
    return manifold3d.CrossSection([outline], manifold3d.FillRule.NonZero)


def _outlined(mask: BoolArray, field: HeightField) -> manifold3d.CrossSection:
    """Return the area around the nodes of a grid that are true: half a step around each."""
    padded = np.pad(mask.astype(np.uint8), 1)
    contours, _ = cv2.findContours(padded, cv2.RETR_CCOMP, cv2.CHAIN_APPROX_NONE)
    corner = np.array([field.x0_mm, field.y0_mm])
    rings = [
        corner + field.step_mm * (contour[:, 0].astype(float) - 1)
        for contour in contours
        if len(contour) > 2
    ]
    plan = manifold3d.CrossSection(rings, manifold3d.FillRule.EvenOdd)
    return plan.offset(field.step_mm / 2, manifold3d.JoinType.Round)


def placed_print(printed: PrintedPart, insole2file: FloatArray) -> PrintedPart:
    """Return a part with its zones where it lies in a file.

    Parameters
    ----------
    insole2file : (4, 4) float64, mm
    """

    def moved(mesh: TriangleMesh) -> TriangleMesh:
        return mesh.transformed(insole2file)

    return replace(
        printed,
        mesh=moved(printed.mesh),
        modifiers=tuple(replace(zone, mesh=moved(zone.mesh)) for zone in printed.modifiers),
    )
