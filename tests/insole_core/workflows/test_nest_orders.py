"""Orders of several patients on one block: apart, marked by order and side, nobody named."""

from __future__ import annotations

import shutil
from dataclasses import replace
from datetime import UTC, datetime
from itertools import combinations
from pathlib import Path

import ezdxf
import manifold3d
import numpy as np
import pytest
from read_pdf import bytes_of_pdf, text_of_pdf

from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import DesignError, InputError, OutputError
from insole_core.export.order_verification import verify_order
from insole_core.export.paper import paragraph, write_pages
from insole_core.export.sheet_terms import as_keyword, sheet_terms
from insole_core.export.shop_order import (
    ORDER_FILE,
    OrderedFile,
    OrderItem,
    OrderTerms,
    Release,
    ShopOrder,
    write_shop_order,
)
from insole_core.foot.foot import Foot
from insole_core.formats.slicer_3mf import (
    PRINTERS,
    Infill,
    Modifier,
    PrintedPart,
    Printer,
    write_slicer_3mf,
)
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.milling.machine import read_machine
from insole_core.resources import resource_path
from insole_core.scans.mesh_file import read_mesh
from insole_core.solids.export_rules import ExportRules
from insole_core.solids.shop import Block, read_shop
from insole_core.solids.silhouette import silhouette
from insole_core.solids.simplification import from_manifold
from insole_core.workflows.make_order import OrderChoice, make_parts
from insole_core.workflows.mill import MillingChoice
from insole_core.workflows.nest_orders import (
    GAP_MM,
    DayNest,
    OrderedPiece,
    gathered,
    has_pieces,
    nest_pieces,
    pieces_of_files,
    pieces_of_order,
    write_nest,
)
from insole_core.workflows.order_package import PackedItem, write_package
from insole_studio.texts import translation_into

NAMES = ("Ottilia Bergqvist", "Kurt Sandelin")
SHEET = Block("sheet", (600.0, 700.0, 40.0))


@pytest.fixture(scope="module")
def orders(
    left_foot: Foot, right_foot: Foot, tmp_path_factory: pytest.TempPathFactory
) -> list[Path]:
    """An archive and a folder of two patients; the second one's pair is ordered twice."""
    folder = tmp_path_factory.mktemp("orders")
    nowhere = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    feet = tuple(
        FootRecord.begun(foot, nowhere, InsoleDesign(foot.side, grid_mm=2.0))
        for foot in (left_foot, right_foot)
    )
    written = []
    for number, (name, place) in enumerate(zip(NAMES, ("a.zip", "b"), strict=True), 1):
        record = CaseRecord(Patient(name), feet, Side.LEFT)
        choice = OrderChoice(
            both=True, pseudonym=f"P-{number}", material="EVA", job_sheet=False,
            most_triangles=6_000, most_deviation_mm=0.5, terms=OrderTerms(quantity=number),
        )  # fmt: skip
        parts = make_parts(record, choice, ExportRules({}, {}))
        write_package(
            [PackedItem(parts, choice, record.patient, {})], folder / place,
            number=f"26-{number}", shop=read_shop(), now=datetime(2026, 11, 20, tzinfo=UTC),
        )  # fmt: skip
        written.append(folder / place)
    return written


def box(width_mm: float = 80.0, length_mm: float = 240.0) -> TriangleMesh:
    return from_manifold(manifold3d.Manifold.cube([width_mm, length_mm, 12.0]))


def nested(orders: list[Path], **how: object) -> DayNest:
    pieces = [piece for order in orders for piece in pieces_of_order(order)]
    return nest_pieces(pieces, SHEET, **how)  # type: ignore[arg-type]


def area_of(solid: TriangleMesh, grown_mm: float = 0.0) -> manifold3d.CrossSection:
    polygons = [polygon.tolist() for polygon in silhouette(solid)]
    return manifold3d.CrossSection(polygons).offset(grown_mm, manifold3d.JoinType.Round)


