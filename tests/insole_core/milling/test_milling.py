"""Programs for routers: what they leave of a block, by an independent simulation of their text."""

from __future__ import annotations

import errno
import json
import math
import re
import shutil
import subprocess
import tracemalloc
from dataclasses import replace
from functools import cache
from itertools import groupby, pairwise
from pathlib import Path

import manifold3d
import numpy as np
import numpy.typing as npt
import pytest
import scipy

from insole_core.errors import DesignError, InputError, OutputError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.milling.contours import contour_loops
from insole_core.milling.gcode import gcode, origin_mm, programs, stations
from insole_core.milling.machine import Machine, read_machine, write_machine
from insole_core.milling.plan import FootInBlock, MillingPlan, plan_milling
from insole_core.milling.sides import turned_over
from insole_core.milling.spoil_board import spoil_board_plan
from insole_core.milling.stock import MOST_BEYOND, Stock, runs_of_closed
from insole_core.milling.surface import sample_surface
from insole_core.milling.tool_path import PathWriter, densified, motion_minutes
from insole_core.resources import resource_path
from insole_core.solids.export_job import ExportPaths
from insole_core.solids.shop import Block
from insole_core.solids.simplification import from_manifold
from insole_core.workflows.mill import write_milling
from tests.insole_core.milling.engagement import moves_of
from tests.insole_core.milling.judgement import (
    edge_round,
    judge,
    seen_from_above,
    tab_thicknesses,
    tabs_that_hold,
)
from tests.insole_core.milling.planner import program_minutes
from tests.insole_core.milling.removal import Removal, Tool

FloatArray = npt.NDArray[np.float64]
BLOCK_MM = (80.0, 110.0, 26.0)
TABS = 6
"""For which there is room round the piece."""
NAMES = ("linuxcnc", "grbl", "mach3")
PITCH_MM = 0.5
GOUGE_MM, SURPLUS_MM = 0.02, 0.05
THICK = 0.8
"""Share of the thickness asked for that tabs have, or it is told."""


@cache
def machine(name: str = "linuxcnc") -> Machine:
    return read_machine(resource_path(f"milling/{name}.json"))


@cache
def solid(*, arched: bool = False, groove: bool = False, lean: float = 0.015) -> TriangleMesh:
    """Return an oval piece with a cup, a hill and drafted walls, standing in the block."""
    count = 90
    u, v = np.meshgrid(*[np.linspace(-1, 1, count)] * 2, indexing="ij")
    x, y = 24 * u * np.sqrt(1 - v**2 / 2), 34 * v * np.sqrt(1 - u**2 / 2)
    away = np.hypot(x / 24, y / 34)
    top = 8 + 9 * away**4 / (1 + np.exp(y / 4)) + 4 * np.exp(-((x - 4) ** 2 + (y - 12) ** 2) / 60)
    if groove:
        top -= 4 * np.exp(-(x**2) / 2)
    bottom = 3 * np.exp(-((x + 5) ** 2 + y**2) / 120) if arched else np.zeros_like(x)
    wide = 1 + lean * (away > 0.999)  # a wall of usual height leans by 1 to 2 degrees
    vertices = np.concatenate(
        [
            np.stack([x, y, top], -1).reshape(-1, 3),
            np.stack([x * wide, y * wide, bottom], -1).reshape(-1, 3),
        ]
    )
    index = np.arange(count**2).reshape(count, count)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    up = np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])
    ring = np.concatenate([index[:-1, 0], index[-1, :-1], index[:0:-1, -1], index[0, :0:-1]])
    after, low = np.roll(ring, -1), count**2
    wall = np.concatenate(
        [np.stack([ring, ring + low, after + low], -1), np.stack([ring, after + low, after], -1)]
    )
    middle = np.array([BLOCK_MM[0] / 2, BLOCK_MM[1] / 2, 0])
    triangles = np.concatenate([up, up[:, ::-1] + low, wall]).astype(np.int32)
    return TriangleMesh(vertices + middle, triangles)


@cache
def planned_once(form: str, *, both_sides: bool) -> MillingPlan:
    """Plan one of the forms of `solid`."""
    return plan_milling([solid(**{form: True})], BLOCK_MM, machine(), both_sides=both_sides)


def planned(name: str = "linuxcnc", form: str = "arched", *, both_sides: bool) -> MillingPlan:
    """Plan one of the forms of `solid` for a machine as it is delivered: all mill alike."""
    plan, how = planned_once(form, both_sides=both_sides), machine(name)
    alike = replace(plan.machine, name=how.name, origin=how.origin, program_files=how.program_files)
    assert replace(alike, texts=how.texts) == how
    return replace(plan, machine=how)


def narrowed(piece: TriangleMesh, share: float = 0.4) -> TriangleMesh:
    """Return a narrower and shorter piece at the same place of the block, for short paths."""
    middle = np.array([BLOCK_MM[0] / 2, BLOCK_MM[1] / 2, 0])
    vertices = (piece.vertices - middle) * [share, share, 1] + middle
    return TriangleMesh(vertices, piece.triangles)


