"""The set-up sheet of a router says what its programs do."""

from __future__ import annotations

import re
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from itertools import pairwise
from pathlib import Path

import manifold3d
import numpy as np
import pytest
from read_pdf import text_of_pdf

from insole_core.errors import OutputError
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.milling.machine import read_machine
from insole_core.milling.plan import FootInBlock, plan_milling
from insole_core.resources import resource_path
from insole_core.solids.export_job import ExportPaths
from insole_core.solids.shop import Block
from insole_core.solids.simplification import from_manifold
from insole_core.workflows.mill import (
    MillingChoice,
    program_paths,
    require_no_other_program,
    write_milling,
)

BLOCK = Block("EVA single", (120.0, 200.0, 24.0))
"""Its longer side is named last."""


def wedge() -> TriangleMesh:
    """A piece of 50 × 90 × 12 mm, that no turn maps onto itself, in the middle of the block."""
    corners = [(0, 0), (50, 0), (50, 70), (20, 90), (0, 60)]
    low = manifold3d.CrossSection([corners]).extrude(12.0)
    return from_manifold(low.translate([35.0, 55.0, 0.0]))


@dataclass(frozen=True)
class Written:
    """What the shop gets."""

    sheet: str
    names: tuple[str, ...]
    program: str
    pins: str