@pytest.fixture(scope="module")
def nest(orders: list[Path]) -> DayNest:
    return nested(orders, marked=True)


def test_all_pieces_lie_apart_within_the_sheet(nest: DayNest) -> None:
    assert sorted(each.piece.name for each in nest.pieces) == [
        "26-1 P-1 left", "26-1 P-1 right", *2 * ["26-2 P-2 left"], *2 * ["26-2 P-2 right"],
    ]  # fmt: skip
    grown = [area_of(each.solid, GAP_MM / 2 - 0.01) for each in nest.pieces]
    assert max((one ^ other).area() for one, other in combinations(grown, 2)) < 1e-6
    corners = np.concatenate([each.solid.bounds_mm for each in nest.pieces])
    assert corners.min() >= -1e-6
    assert (corners.max(axis=0) <= nest.block_mm).all()


@pytest.mark.parametrize(
    ("size_mm", "beside_mm"),
    [((90.0, 100.0), (12.0, 12.0)), ((48.0, 60.0), (4.0, 10.0)), ((60.0, 200.0), (10.0, 12.0))],
)
def test_what_has_room_lies_off_the_sides_so_that_tabs_hold_it(
    size_mm: tuple[float, float], beside_mm: tuple[float, float]
) -> None:
    solid = from_manifold(
        manifold3d.CrossSection([[(0, 0), (40, 0), (40, 40), (0, 40)]]).extrude(9)
    )
    piece = OrderedPiece("26-1", Side.LEFT, solid)
    width, length = size_mm
    (lying,) = nest_pieces([piece], Block("board", (length, width, 20.0))).pieces
    low, high = lying.solid.bounds_mm[:, :2]
    assert low == pytest.approx(beside_mm)
    assert (np.array(size_mm) - high >= low - 1e-6).all()


def test_left_stays_left(nest: DayNest) -> None:
    """Each is turned about z alone, its great toe on the side where its foot has it."""
    for each in nest.pieces:
        assert np.linalg.det(each.piece2block[:3, :3]) == pytest.approx(1)
        assert each.piece2block[2] == pytest.approx([0, 0, 1, 0])
        vertices = each.piece.solid.vertices
        tip = vertices[vertices[:, 1].argmax(), 0] - each.piece.solid.bounds_mm[:, 0].mean()
        assert np.sign(tip) == each.piece.side.medial_sign
    assert nest.notes == (), "all carry their mark"
    pieces = {id(each.piece) for each in nest.pieces}
    assert len(pieces) == 4, "what is ordered twice is marked once"


def test_nobody_is_named_and_every_outline_is_marked(nest: DayNest, tmp_path: Path) -> None:
    written = write_nest(nest, tmp_path / "friday.stl", title="friday").paths
    assert [path.name for path in written] == ["friday.stl", "friday.dxf", "friday-pieces.pdf"]
    for path in written:
        content = bytes_of_pdf(path) if path.suffix == ".pdf" else path.read_bytes()
        assert not any(word.encode() in content for name in NAMES for word in name.split())
    drawing = ezdxf.readfile(tmp_path / "friday.dxf").modelspace()
    marks = sorted(text.dxf.text for text in drawing.query("TEXT"))
    assert marks == sorted(each.piece.name for each in nest.pieces)
    assert len(drawing.query('LWPOLYLINE[layer=="INSOLE"]')) == len(nest.pieces)
    assert len(drawing.query('LWPOLYLINE[layer=="BLOCK"]')) == 1
    sheet = " ".join(text_of_pdf(tmp_path / "friday-pieces.pdf").split())
    assert all(f"{number}: 26-" in sheet for number in range(1, len(nest.pieces) + 1))
    solid = read_mesh(tmp_path / "friday.stl").mesh
    whole = np.concatenate([each.solid.bounds_mm for each in nest.pieces])
    assert solid.bounds_mm[1] == pytest.approx(whole.max(axis=0), abs=0.01)