def left_of(plan: MillingPlan, text: str, pitch_mm: float = PITCH_MM) -> Removal:
    tools = {c.number: Tool(c.shape, c.diameter_mm / 2) for c in plan.machine.cutters}
    x, y, z = origin_mm(plan.machine, plan.block_mm)
    removal = Removal(
        plan.block_mm, (x, y, z), tools, along_x=plan.machine.length_along == "x", pitch_mm=pitch_mm
    )
    removal.run(text)
    return removal


def check_side(
    mesh: TriangleMesh,
    left: FloatArray,
    removal: Removal,
    how: Machine,
    floor_mm: float | FloatArray,
) -> None:
    found = judge(mesh, left, removal, how, floor_mm)
    assert found.gouge_mm < GOUGE_MM
    assert found.surplus_mm < SURPLUS_MM
    assert found.beside_mm < SURPLUS_MM


def check_moves(removal: Removal, how: Machine) -> None:
    assert removal.rapid_cuts_mm < 0.01
    assert (removal.low_mm > -1e-6).all()
    assert (removal.high_mm[:2] < np.array(BLOCK_MM[:2]) + 1e-6).all()
    assert removal.high_mm[2] <= BLOCK_MM[2] + how.safe_height_mm + 1e-6
    moves = {"G0", "G1", "G4", "G17", "G21", "G40", "G43", "G49", "G53", "G54", "G64", "G80"}
    moves |= {"G90", "G94"}
    assert {word for word in removal.words if word[0] == "G"} <= moves


def ring_round(mesh: TriangleMesh, removal: Removal) -> npt.NDArray[np.bool_]:
    inside = np.isfinite(seen_from_above(mesh, removal)[0])
    beside = scipy.ndimage.distance_transform_edt(~inside) * removal.pitch_mm
    return np.asarray((beside > 0.8) & (beside < 5.0))


def test_one_side_is_left_as_asked_and_held_by_tabs():
    how, piece = machine(), solid()
    how = replace(how, contour=replace(how.contour, tabs=4))
    plan = plan_milling([piece], BLOCK_MM, how)
    assert plan.notes == ()
    removal = left_of(plan, gcode(plan, "A-1"))
    check_side(piece, removal.heights, removal, how, how.contour.tab_height_mm)
    check_moves(removal, how)
    ring = ring_round(piece, removal)
    tabs, count = scipy.ndimage.label(ring & (removal.heights > 0.01), np.ones((3, 3)))
    assert count == how.contour.tabs
    assert removal.heights[ring].max() == pytest.approx(how.contour.tab_height_mm, abs=0.01)
    across = [np.ptp(np.argwhere(tabs == n + 1), axis=0).max() * PITCH_MM for n in range(count)]
    assert all(how.contour.tab_length_mm - 1 < size < 16 for size in across)
    assert held(piece, removal, how) == how.contour.tabs


def held(mesh: TriangleMesh, removal: Removal, how: Machine) -> int:
    inside = np.isfinite(seen_from_above(mesh, removal)[0])
    return tabs_that_hold(removal, inside, how.contour.cutter.diameter_mm)


def test_tabs_hold_a_thin_edge_and_leave_it_clean():
    piece = feathered(solid(lean=0.001), 1.0)
    plan = plan_milling([piece], BLOCK_MM, how := machine())
    removal = left_of(plan, gcode(plan))
    check_side(piece, removal.heights, removal, how, how.contour.tab_height_mm)
    assert held(piece, removal, how) == TABS


def feathered(piece: TriangleMesh, edge_mm: float) -> TriangleMesh:
    """Return a piece whose top slopes down to an edge of little height."""
    x, y, z = piece.vertices.T
    away = np.hypot((x - BLOCK_MM[0] / 2) / 24, (y - BLOCK_MM[1] / 2) / 34)
    top = edge_mm + 0.35 * 24 * np.clip(1 - away, 0, 0.4)
    return TriangleMesh(np.column_stack([x, y, np.where(z > 0, top, z)]), piece.triangles)


def test_the_wall_of_a_lower_part_is_cut_from_its_own_top():
    tall = manifold3d.Manifold.cylinder(20, 14, 13.3, 48).translate((38, 30, 0))
    low = manifold3d.Manifold.cylinder(14, 12, 11.5, 48).translate((40, 72, 0))
    bridge = manifold3d.Manifold.cube((6, 40, 5)).translate((36, 30, 0))
    body = (tall + low + bridge).to_mesh()
    piece = TriangleMesh(
        np.asarray(body.vert_properties[:, :3], float), np.asarray(body.tri_verts, np.int32)
    )
    how = machine()
    plan = plan_milling([piece], BLOCK_MM, how)
    removal = left_of(plan, gcode(plan), 0.6)
    found = judge(piece, removal.heights, removal, how, how.contour.tab_height_mm)
    assert found.gouge_mm < GOUGE_MM
    i, j = np.nonzero(found.surpluses > SURPLUS_MM)
    round_low = np.hypot(removal.x_mm[i] - 40, removal.y_mm[j] - 72) > 10
    assert not (round_low & (removal.y_mm[j] > 66)).any()