@pytest.fixture(scope="module", params=["grbl", "linuxcnc", "mach3"])
def written(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Written:
    folder: Path = tmp_path_factory.mktemp("setup")
    machine = read_machine(resource_path(f"milling/{request.param}.json"))
    length, width, height = BLOCK.sides_mm
    plan = plan_milling(
        [wedge()], (width, length, height), machine,
        both_sides=True, feet=[FootInBlock(Side.LEFT)],
    )  # fmt: skip
    programs = program_paths(folder / "P.nc", MillingChoice(machine, both_sides=True))
    places = ExportPaths(
        folder / "P.stl",
        programs=programs, setup_sheet=folder / "P.pdf", pin_holes=folder / "P-pins.nc",
    )  # fmt: skip
    write_milling(plan, BLOCK, places, places, identification={"pseudonym": "P-7"})
    return Written(
        " ".join(text_of_pdf(folder / "P.pdf").split()),
        tuple(path.name for path in programs),
        "".join(path.read_text() for path in programs),
        (folder / "P-pins.nc").read_text(),
    )


def places_of(program: str) -> np.ndarray:
    """All places x, y, z of a program that a move ends at."""
    at: dict[str, float] = {}
    found: list[list[float]] = []
    for line in program.splitlines():
        words = re.findall(r"([XYZ])(-?[\d.]+)", line) if line.startswith(("G0 ", "G1 ")) else []
        if words:
            at |= {letter: float(number) for letter, number in words}
            if len(at) == 3:
                found.append([at["X"], at["Y"], at["Z"]])
    return np.array(found)


def holes_of(program: str) -> list[list[float]]:
    """The middles of the two holes that a program bores first."""
    bored = program.split("(dowels", 1)[1].split("(roughing", 1)[0]
    at = places_of(bored)
    deep = at[at[:, 2] < at[:, 2].min() + 0.01]
    first = np.linalg.norm(deep[:, :2] - deep[0, :2], axis=1) < 20
    return [(np.ptp(part, axis=0) / 2 + part.min(axis=0))[:2].tolist()
            for part in (deep[first], deep[~first])]  # fmt: skip


def test_dowels_stand_on_the_sheet_where_both_programs_bore_them(written: Written) -> None:
    named = re.findall(r"X(-?[\d.]+) Y(-?[\d.]+)", written.sheet.split("Dowels, from")[1])[:2]
    expected = [[float(number) for number in place] for place in named]
    assert len(expected) == 2
    assert "), beside the dowels, and no higher than" in written.sheet
    assert expected[0] != expected[1]
    for program in (written.program, written.pins):
        assert holes_of(program) == pytest.approx(np.array(expected), abs=0.1)


def test_the_holes_of_the_board_begin_at_its_surface(written: Written) -> None:
    """Whether the zero of the block is on its upper side or below it."""
    heights = places_of(written.pins)[:, 2]
    assert heights.min() == -10
    assert heights.max() >= 5
    assert "set the zero as for the block, but z = 0 on the surface" in written.sheet


def test_the_program_of_the_board_speaks_of_no_block_that_lies_there(written: Written) -> None:
    comments = " ".join(re.findall(r"\(.*?\)", written.pins))
    assert "(dowels, spoil board," in comments
    assert "foot side" not in comments
    assert "Block " not in comments
    assert "File 1" not in comments


def test_without_tabs_none_are_cut(tmp_path: Path) -> None:
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    machine = replace(
        machine,
        contour=replace(machine.contour, tabs=0),
        finishing=replace(machine.finishing, step_over_mm=1.0),
    )
    box = from_manifold(manifold3d.Manifold.cube((20, 20, 5)).translate((10, 40, 0)))
    plan = plan_milling([box], (90.0, 100.0, 8.0), machine, feet=[FootInBlock(Side.LEFT)])
    places = ExportPaths(
        tmp_path / "P.stl", programs=(tmp_path / "P.nc",), setup_sheet=tmp_path / "P.pdf"
    )
    block = Block("EVA", (90.0, 100.0, 8.0))
    write_milling(plan, block, places, places, identification={"pseudonym": "P-7"})
    sheet = " ".join(text_of_pdf(tmp_path / "P.pdf").split())
    assert "Cut the tabs" not in sheet
    assert "the last cut has set them free" in sheet
    edges = re.search(r"on free edges alone \((.*?)\), and no higher than", sheet)
    assert edges is not None  # beside no dowels: there are none
    rooms = dict(re.findall(r"(left|right|front|back) (\d+) mm", edges[1]))
    assert "left" not in rooms  # 10 mm, of which the contour takes some
    assert int(rooms["right"]) in range(50, 60)
    assert rooms.keys() >= {"front", "back"}


@pytest.mark.parametrize(
    ("there", "earlier"),
    [
        ({"P.nc": "P-7"}, "P.nc"),
        ({"P-5.nc": "P-7", "P-6.nc": "P-7"}, "P-5.nc, P-6.nc"),
        ({"P-1.nc": "26-3", "P-5.nc": "26-3", "P-6.nc": "26-4"}, "P-5.nc"),
        ({"P-5.nc": "P-71", "P-6.nc": "P-7-2", "P.nc": "6"}, ""),
        ({"P-1.nc": "P-7", "P-2.nc": "P-7", "P-left.nc": "P-7", "P-pins.nc": "P-7"}, ""),
    ],
)
def test_files_of_an_earlier_program_of_the_same_order_are_refused(
    there: dict[str, str], earlier: str, tmp_path: Path
) -> None:
    """Those of another order are no business of this one, even if named alike."""
    how = MillingChoice(read_machine(resource_path("milling/grbl.json")))
    for name, job in there.items():
        text = f"({job})\n(File 1 of 7: P-7)\nG17 G21 G40 G49 G80 G90 G94 G54\n"
        (tmp_path / name).write_text(text)
    told: AbstractContextManager[object] = nullcontext()
    if earlier:
        told = pytest.raises(OutputError, match=rf"^Files of an earlier program \({earlier}\)")
    with told:
        require_no_other_program(tmp_path / "P.nc", how, "P-7")


def test_earlier_pin_holes_do_not_lie_beside_a_block_that_is_not_turned(tmp_path: Path) -> None:
    machine = read_machine(resource_path("milling/linuxcnc.json"))
    (tmp_path / "P-pin-holes.nc").write_text("(P-7)\n")
    with pytest.raises(OutputError, match=r"program \(P-pin-holes.nc\) would lie beside P.nc"):
        require_no_other_program(tmp_path / "P.nc", MillingChoice(machine), "P-7")
    require_no_other_program(tmp_path / "P.nc", MillingChoice(machine), "P-8")
    require_no_other_program(tmp_path / "P.nc", MillingChoice(machine, both_sides=True), "P-7")


def test_the_underside_of_an_earlier_program_does_not_lie_beside_a_single_file(
    tmp_path: Path,
) -> None:
    machine = read_machine(resource_path("milling/grbl.json"))
    cutter = machine.roughing.cutter
    how = MillingChoice(replace(
        machine,
        finishing=replace(machine.finishing, cutter=cutter),
        contour=replace(machine.contour, cutter=cutter),
    ))  # fmt: skip
    assert program_paths(tmp_path / "P.nc", how) == (tmp_path / "P-1.nc",)
    (tmp_path / "P-2.nc").write_text("(P-7)\n")
    with pytest.raises(OutputError, match=r"program \(P-2.nc\) would lie beside P-1.nc"):
        require_no_other_program(tmp_path / "P.nc", how, "P-7")


def test_a_file_without_moves_is_said_to_be_one(tmp_path: Path) -> None:
    machine = read_machine(resource_path("milling/grbl.json"))
    box = from_manifold(manifold3d.Manifold.cube((20, 20, 5)).translate((15, 15, 0)))
    plan = plan_milling([box], (50.0, 50.0, 8.0), machine, feet=[FootInBlock(Side.LEFT)])
    plan = replace(plan, operations=plan.operations[:-1])
    programs = program_paths(tmp_path / "P.nc", MillingChoice(machine))
    places = ExportPaths(tmp_path / "P.stl", programs=programs, setup_sheet=tmp_path / "P.pdf")
    block = Block("EVA", (50.0, 50.0, 8.0))
    write_milling(plan, block, places, places, identification={"pseudonym": "P-7"})
    sheet = " ".join(text_of_pdf(tmp_path / "P.pdf").split())
    assert "P-3.nc nothing has to be milled with this cutter: do not run it" in sheet
    assert "run P-2.nc" in sheet
    assert "run P-3.nc" not in sheet


def test_the_piece_lies_where_the_sheet_says(written: Written) -> None:
    """The walls are cut a cutter's radius beside it."""
    range_mm = r"(-?[\d.]+) \S+ (-?[\d.]+)"  # a dash is no letter of ASCII
    found = re.search(f"x {range_mm}, y {range_mm} mm from the zero", written.sheet)
    assert found is not None
    left, right, low, high = map(float, found.groups())
    assert sorted([right - left, high - low]) == [50, 90]
    walls = written.program.split("(contour, foot side")[1].split("\n(")[0]
    cut = places_of(walls)
    assert cut[:, 0].min() == pytest.approx(left - 3, abs=0.2)
    assert cut[:, 0].max() == pytest.approx(right + 3, abs=0.2)
    assert cut[:, 1].min() == pytest.approx(low - 3, abs=0.2)
    assert cut[:, 1].max() == pytest.approx(high + 3, abs=0.2)


def test_the_sheet_follows_the_stops_of_the_program(written: Written) -> None:
    titles = re.findall(r"^\((\w+), ([\w ]+), (\d mm [\w ]+)\)$", written.program, re.MULTILINE)
    stops = sum(
        (later[1] != earlier[1]) + (later[2] != earlier[2]) for earlier, later in pairwise(titles)
    )
    assert stops >= 3
    files = len(written.names)
    assert written.sheet.count("The cutter parks.") == (stops if files == 1 else 0)
    assert files in {1, stops + 1}
    runs = [written.sheet.index(f"and run {name}") for name in written.names]
    assert runs == sorted(runs)
    assert written.sheet.count("turn the block about") == 1
    assert "1 (6 mm flat end) flat, diameter 6 mm, flutes 22 mm" in written.sheet


def test_the_block_has_its_longer_side_first(written: Written) -> None:
    assert re.search(r"EVA single, 200 \S+ 120 \S+ 24 mm", written.sheet)
    assert "its length of 200 mm along" in written.sheet