def test_what_finds_no_room_or_is_too_high_is_told(orders: list[Path]) -> None:
    pieces = list(pieces_of_order(orders[0]))
    with pytest.raises(DesignError, match="1 of 2 pieces find room on small, 300 × 120 × 40 mm"):
        nest_pieces(pieces, Block("small", (120.0, 300.0, 40.0)))
    with pytest.raises(DesignError, match="mm high, and the block has 3 mm"):
        nest_pieces(pieces, Block("thin", (600.0, 600.0, 3.0)))


def test_files_of_an_order_are_taken_by_their_side(orders: list[Path], tmp_path: Path) -> None:
    (solid,) = orders[1].glob("*-left.stl")
    (piece,) = pieces_of_files([solid, tmp_path / "o-left-job-sheet.pdf"], "26-9")
    assert piece.name == "26-9 left"
    pair = tmp_path / "o-pair.stl"
    pair.write_bytes(solid.read_bytes())
    with pytest.raises(InputError, match=r"o-pair\.stl holds both sides"):
        list(pieces_of_files([pair], "26-9"))
    with pytest.raises(InputError, match="without solids"):
        list(pieces_of_files([], "26-9"))


@pytest.mark.parametrize("printer", PRINTERS)
def test_zones_for_a_slicer_are_taken_for_no_piece(printer: Printer, tmp_path: Path) -> None:
    zone = Modifier(box(), "heel 15 %", Infill(15.0))
    part = PrintedPart(box(), "left insole", 3, 4, 4, Infill(30.0), (zone,))
    path = tmp_path / "o-left.3mf"
    write_slicer_3mf([part], path, printer)
    with pytest.raises(InputError, match="settings and zones for a slicer"):
        list(pieces_of_files([path], "26-9"))


def order_of_right_piece(name: str, tmp_path: Path) -> None:
    write_solids([SolidPart(box(), "insole")], tmp_path / name)
    digest, size = sha256_of(tmp_path / name), (tmp_path / name).stat().st_size
    file = OrderedFile(name, "solid", (Side.RIGHT,), digest, size)
    item = OrderItem("left heel", "insole", {Side.RIGHT: "EVA"}, OrderTerms(), (file,))
    order = ShopOrder(Release("26-5"), "2026-11-20T12:00:00+00:00", "Insole Studio", (item,))
    write_shop_order(order, tmp_path / ORDER_FILE)


@pytest.mark.parametrize("name", ["left heel-right.stl", "heel.stl"])
def test_the_side_is_the_one_that_the_order_says(name: str, tmp_path: Path) -> None:
    """The pseudonym of the patient is part of the name, and may hold the word of the other side."""
    order_of_right_piece(name, tmp_path)
    (piece,) = pieces_of_order(tmp_path)
    assert (piece.name, piece.material) == ("26-5 left heel right", "EVA")


def test_a_file_named_after_the_other_foot_is_refused(tmp_path: Path) -> None:
    order_of_right_piece("left.stl", tmp_path)
    with pytest.raises(InputError, match=r"named after the left foot, and order\.json has it for"):
        list(pieces_of_order(tmp_path))


def test_single_files_lie_on_the_block_as_often_as_their_sheet_says(tmp_path: Path) -> None:
    for name in ("o-left.stl", "o-right.stl"):
        write_solids([SolidPart(box(), "insole")], tmp_path / name)
    terms = sheet_terms(Release("26-9"), "P", {Side.LEFT: "EVA"}, OrderTerms(quantity=3))
    write_pages(
        [paragraph("Job sheet")], tmp_path / "o-left-job-sheet.pdf", "P", keyword=as_keyword(terms)
    )
    left, right = pieces_of_files(sorted(tmp_path.iterdir()), "26-9")
    assert (left.quantity, left.material) == (3, "EVA")
    nest = nest_pieces([left, right], SHEET)
    assert [each.piece.side for each in nest.pieces].count(Side.LEFT) == 3
    (note,) = nest.notes
    assert note.startswith("26-9 right was written without its quantity, and lies here once")