def check_both_sides(piece: TriangleMesh, how: Machine) -> tuple[TriangleMesh, Removal]:
    plan = plan_milling([piece], BLOCK_MM, how, both_sides=True)
    removal = left_of(plan, gcode(plan))
    check_moves(removal, how)
    lift = np.array([0, 0, how.both_sides.skin_mm])
    lying = TriangleMesh(piece.vertices + lift, piece.triangles)
    turned = turned_over(lying, BLOCK_MM, "length")
    edge = edge_round(turned, removal)
    tabs = np.flip(BLOCK_MM[2] - edge, axis=0) + how.contour.tab_height_mm
    check_side(lying, removal.sides[0], removal, how, tabs)
    check_side(turned, removal.sides[1], removal, how, edge)
    assert held(turned, removal, how) == TABS
    inside = np.isfinite(seen_from_above(turned, removal)[0])
    left = tab_thicknesses(removal, inside, how.contour.cutter.diameter_mm)
    assert left.min() >= THICK * how.contour.tab_height_mm
    return turned, removal


def test_both_sides_meet_in_the_turned_block():
    how = machine()
    turned, removal = check_both_sides(solid(arched=True), how)
    first, second = removal.sides
    # What is left between the two sides are the tabs.
    below = np.flip(BLOCK_MM[2] - first, axis=0)
    ring = ring_round(turned, removal)
    thick = np.where(ring, second - below, 0)
    assert thick.max() == pytest.approx(how.contour.tab_height_mm, abs=0.05)
    assert (thick > 0.01).sum() < 0.8 * ring.sum()
    # The holes are bored through, at the same places seen from either side.
    for y in (how.both_sides.dowel_inset_mm, BLOCK_MM[1] - how.both_sides.dowel_inset_mm):
        hole = first[int(BLOCK_MM[0] / 2 / PITCH_MM), int(y / PITCH_MM)]
        assert hole == pytest.approx(0.0, abs=0.01)


def cupped(power: int, uneven: float = 0.0) -> TriangleMesh:
    """Return a shell whose underside falls to its edge, which may rise and sink."""
    piece = solid(lean=0.001)
    x, y, z = piece.vertices.T
    u, v = (x - BLOCK_MM[0] / 2) / 24, (y - BLOCK_MM[1] / 2) / 34
    edge = 6 * (1 + uneven * np.sin(2 * np.arctan2(v, u)))
    below = edge * np.clip(np.hypot(u, v), 0, 1) ** power
    heights = np.where(z < 1e-6, below, np.maximum(z, 9))
    return TriangleMesh(np.column_stack([x, y, heights]), piece.triangles)


def test_a_cupped_underside_is_milled_to_its_edge_and_held_there():
    check_both_sides(cupped(2), machine())


def test_a_steep_edge_that_rises_and_sinks_is_milled_without_steps():
    how, piece = machine(), cupped(6, 0.3)
    plan = plan_milling([piece], BLOCK_MM, how, both_sides=True)
    removal = left_of(plan, gcode(plan))
    check_moves(removal, how)
    lying = TriangleMesh(piece.vertices + np.array([0, 0, how.both_sides.skin_mm]), piece.triangles)
    turned = turned_over(lying, BLOCK_MM, "length")
    check_side(turned, removal.sides[1], removal, how, edge_round(turned, removal))
    assert held(turned, removal, how) == TABS
    inside = np.isfinite(seen_from_above(turned, removal)[0])
    left = tab_thicknesses(removal, inside, how.contour.cutter.diameter_mm)
    assert (left < THICK * how.contour.tab_height_mm).sum() == 1
    (told,) = (note for note in plan.notes if "tabs stay thinner" in note)
    assert "1 of 6 tabs stay thinner than the 2 mm" in told


def test_the_origin_and_the_machines_axes_change_the_numbers_only():
    along_y = machine("linuxcnc")
    along_x = replace(machine("mach3"), length_along="x")
    assert along_x.origin.at == "middle"
    assert along_x.origin.height == "top"
    pieces = []
    for name, how in (("linuxcnc", along_y), ("mach3", along_x)):
        plan = replace(planned(name, "groove", both_sides=False), machine=how)
        pieces.append(left_of(plan, gcode(plan), 1.0).heights)
    assert np.abs(pieces[0] - pieces[1]).max() < 0.01


def rs274() -> str:
    found = shutil.which("rs274")
    if found is None:
        pytest.skip("the program rs274 (linuxcnc-uspace) is not installed")
    return found