@pytest.mark.parametrize(
    ("how", "sentence"),
    [
        ({"gap_mm": 1e6}, "must be 0 to 100 mm"),
        ({"margin_mm": -20.0}, "must be 0 to 100 mm"),
        ({"gap_mm": float("nan")}, "must be 0 to 100 mm"),
        ({"block": Block("sheet", (9_999_999.0, 600.0, 30.0))}, "longer than the 3000 mm"),
    ],
)
def test_sizes_beyond_reason_are_refused(how: dict[str, object], sentence: str) -> None:
    given = {"block": SHEET} | how
    with pytest.raises(InputError, match=sentence):
        nest_pieces([OrderedPiece("26-1", Side.LEFT, box())], **given)  # type: ignore[arg-type]


def test_a_piece_that_is_not_closed_is_named() -> None:
    whole = box()
    torn = OrderedPiece("26-1", Side.LEFT, TriangleMesh(whole.vertices, whole.triangles[1:]))
    with pytest.raises(DesignError, match="26-1 left is no closed solid"):
        nest_pieces([OrderedPiece("26-2", Side.LEFT, whole), torn], SHEET)


def test_a_mark_is_never_written_over_another_one() -> None:
    """The second stands under the ball, and a third one finds no place."""
    piece, letters = OrderedPiece("26-1", Side.LEFT, box()), []
    for _ in range(2):
        nest = nest_pieces([piece], SHEET, marked=True)
        assert nest.notes == ()
        (piece,) = (each.piece for each in nest.pieces)
        vertices = piece.solid.vertices
        letters.append(vertices[(vertices[:, 2] > 0.5) & (vertices[:, 2] < 0.7), 1])
    heel = letters[0].max()
    assert heel < 0.61 * 240
    assert letters[1].max() > heel + 10
    assert np.sort(letters[1][letters[1] <= heel]) == pytest.approx(np.sort(letters[0]))
    (note,) = nest_pieces([piece], SHEET, marked=True).notes
    assert note.startswith("26-1 left carries no mark: The underside has other lettering")


def test_materials_are_told_in_the_language_of_the_papers() -> None:
    pieces = [
        OrderedPiece("26-1", Side.LEFT, box(), "Cork and EVA"),
        OrderedPiece("26-2", Side.LEFT, box(), "polypropylene"),
    ]
    (note,) = nest_pieces(pieces, SHEET).notes
    assert "Kork och EVA, polypropen" in translation_into("sv")(note)


def test_the_outline_of_a_piece_is_found_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked_at: list[TriangleMesh] = []

    def counted(solid: TriangleMesh) -> tuple[np.ndarray, ...]:
        looked_at.append(solid)
        return silhouette(solid)

    monkeypatch.setattr("insole_core.workflows.nest_orders.silhouette", counted)
    nest = nest_pieces([OrderedPiece("26-1", Side.LEFT, box(80, 200), quantity=4)], SHEET)
    write_nest(nest, tmp_path / "n.stl", title="n")
    assert len(looked_at) == 1
    drawn = ezdxf.readfile(tmp_path / "n.dxf").modelspace().query("LWPOLYLINE[layer=='INSOLE']")
    ends = [np.array([point[:2] for point in line]) for line in drawn]
    assert sorted(tuple(end.min(axis=0).round(3)) for end in ends) == sorted(
        tuple(each.solid.bounds_mm[0][:2].round(3)) for each in nest.pieces
    )


def test_an_order_without_solids_is_left_out_and_told(tmp_path: Path) -> None:
    sheet, solid = tmp_path / "O-left-job-sheet.pdf", tmp_path / "O-left.stl"
    assert not has_pieces([])
    assert not has_pieces([sheet])
    assert has_pieces([sheet, solid])
    assert has_pieces([tmp_path / "O.zip"])
    piece = OrderedPiece("26-1", Side.LEFT, box())
    (note,) = nest_pieces([piece], SHEET, missing=["26-2"]).notes
    assert "Order 26-2 has no solids and does not lie here" in note
    with pytest.raises(InputError) as raised:
        nest_pieces([], SHEET, missing=["26-2", "26-3"])
    assert str(raised.value) == (
        "Order 26-2 was written without solids; export it again. "
        "Order 26-3 was written without solids; export it again."
    )


def test_an_order_that_comes_again_is_refused(orders: list[Path]) -> None:
    read = [list(pieces_of_order(path)) for path in orders]
    assert gathered(read) == [*read[0], *read[1]]
    with pytest.raises(InputError, match="Order 26-1 is among them twice"):
        gathered([*read, read[0]])


def test_a_file_that_was_changed_is_refused(orders: list[Path], tmp_path: Path) -> None:
    folder = tmp_path / "changed"
    folder.mkdir()
    for path in orders[1].iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    (solid,) = folder.glob("*-left.stl")
    content = bytearray(solid.read_bytes())
    content[-10] ^= 1
    solid.write_bytes(content)
    with pytest.raises(InputError, match="has been changed since the order was written"):
        list(pieces_of_order(folder))


def test_an_order_is_refused_in_the_sentences_of_its_verification(
    orders: list[Path], tmp_path: Path
) -> None:
    folder = tmp_path / "changed"
    shutil.copytree(orders[1], folder)
    text = (folder / ORDER_FILE).read_text()
    (folder / ORDER_FILE).write_text(text.replace('"quantity": 2', '"quantity": 20'))
    (problem,) = verify_order(folder).problems
    assert "quantities, materials, texts or names in it may be wrong" in problem
    with pytest.raises(InputError) as raised:
        list(pieces_of_order(folder))
    assert str(raised.value) == f"{folder} is not as it was written: {problem}"
    for number in range(6):
        (folder / f"{number}.txt").write_text("")
    with pytest.raises(InputError, match=r"3\.txt is not .* And 2 more; verify the order\."):
        list(pieces_of_order(folder))


def test_a_router_gets_the_same_programs_for_all_pieces(tmp_path: Path) -> None:
    corners = [(0, 0), (40, 0), (40, 50), (20, 70), (0, 60)]
    solid = from_manifold(manifold3d.CrossSection([corners]).extrude(9.0))
    pieces = [OrderedPiece(f"26-{n}", side, solid) for n in (1, 2) for side in Side]
    machine = read_machine(resource_path("milling/grbl.json"))
    machine = replace(machine, contour=replace(machine.contour, tab_height_mm=20.0))
    nest = nest_pieces(pieces, Block("board", (220.0, 160.0, 8.97)), across=False)
    written = write_nest(nest, tmp_path / "n.stl", title="n", milling=MillingChoice(machine))
    (note,) = written.notes
    assert "tabs stay thinner than the 20 mm" in note
    for paper in ("n-setup-sheet.pdf", "n-pieces.pdf"):
        assert note in " ".join(text_of_pdf(tmp_path / paper).split())
    programs = sorted(tmp_path.glob("*.nc"))
    assert [path.name for path in programs] == ["n-1.nc", "n-2.nc", "n-3.nc"]
    assert all(path.read_text().startswith("(n)") for path in programs)
    earlier = tmp_path / "n-4.nc"
    earlier.write_text("(n)\n")
    with pytest.raises(OutputError, match=r"program \(n-4.nc\) would lie beside n-1.nc"):
        write_nest(nest, tmp_path / "n.stl", title="n", milling=MillingChoice(machine))
    earlier.unlink()
    files = r"n-1\.nc, n-2\.nc, n-3\.nc, n-setup-sheet\.pdf"
    before = written.paths[0].read_bytes()
    with pytest.raises(OutputError, match=rf"program \({files}\) would lie beside n\.stl, which"):
        write_nest(nest, tmp_path / "n.stl", title="n")
    assert written.paths[0].read_bytes() == before
    sheet = text_of_pdf(tmp_path / "n-setup-sheet.pdf")
    assert all(f"{number}: 26-" in sheet for number in (1, 2, 3, 4))