@pytest.mark.parametrize("name", NAMES)
def test_linuxcnc_interprets_the_program(tmp_path, name):
    program = rs274()
    plan = planned(name, both_sides=True)
    (tmp_path / "piece.ngc").write_text(gcode(plan), encoding="ascii")
    (tmp_path / "tools.tbl").write_text("T1 P1 Z0 D6\nT2 P2 Z0 D6\n")
    (tmp_path / "variables").touch()
    call = [program, "-t", "tools.tbl", "-v", "variables", "-g", "piece.ngc", "moves"]
    done = subprocess.run(call, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    moves = (tmp_path / "moves").read_text()
    points = sum(len(operation.points_mm) for operation in plan.operations)
    straight = len(re.findall(r"STRAIGHT_(?:FEED|TRAVERSE)", moves))
    assert points * 0.98 < straight <= points + len(plan.operations)
    assert "CANON_UNITS_INCHES" not in moves
    assert moves.count("PROGRAM_END") == 1


def test_a_program_has_numbers_for_every_controller():
    plan = planned("grbl", "groove", both_sides=False)
    text = gcode(plan, "Åsa (x) %")
    assert text.isascii()
    assert re.search(r"\dE|\d,\d|NAN|INF", text.upper()) is None
    assert "( sa" not in text.splitlines()[0]
    assert text.splitlines()[0].count("(") == 1
    for operation in plan.operations:
        before, after = (
            np.diff(operation.points_mm[:-1], axis=0),
            np.diff(operation.points_mm[1:], axis=0),
        )
        feed = (operation.motion[1:-1] == 2) & (operation.motion[2:] == 2)
        lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
        straight = (before * after).sum(axis=1) > lengths * (1 - 1e-10)
        assert (straight & feed).sum() < 0.02 * len(feed)


@pytest.mark.parametrize(
    ("name", "parking"),
    [("linuxcnc", "G53 G0 Z0"), ("mach3", "G53 G0 Z0"), ("grbl", "G0 Z58"), ("grbl", "G0 Z46")],
)
def test_every_stop_is_made_at_the_parking_place(name, parking):
    """58 = block + safe height + block again: it is lifted off its dowels below the cutter."""
    plan = planned(name, both_sides=True)
    if parking == "G0 Z46":
        how = replace(plan.machine, travel_mm=(*plan.machine.travel_mm[:2], 46.0))
        plan = replace(plan, machine=how)
    lines = [re.sub(r"\(.*?\)", "", line).strip() for line in gcode(plan).splitlines()]
    moves = [line for line in lines if line]
    first_cut = next(n for n, line in enumerate(moves) if line.startswith("G1 "))
    stops = [n for n, line in enumerate(moves) if n > first_cut and line == "M5"]
    assert len(stops) >= 3
    for stop in stops:
        assert moves[stop - 1] == parking
    for stop in stops[:-1]:
        after = [line for line in moves[stop:] if re.match(r"G[01] ", line)]
        assert re.fullmatch(r"G0 X[-\d.]+ Y[-\d.]+", after[0])
        assert re.fullmatch(r"G0 Z[-\d.]+", after[1])


def test_a_machine_that_cannot_be_moved_while_it_holds_gets_a_file_for_each_cutter_and_side():
    how = machine("grbl")
    plan = planned("grbl", both_sides=True)
    files = programs(plan, stations(how, both_sides=True), "A-1")
    assert len(files) == 6
    for number, file in enumerate(files, 1):
        lines = file.text.splitlines()
        head = lines[: next(n for n, line in enumerate(lines) if line.startswith("G0"))]
        assert not re.search(r"\bM0\b", file.text)
        assert head.count("(A-1)") == 1
        assert sum("M3" in line for line in head) == 1
        assert any(f"File {number} of 6" in line for line in head)
        assert any("foot side down" in line for line in head) == (number > 3)
        (tool,) = {operation.cutter.number for operation in file.operations}
        assert sum(f"Put in tool {tool}:" in line for line in lines) == 1
        assert any("Zero G54" in line for line in head)
        assert lines[-1] == "M2"
    whole, apart = (
        left_of(plan, text, 1.0) for text in (gcode(plan), "".join(file.text for file in files))
    )
    for one, other in zip(whole.sides, apart.sides, strict=True):
        assert np.array_equal(one, other)
    assert apart.rapid_cuts_mm < 0.01


def test_a_machine_file_from_before_these_keys_has_the_usual_ones(tmp_path):
    content = json.loads(resource_path("milling/linuxcnc.json").read_text())
    del content["work_offset"], content["acceleration_mm_s2"], content["texts"]["parking"]
    del content["cutters"][0]["flute_mm"]
    path = Path(tmp_path / "machine.json")
    path.write_text(json.dumps(content))
    how = read_machine(path)
    assert how.texts.parking == ("G0 Z{park_mm}",)
    assert how.work_offset == "G54"
    assert how.acceleration_mm_s2 == (500.0, 500.0, 200.0)
    assert [cutter.flute_mm for cutter in how.cutters] == [60.0, 22.0]


@pytest.mark.parametrize(("form", "both_sides"), [("arched", True), ("groove", False)])
def test_every_move_stays_within_step_down_width_and_flutes_and_none_falls_into_solid(
    form, both_sides
):
    for moves in moves_of(planned("grbl", form, both_sides=both_sides)):
        assert not moves.fast_plunges.any()
        assert moves.depth_mm[~moves.cuts].max() < 0.05
        assert not moves.too_deep.any()
        assert not moves.too_wide.any()
        assert not moves.above_flutes.any()
        if moves.operation.name == "roughing":
            assert (
                moves.plunges.sum() < 4
            )  # none where a line lies lower for a way without room for a ramp


def test_a_machine_file_from_before_keeps_the_offset_of_its_header(tmp_path):
    content = json.loads(resource_path("milling/linuxcnc.json").read_text())
    del content["work_offset"]
    content["texts"]["header"] += ["G55 (of the left table, not G54)"]
    path = Path(tmp_path / "machine.json")
    path.write_text(json.dumps(content))
    assert read_machine(path).work_offset == "G55"


@pytest.mark.parametrize("dowel_mm", [6.0, 6.002, 8.0])
def test_a_dowel_hole_of_any_width_is_a_short_path(dowel_mm):
    how = machine()
    how = replace(how, both_sides=replace(how.both_sides, dowel_diameter_mm=dowel_mm))
    how = replace(how, finishing=replace(how.finishing, step_over_mm=1.0))
    plan = plan_milling([narrowed(solid())], BLOCK_MM, how, both_sides=True)
    assert plan.operations[0].name == "dowels"
    assert len(plan.operations[0].points_mm) < 1500


def test_the_chosen_work_offset_stands_in_the_program():
    for chosen in ("G54", "G57"):
        plan = planned("linuxcnc", "groove", both_sides=False)
        plan = replace(plan, machine=replace(plan.machine, work_offset=chosen))
        offsets = re.findall(r"\bG5[4-9]\b", gcode(plan))
        assert offsets == [chosen]


@pytest.mark.parametrize(
    ("name", "acceleration", "both_sides"),
    [
        ("linuxcnc", (500.0, 500.0, 200.0), False),
        ("grbl", (2000.0, 150.0, 30.0), True),
        ("mach3", (1e5, 1e5, 1e5), False),
    ],
)
def test_time_and_length_are_those_of_a_planner_that_reads_the_program(
    name, acceleration, both_sides
):
    how = replace(machine(name), acceleration_mm_s2=acceleration, length_along="x")
    form = "arched" if both_sides else "groove"
    plan = replace(planned(name, form, both_sides=both_sides), machine=how)
    minutes, plain, metres = program_minutes(gcode(plan), how.rapid_mm_min, acceleration)
    assert plan.length_m == pytest.approx(metres, rel=0.01)
    assert plan.minutes == pytest.approx(minutes, rel=0.03)
    assert (plan.minutes < 1.05 * plain) == (name == "mach3")


@pytest.mark.parametrize(
    ("points", "seconds"),
    [
        ([(0, 0, 0), (100, 0, 0)], 2.1),  # up to 50 mm/s in 0.1 s and 2.5 mm, and back
        ([(0, 0, 0), (40, 0, 0), (40, 0, 0), (100, 0, 0)], 2.1),
        ([(0, 0, 0), (2, 0, 0)], 2 * math.sqrt(2 / 500)),  # never at full speed
        ([(0, 0, 0), (0, 0, 100)], 2.25),  # the upright axis is slower
        ([(0, 0, 0), (100, 0, 0), (0, 0, 0)], 4.2),  # it turns back at rest
    ],
)
def test_a_move_is_a_trapezoid_of_speed(points, seconds):
    path = np.array(points, float)
    speed = np.full(len(path) - 1, 3000.0)
    minutes = motion_minutes(path, speed, np.array([500.0, 500.0, 200.0]))
    assert minutes.sum() * 60 == pytest.approx(seconds, rel=1e-6)


def test_a_right_angle_is_passed_at_the_speed_of_its_arc():
    path = np.array([[0, 0, 0], [100, 0, 0], [100, 100, 0]], float)
    minutes = motion_minutes(path, np.full(2, 3000.0), np.array([500.0, 500.0, 500.0]))
    half = math.sqrt(0.5)
    corner = math.sqrt(500 / half * 0.01 * half / (1 - half))
    ramp, way = (50 - corner) / 500, (50**2 - corner**2) / 1000
    assert minutes[0] * 60 == pytest.approx(0.1 + ramp + (100 - 2.5 - way) / 50, rel=1e-9)
    assert minutes[0] == pytest.approx(minutes[1])


def test_a_hollow_too_tight_for_the_cutter_is_told_with_its_place():
    how = machine()
    how = replace(how, finishing=replace(how.finishing, step_over_mm=0.8))
    plan = plan_milling([solid(groove=True)], BLOCK_MM, how)
    (note,) = plan.notes
    assert '"6 mm ball nose" is too thick for a hollow' in note
    assert "x = 40 mm" in note
    for side, turned, words in (
        (Side.LEFT, False, "from the heel in the middle"),
        (Side.RIGHT, True, "from the heel in the middle"),
    ):
        feet = [FootInBlock(side, turned, "26-7" if turned else "")]
        (said,) = plan_milling([solid(groove=True)], BLOCK_MM, how, feet=feet).notes
        assert words in said
        assert said.startswith("26-7 right: ") == turned
    deepest = float(np.nanmax(plan.left_over[0].height_mm))
    on_piece = plan.left_on(0)
    tight = plan.solids[0].vertices[on_piece > 0.8 * deepest]
    assert tight[:, 0] == pytest.approx(40, abs=1.5)
    assert np.isnan(on_piece[plan.solids[0].vertices[:, 2] == 0]).all()  # the bottom
    removal = left_of(plan, gcode(plan))
    asked, _ = seen_from_above(solid(groove=True), removal)
    within = scipy.ndimage.binary_erosion(np.isfinite(asked), iterations=8)
    stays = (removal.heights - asked)[within].max()
    assert stays == pytest.approx(deepest, abs=0.05)


@pytest.mark.parametrize(
    ("block_mm", "changes", "sentence"),
    [
        ((80.0, 110.0, 12.0), {}, "The block is 12 mm high, and the piece needs"),
        ((60.0, 110.0, 26.0), {}, "does not lie within the block"),
        (BLOCK_MM, {"travel_mm": (50.0, 500.0, 120.0)}, "travels 50 mm along x"),
        (BLOCK_MM, {"reach_mm": 12.0}, "reaches 12 mm, and must go 26.0 mm deep"),
        (BLOCK_MM, {"shank_mm": 8.0}, "edges, which are 22 mm long, and must go 26.0 mm deep"),
        (BLOCK_MM, {"offset_mm": (-5.0, 0.0)}, "origin of LinuxCNC lies outside the block"),
    ],
)
def test_what_cannot_be_milled_is_one_sentence(block_mm, changes, sentence):
    how = machine()
    if "travel_mm" in changes:
        how = replace(how, travel_mm=changes["travel_mm"])
    if "offset_mm" in changes:
        how = replace(how, origin=replace(how.origin, offset_mm=changes["offset_mm"]))
    if changes.keys() & {"reach_mm", "shank_mm"}:
        other = replace(how.contour.cutter, **changes)
        how = replace(how, contour=replace(how.contour, cutter=other))
    with pytest.raises(DesignError, match=sentence):
        plan_milling([solid()], block_mm, how)


def test_every_part_of_a_piece_needs_room_for_the_contour():
    large = manifold3d.Manifold.cube((30, 50, 9)).translate((25, 30, 0))
    small = manifold3d.Manifold.cube((6, 8, 9)).translate((72, 50, 0))
    with pytest.raises(DesignError, match=r"1\.0 mm too little of the block for the cutter"):
        plan_milling([from_manifold(large + small)], BLOCK_MM, machine())


@pytest.mark.parametrize(("gap_mm", "is_refused"), [(5.9, True), (6.0, False)])
def test_the_cutter_of_the_contour_needs_room_between_two_pieces(gap_mm, is_refused):
    how = machine()
    how = replace(how, finishing=replace(how.finishing, step_over_mm=1.0))
    pieces = [
        from_manifold(manifold3d.Manifold.cube((12, 15, 5)).translate((x, 12, 0)))
        for x in (12, 24 + gap_mm)
    ]
    block_mm = (60.0, 40.0, 8.0)
    if is_refused:
        with pytest.raises(DesignError, match=r'"6 mm flat end".* needs 6 mm between two pieces'):
            plan_milling(pieces, block_mm, how)
    else:
        assert plan_milling(pieces, block_mm, how).operations


def with_contour(how: Machine, **changes: float) -> Machine:
    cutter = replace(how.contour.cutter, **changes)
    return replace(how, contour=replace(how.contour, cutter=cutter))


@pytest.mark.parametrize("changes", [{"reach_mm": 25.5}, {"flute_mm": 25.5, "shank_mm": 8.0}])
def test_a_dowel_hole_is_no_deeper_than_the_cutter_reaches(changes):
    """It reaches the piece above the skin, and no farther."""
    how = with_contour(machine(), **changes)
    with pytest.raises(DesignError, match=r"goes 25\.5 mm deep into a hole.* 26 mm deep"):
        plan_milling([solid()], BLOCK_MM, how, both_sides=True)
    deep = replace(how, both_sides=replace(how.both_sides, board_depth_mm=40.0))
    with pytest.raises(DesignError, match=r"goes 25\.5 mm deep into a hole.* 40 mm deep"):
        spoil_board_plan(deep, BLOCK_MM)


def test_a_wide_cutter_on_a_long_way_takes_little_memory():
    box = from_manifold(manifold3d.Manifold.cube((20, 20, 5)).translate((10, 10, 0)))
    surface = sample_surface([box], (40.0, 40.0, 10.0), 5.0, 0.5)
    stock = Stock(surface, 10.0, 1.0)
    wide = replace(machine().finishing.cutter, diameter_mm=12.0)
    stock.sweep(np.full(surface.inside.shape, 6.0), np.ones(surface.inside.shape, bool), wide)
    count = 30_000
    places = np.random.default_rng(0).uniform(5, 35, (count, 2))
    way = np.column_stack([places, np.full(count, 4.0)])
    asked = (
        stock.last_swept,
        lambda: stock.over(way, wide),
        lambda: stock.cut(way[::50], wide),
    )
    for ask in asked:
        tracemalloc.start()
        ask()
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        assert most < 1e8


@pytest.mark.parametrize("step_mm", [0.25, 0.1])
def test_what_a_ball_leaves_between_its_lines_is_exact_at_every_node(step_mm):
    box = from_manifold(manifold3d.Manifold.cube((20, 20, 5)).translate((10, 10, 0)))
    surface = sample_surface([box], (40.0, 40.0, 10.0), 5.0, step_mm)
    stock, ball = Stock(surface, 10.0, 1.0), machine().finishing.cutter
    active = np.zeros(surface.inside.shape, bool)
    active[: -active.shape[0] // 3 : round(1 / step_mm)] = True
    active[7, 3:11] = True
    stock.sweep(np.full(active.shape, 6.0), active, ball)
    away_mm = scipy.ndimage.distance_transform_edt(~active)[:: stock.every, :: stock.every]
    inset_mm = np.sqrt(np.clip(ball.radius_mm**2 - (away_mm * step_mm) ** 2, 0, None))
    swept = away_mm * step_mm < ball.radius_mm - step_mm / 2
    beyond = away_mm * step_mm > ball.radius_mm + step_mm / 2
    left = stock.last_swept()
    np.testing.assert_allclose(left[swept], (6 + ball.radius_mm - inset_mm)[swept], atol=1e-5)
    assert (left[beyond] > 10).all()


@pytest.mark.parametrize("shape", ["flat", "ball"])
def test_a_way_takes_away_what_its_places_take_one_by_one(shape):
    box = from_manifold(manifold3d.Manifold.cube((20, 20, 5)).translate((10, 10, 0)))
    surface = sample_surface([box], (40.0, 40.0, 10.0), 5.0, 0.25)
    cutter = replace(machine().contour.cutter, shape=shape)
    whole, single = Stock(surface, 10.0, 1.0), Stock(surface, 10.0, 1.0)
    random = np.random.default_rng(1)
    way = np.cumsum(random.uniform(-1.5, 1.5, (60, 3)), axis=0) + np.array([20.0, 20.0, 5.0])
    way[:, 2] = np.round(np.clip(way[:, 2], 1, 9))
    whole.cut(way, cutter)
    for place in densified(way, 0.25):
        single.cut(np.stack([place, place]), cutter)
    np.testing.assert_array_equal(whole.heights_mm, single.heights_mm)
    assert (whole.heights_mm < 10).any()


@pytest.mark.parametrize("length_mm", [40.0, 25.2])  # at the side of the block, beyond its nodes
def test_a_strip_between_two_nodes_is_cut_step_by_step(length_mm):
    box = from_manifold(manifold3d.Manifold.cube((20, 8, 5)).translate((10, 4, 0)))
    surface, cutter = (
        sample_surface([box], (40.0, length_mm, 10.0), 22.0, 0.25),
        machine().contour.cutter,
    )
    stock, writer = Stock(surface, 10.0, 1.0), PathWriter(16.0)
    stock.go_along_walls(np.full(surface.inside.shape, MOST_BEYOND, np.float32))
    x = np.arange(8.0, 33.0, 0.5)
    cleared = np.column_stack([x, np.full(len(x), 22.12), np.full(len(x), 4.0)])
    stock.cut(cleared, cutter)
    stock.write(cleared + np.array([0.0, 0.02, 0.0]), writer, cutter, 1.0)
    path = writer.operation("contour", "foot side", cutter).points_mm
    low = path[path[:, 2] < 9.5, 2]
    assert np.unique(np.round(low, 3)).tolist() == [4.0, 5.0, 6.0, 7.0, 8.0, 9.0]


def test_no_way_round_a_solid_leads_nearer_than_the_one_above_it_also_in_the_program():
    loops = contour_loops(solid(lean=0.002), machine(), BLOCK_MM, 0.0)
    levels = [
        manifold3d.CrossSection([np.round(loop.line_mm[:-1], 3) for loop in level])
        for _, level in groupby(loops, lambda loop: loop.level_mm)
    ]
    assert len(levels) > 15
    for above, below in pairwise(levels):
        assert (above - below).area() == 0


def test_a_tab_beside_which_no_block_stays_is_moved_or_told():
    how = machine()
    width, length = 48.8 + 2 * 4.5, BLOCK_MM[1]
    moved = TriangleMesh(solid().vertices - [(BLOCK_MM[0] - width) / 2, 0, 0], solid().triangles)
    plan = plan_milling([moved], (width, length, BLOCK_MM[2]), how)
    (told,) = (note for note in plan.notes if "tabs stay thinner" in note)
    assert "the thinnest 0.0 mm" in told
    assert "no block stays beside it" in told
    few = replace(how, contour=replace(how.contour, tabs=2))  # room to go to the ends
    plan = plan_milling([moved], (width, length, BLOCK_MM[2]), few)
    assert not any("tabs stay thinner" in note for note in plan.notes)


def test_a_closed_way_is_cut_where_it_is_not_kept():
    ring = np.arange(8.0)[:, None]
    kept = np.array([1, 1, 0, 0, 1, 0, 1, 1], bool)
    (run,) = runs_of_closed(ring, kept)  # over the seam; the single point is no way
    assert run.ravel().tolist() == [6, 7, 0, 1]
    (whole,) = runs_of_closed(ring, np.ones(8, bool))
    assert whole.ravel().tolist() == [*range(8), 0]
    assert runs_of_closed(ring, np.zeros(8, bool)) == []


def test_a_dowel_needs_room():
    how = machine()
    near = replace(how, both_sides=replace(how.both_sides, dowel_inset_mm=20.0))
    with pytest.raises(DesignError, match="dowel at x = 40 mm, y = 20 mm of the block has no room"):
        plan_milling([solid()], BLOCK_MM, near, both_sides=True)
    thin = replace(how, both_sides=replace(how.both_sides, dowel_diameter_mm=4.0))
    with pytest.raises(DesignError, match="A dowel hole of 4 mm cannot be bored"):
        plan_milling([solid()], BLOCK_MM, thin, both_sides=True)


@pytest.mark.parametrize("name", NAMES)
def test_a_machine_is_kept_as_it_is(tmp_path, name):
    write_machine(machine(name), tmp_path / "own.json")
    assert read_machine(tmp_path / "own.json") == machine(name)


@pytest.mark.parametrize(
    ("keys", "value", "sentence"),
    [
        (("cutters", 0, "spindle_rpm"), 0, r"cutters\[0\].spindle_rpm is 0, so that the cutter"),
        (("cutters", 1, "feed_mm_min"), 0, r"cutters\[1\].feed_mm_min is 0"),
        (("texts", "header"), ["G21 {patient}"], 'has the word "patient", which no controller'),
        (("texts", "header"), ["PLEASE START"], 'has the word "PLEASE", which no controller'),
        (("texts", "header"), ["G21 (open"], 'has the word "\\(OPEN", which no controller'),
        (("texts", "header"), ["G21 X 1 FOO"], 'has the word "FOO", which no controller'),
        (("texts", "header"), ["G20"], '"G20", which changes the units'),
        (("texts", "header"), ["G21 G91"], '"G91", which changes the units'),
        (("texts", "footer"), ["{job.x}"], "which no controller knows"),
        (("texts", "footer"), ["M3 {"], "which no controller knows"),
        (("finishing", "cutter"), 1, "a flat one, and must be a ball one"),
        (("contour", "cutter"), 7, "no cutter has that number"),
        (("cutters", 1, "number"), 1, "has two cutters of one number"),
        (("origin", "at"), "above", 'must be "corner" or "middle"'),
        (("acceleration_mm_s2",), [500, 500], "acceleration_mm_s2"),
        (("acceleration_mm_s2",), [500, 0, 500], "acceleration_mm_s2"),
        (("cutters", 0, "flute_mm"), 61.0, r"cutters\[0\].flute_mm is 61"),
        (("cutters", 0, "flute_mm"), 4.0, "roughing.step_down_mm is 6"),
        (("roughing", "width_mm"), 2.5, "roughing.width_mm is 2.5"),
        (("texts", "header"), ["G55"], "texts.header selects G55, and the program is made for G54"),
        (("program_files",), "two", 'program_files is "two", but must be "one" or "each cutter"'),
        (("work_offset",), "G92", 'work_offset is "G92", but must be "G54", "G55"'),
        (("texts", "parking"), ["G0 Z{high}"], 'has the word "high", which no controller'),
    ],
)
def test_a_machine_file_that_is_wrong_names_the_key(tmp_path, keys, value, sentence):
    content = json.loads(resource_path("milling/linuxcnc.json").read_text())
    place = content
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    path = Path(tmp_path / "machine.json")
    path.write_text(json.dumps(content))
    with pytest.raises(InputError, match=sentence) as raised:
        read_machine(path)
    assert str(path) in str(raised.value)


def test_a_full_disk_leaves_the_earlier_program(tmp_path, monkeypatch):
    def full(*_arguments, **_options):
        raise OSError(errno.ENOSPC, "No space left on device")

    plan = planned("linuxcnc", "groove", both_sides=False)
    path = tmp_path / "piece.nc"
    path.write_text("(earlier)")
    block, places = Block("EVA", BLOCK_MM), ExportPaths(tmp_path / "piece.stl", programs=(path,))
    monkeypatch.setattr(Path, "write_text", full)
    with pytest.raises(OutputError, match="disk is full"):
        write_milling(plan, block, places, places, identification={"pseudonym": "A-1"})
    monkeypatch.undo()
    assert path.read_text() == "(earlier)"
    assert list(tmp_path.iterdir()) == [path]
