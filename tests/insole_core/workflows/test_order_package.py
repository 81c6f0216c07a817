"""Orders to a shop: written as a whole, opened again, and refused when something is wrong."""

from __future__ import annotations

import errno
import json
import re
import shutil
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import UTC, date, datetime, timedelta
from functools import reduce
from pathlib import Path
from typing import Any

import pytest
from read_pdf import text_of_pdf

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError, OutputError
from insole_core.export.order_verification import verify_order
from insole_core.export.shop_order import (
    MOST_PAIRS,
    OrderTerms,
    Release,
    ShopOrder,
    digest_of_order,
)
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.solids.export_rules import ExportRules
from insole_core.solids.order import Part
from insole_core.solids.shop import read_shop
from insole_core.workflows.make_order import OrderChoice, make_parts
from insole_core.workflows.nest_orders import pieces_of_order
from insole_core.workflows.order_package import PackedItem, write_package
from insole_studio.cli.main import run
from insole_studio.texts import translation_into

NOW = datetime(2026, 11, 20, 12, 0, tzinfo=UTC)
PATIENT = Patient("Ottilia Bergqvist", pseudonym="P-17")
TERMS = OrderTerms(2, "black", "Nora 2 mm", "soft heel", date(2026, 12, 1))
CHOICE = OrderChoice(both=True, pseudonym="P-17", material="EVA", terms=TERMS, most_triangles=None)
DAMAGE: dict[str, Callable[[dict[str, Any]], object]] = {
    "newer than this program": lambda order: order.update(version=9),
    "quantity": lambda order: order["items"][0].update(quantity=0),
    "deliver_on": lambda order: order["items"][0].update(deliver_on="2026-02-30"),
    "plain name of a file": lambda order: order["items"][0]["files"][0].update(name="../a.stl"),
    "does not order": lambda order: order["items"][0].update(
        sides=["left"], materials={"left": "EVA"}
    ),
    "must be one of|must be": lambda order: order["items"][0]["files"][0].update(role="virus"),
    "sha256": lambda order: order["items"][0]["files"][0].update(sha256="12"),
}


@pytest.fixture(scope="module")
def record(left_foot: Foot, right_foot: Foot) -> CaseRecord:
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    feet = tuple(
        FootRecord.begun(foot, source, InsoleDesign(foot.side, grid_mm=3.0))
        for foot in (left_foot, right_foot)
    )
    return CaseRecord(PATIENT, feet, Side.LEFT)


@pytest.fixture(scope="module")
def parts(record: CaseRecord) -> tuple[Part, ...]:
    return make_parts(record, CHOICE, ExportRules({}, {}))


@pytest.fixture(scope="module")
def written(parts: tuple[Part, ...], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("orders")
    code = folder / "roughing-left.nc"
    code.write_text("G21\nG90\nM2\n")
    item = PackedItem(parts, CHOICE, PATIENT, {code: (Side.LEFT,)})
    write_package([item], folder / "order.zip", number="26-7KQ4M", shop=read_shop(), now=NOW)
    return folder / "order.zip"


@pytest.fixture
def unpacked(written: Path, tmp_path: Path) -> Path:
    folder = tmp_path / "order"
    with zipfile.ZipFile(written) as archive:
        archive.extractall(folder)
    return folder


def test_the_drawing_shows_both_feet_with_the_order_and_the_dimensions_of_the_solid(
    unpacked: Path, parts: tuple[Part, ...]
) -> None:
    text = text_of_pdf(unpacked / "P-17-left-job-sheet.pdf")
    for shown in ("left, from above", "right, from below", "left, medial", "right, lateral"):
        assert shown in text
    for part in parts:
        width, length, height = part.solid.bounds_mm[1] - part.solid.bounds_mm[0]
        assert {f"{size:.1f}" for size in (width, length, height)} <= set(text.split())
    heel = f"y={parts[0].landmarks['heel_centre'].point[1]:.0f}"
    for shown in (heel, "Revision\n1\n", "Nora 2 mm", "2026-12-01", "soft heel", "P-17-left.stl"):
        assert shown in text
    digest = sha256_of(unpacked / "P-17-left.stl")
    assert digest[:16] in text.split()
    left, right = "26-7KQ4M-P-17-1-L", "26-7KQ4M-P-17-1-R"
    titles = re.findall(r"Serial number of the piece\n(.*?)\nColour\n", text, re.DOTALL)
    assert [title.split() for title in titles[:2]] == [[f"{left},", right], [left]]


def problems_of(path: Path) -> str:
    return "\n".join(verify_order(path).problems)


def written_again(parts: tuple[Part, ...], path: Path, **terms: Any) -> None:
    choice = replace(CHOICE, terms=replace(TERMS, **terms), job_sheet=False)
    item = PackedItem(parts, choice, PATIENT, {})
    write_package([item], path, number="1", shop=read_shop(), now=NOW)


def test_an_order_is_opened_again_as_it_was_written(written: Path, unpacked: Path) -> None:
    for place in (written, unpacked):
        verification = verify_order(place)
        assert verification.problems == ()
        (item,) = verification.order.items
        assert item.terms == TERMS
        assert item.materials == {Side.LEFT: "EVA", Side.RIGHT: "EVA"}
        assert {(file.name, file.role, file.sides) for file in item.files} == {
            ("P-17-left.stl", "solid", (Side.LEFT,)),
            ("P-17-right.stl", "solid", (Side.RIGHT,)),
            ("P-17-left-job-sheet.pdf", "job_sheet", (Side.LEFT,)),
            ("P-17-right-job-sheet.pdf", "job_sheet", (Side.RIGHT,)),
            ("roughing-left.nc", "gcode", (Side.LEFT,)),
        }
    assert b"Bergqvist" not in (unpacked / "order.json").read_bytes()
    assert [path.name for path in written.parent.iterdir() if path.name.startswith(".")] == []


def test_a_later_order_of_the_number_is_its_next_revision_in_the_language_asked_for(
    parts: tuple[Part, ...], unpacked: Path
) -> None:
    item = PackedItem(parts[:1], CHOICE, PATIENT, {})
    wanted: dict[str, Any] = {"number": "26-7KQ4M", "shop": read_shop(), "now": NOW}
    order = write_package(
        [item], unpacked, **wanted, released_by="Eva Ek", translate=translation_into("sv")
    )
    assert order == verify_order(unpacked).order
    assert (order.release.revision, order.release.by) == (2, "Eva Ek")
    text = text_of_pdf(unpacked / "P-17-left-job-sheet.pdf")
    for shown in ("Arbetsblad", "Revision\n2\n", "Eva Ek", "Tolerans", "Datum"):
        assert shown in text
    assert not {"Released", "Sheet", "Order", "left", "thick"} & set(text.split())
    assert "0,3 mm" in text  # the tolerance
    assert re.search(r"^\d+,\d$", text, re.MULTILINE)  # the dimensions of the drawing
    assert not re.search(r"^\d+\.\d$|\d\.\d mm", text, re.MULTILINE)
    with pytest.raises(InputError, match="holds the patient's name"):
        write_package([item], unpacked, **wanted, released_by="Ottilia Bergqvist")


def test_what_happened_to_the_files_is_told(unpacked: Path) -> None:
    (unpacked / "roughing-left.nc").write_text("G21 G0 Z-50\n")
    (unpacked / "P-17-right-job-sheet.pdf").unlink()
    (unpacked / "virus.exe").write_bytes(b"MZ")
    told = problems_of(unpacked).splitlines()
    assert len(told) == 3
    assert "P-17-right-job-sheet.pdf is missing" in told[0]
    assert "roughing-left.nc has been changed" in told[1]
    assert "virus.exe is not part of the order" in told[2]


def leaves(value: Any, *keys: Any) -> Iterator[tuple[Any, ...]]:
    """Yield the keys that lead to each value that is neither an object nor a list."""
    if isinstance(value, dict | list):
        inner = value.items() if isinstance(value, dict) else enumerate(value)
        for key, each in inner:
            yield from leaves(each, *keys, key)
    else:
        yield keys


def changed(value: Any) -> Any:
    """Return another value of the same kind that a shop could take for right."""
    if isinstance(value, str):
        others = {"left": "right", "right": "left", "insole": "block", "solid": "other",
                  "gcode": "other", "job_sheet": "other", "insole-order": None}  # fmt: skip
        is_date = re.match(r"\d{4}-\d\d-\d\d", value)
        is_digest = re.fullmatch("[0-9a-f]{64}", value)
        if is_date or is_digest:
            return value.replace("2026", "2027") if is_date else value[::-1]
        return others.get(value, f"{value}0")
    return None if value is None else value * 10 + 1


def test_whatever_is_changed_in_the_order_file_is_told(unpacked: Path) -> None:
    path = unpacked / "order.json"
    text = path.read_text()
    tried = list(leaves(json.loads(text)))
    assert len(tried) > 40
    for *keys, last in tried:
        order = json.loads(text)
        within = reduce(lambda place, key: place[key], keys, order)
        if (after := changed(within[last])) == within[last] or last in ("format", "version"):
            continue
        within[last] = after
        path.write_text(json.dumps(order))
        try:
            told = problems_of(unpacked)
        except InputError:  # refused, as it could not be right
            continue
        assert "order.json has been changed since the order was written" in told, (keys, last)


def sealed(path: Path, change: Callable[[dict[str, Any]], object]) -> None:
    """Change an order file as a program does that knows its digest."""
    order = json.loads(path.read_text())
    change(order)
    path.write_text(json.dumps(order | {"sha256": digest_of_order(order)}))


@pytest.mark.parametrize(
    ("told", "change"),
    [
        ('says "2" for quantity, and order.json says "20"',
         lambda order: order["items"][0].update(quantity=20)),
        ('says "EVA" for material, right, and order.json says "EVA 60"',
         lambda order: order["items"][0]["materials"].update(right="EVA 60")),
        ('says "1" for revision', lambda order: order.update(revision=2)),
        ('says "soft heel" for remarks', lambda order: order["items"][0].update(remarks="hard")),
        ("bytes, and order.json says 5",
         lambda order: order["items"][0]["files"][0].update(bytes=5)),
    ],
)  # fmt: skip
def test_the_order_file_is_compared_with_sheets_and_files(
    unpacked: Path, told: str, change: Callable[[dict[str, Any]], object]
) -> None:
    sealed(unpacked / "order.json", change)
    problems = problems_of(unpacked)
    assert told in problems
    assert "order.json has been changed" not in problems


def test_an_answer_says_what_was_compared(unpacked: Path, parts: tuple[Part, ...]) -> None:
    assert "5 files; all that order.json says" in verify_order(unpacked).compared()
    assert "terms on 2 job sheets" in verify_order(unpacked).compared()
    path = unpacked / "order.json"
    order = json.loads(path.read_text())
    del order["sha256"]
    path.write_text(json.dumps(order))
    assert "order.json has been changed" in problems_of(unpacked)  # its sheets are of this version
    before = unpacked.with_name("before")
    written_again(parts, before)
    order = json.loads((before / "order.json").read_text())
    del order["sha256"]
    (before / "order.json").write_text(json.dumps(order))
    verification = verify_order(before)
    assert verification.problems == ()
    assert "all that order.json says" not in verification.compared()
    assert "without a digest of its own" in verification.compared()


def test_exchanged_sides_are_told(unpacked: Path) -> None:
    left, right = unpacked / "P-17-left.stl", unpacked / "P-17-right.stl"
    left.rename(unpacked / "kept")
    right.rename(left)
    (unpacked / "kept").rename(right)
    told = problems_of(unpacked)
    assert "P-17-left.stl is for the left foot, but holds what P-17-right.stl was" in told
    assert "P-17-right.stl is for the right foot, but holds what P-17-left.stl was" in told


def test_a_file_listed_for_the_foot_it_is_not_named_after_is_told(unpacked: Path) -> None:
    path = unpacked / "order.json"
    order = json.loads(path.read_text())
    solid = next(f for f in order["items"][0]["files"] if f["name"] == "P-17-left.stl")
    solid["sides"] = ["right"]
    path.write_text(json.dumps(order))
    told = problems_of(unpacked)
    assert "P-17-left.stl is named after the left foot" in told
    order["items"][0]["files"] = [f for f in order["items"][0]["files"] if f["role"] != "gcode"]
    path.write_text(json.dumps(order))
    assert "P-17 orders the left foot, and no file is there to make it from" in problems_of(
        unpacked
    )


@pytest.mark.parametrize("told", list(DAMAGE))
def test_a_wrong_order_file_is_refused(unpacked: Path, told: str) -> None:
    path = unpacked / "order.json"
    order = json.loads(path.read_text())
    DAMAGE[told](order)
    path.write_text(json.dumps(order))
    with pytest.raises(InputError, match=told):
        verify_order(unpacked)


def test_damaged_and_dangerous_archives_are_refused(written: Path, tmp_path: Path) -> None:
    cut = tmp_path / "cut.zip"
    cut.write_bytes(written.read_bytes()[:-3000])
    with pytest.raises(InputError, match="not a readable zip archive"):
        verify_order(cut)
    bent = bytearray(written.read_bytes())
    bent[len(bent) // 2] ^= 0xFF
    cut.write_bytes(bent)
    assert "is damaged" in problems_of(cut)
    escaping = tmp_path / "escaping.zip"
    shutil.copy(written, escaping)
    with zipfile.ZipFile(escaping, "a") as archive:
        archive.writestr("../../.bashrc", "rm")
    assert "../../.bashrc leads out of the folder of the order" in problems_of(escaping)
    assert [path.name for path in tmp_path.iterdir()] == ["cut.zip", "escaping.zip"]
    with pytest.raises(InputError, match=r"holds no order\.json"):
        verify_order(tmp_path)


def test_an_archive_that_would_fill_the_disk_is_refused(
    written: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("insole_core.export.order_verification.MOST_BYTES_OF_AN_ORDER", 10_000)
    with pytest.raises(InputError, match="far more than an order has"):
        verify_order(written)


@pytest.mark.parametrize(
    ("told", "terms"),
    [
        ("quantity is 0", {"quantity": 0}),
        ("quantity is 1001", {"quantity": MOST_PAIRS + 1}),
        ("2026-11-19 is past", {"deliver_on": NOW.date() - timedelta(1)}),
        ("more than two years ahead", {"deliver_on": date(2062, 12, 1)}),
        ("colour of the order has 201", {"colour": "b" * 201}),
        ("holds the patient's name", {"remarks": "as Bergqvist likes it"}),
    ],
)
def test_wrong_terms_leave_nothing_behind(
    parts: tuple[Part, ...], tmp_path: Path, told: str, terms: dict[str, Any]
) -> None:
    for name in ("order", "order.zip"):
        with pytest.raises(InputError, match=told):
            written_again(parts, tmp_path / name, **terms)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("told", "number", "by"),
    [
        ("has no number", " ", ""),
        ("number", "7" * 61, ""),
        ("released by", "7", "Eva\nEk"),
    ],
)
def test_a_number_or_name_that_no_paper_can_show_is_refused(
    tmp_path: Path, told: str, number: str, by: str
) -> None:
    with pytest.raises(InputError, match=told):
        write_package([], tmp_path / "o", number=number, shop=read_shop(), now=NOW, released_by=by)
    assert list(tmp_path.iterdir()) == []


def test_a_full_disk_leaves_nothing_behind(
    parts: tuple[Part, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fill(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("insole_core.workflows.order_package.shutil.copyfileobj", fill)
    with pytest.raises(OutputError, match="the disk is full"):
        written_again(parts, tmp_path / "order.zip")
    assert list(tmp_path.iterdir()) == []


def test_serial_numbers_are_those_of_the_order(parts: tuple[Part, ...], tmp_path: Path) -> None:
    choice = replace(
        CHOICE, job_sheet=True, relief="engraved", numbered=True,
        terms=replace(CHOICE.terms, lot="L-42"),
    )  # fmt: skip

    def written(revision: int) -> ShopOrder:
        made = replace(choice, release=Release("A7", revision))
        return write_package(
            [PackedItem(parts, made, PATIENT, {})], tmp_path / "o",
            number="A7", revision=revision, shop=read_shop(), now=NOW,
        )  # fmt: skip

    (item,) = written(1).items
    assert item.serials == {part.side: f"A7-P-17-1-{str(part.side)[0].upper()}" for part in parts}
    verified = verify_order(tmp_path / "o")
    assert verified.problems == ()
    assert verified.order.items[0].serials == item.serials
    assert verified.order.items[0].terms.lot == "L-42"
    with pytest.raises(
        InputError, match="carry the serial number A7-P-17-1-L, and it is A7-P-17-2-L"
    ):
        written(1)
    (item,) = written(2).items
    assert all("-2-" in serial for serial in item.serials.values())


def test_two_patients_of_one_name_are_refused(parts: tuple[Part, ...], tmp_path: Path) -> None:
    item = PackedItem(parts, replace(CHOICE, job_sheet=False), PATIENT, {})
    with pytest.raises(InputError, match="Two patients of the order are called P-17"):
        write_package([item, item], tmp_path / "o", number="1", shop=read_shop(), now=NOW)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--out", "n.txt", "--size", "500x300x40"], "names no format that the nest is written"),
        (["--out", "n.3mf", "--block", "cork"], '--block is "cork", and the shop has'),
        (["--out", "n.stl", "--size", "500x300x40", "--both-sides"], "name it with --machine"),
    ],
)
def test_a_nest_that_cannot_be_says_so_before_an_order_is_read(
    options: list[str], sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["order", "nest", "nothing.zip", *options]) != 0
    assert sentence in capsys.readouterr().err.splitlines()[-1]


def test_a_size_is_three_lengths(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        run(["order", "nest", "nothing.zip", "--out", "n.3mf", "--size", "500x300"])
    assert "is no size; write length, width and height in mm" in capsys.readouterr().err


def test_the_command_writes_and_verifies(
    record: CaseRecord, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    case, out = tmp_path / "case.insole", tmp_path / "out"
    write_case(record, case)
    wanted = ["order", "create", str(case), "--out", str(out), "--quantity", "3"]
    assert run([*wanted, "--side", "left", "--number", "A7"]) == 0
    assert run(["order", "verify", str(out)]) == 0
    told = capsys.readouterr()
    assert "Order A7" in told.out
    assert ": 1 patient, 3 pieces or pairs, " in told.out
    assert "all that order.json says" in told.out.splitlines()[-1]
    nested = ["order", "nest", str(out), "--out", str(tmp_path / "n.3mf"), "--size", "500x300x40"]
    assert run(nested) == 0
    assert "3 pieces on sheet, 500 × 300 × 40 mm" in capsys.readouterr().err.splitlines()[-1]
    assert {path.name for path in tmp_path.glob("n*")} == {"n.3mf", "n.dxf", "n-pieces.pdf"}
    assert run([*nested[:-1], "500x90x40"]) == 1
    assert "0 of 3 pieces find room" in capsys.readouterr().err.splitlines()[-1]
    (out / "P-17-left.stl").write_bytes(b"")
    assert run(["order", "verify", str(out)]) == 1
    told = capsys.readouterr()
    assert "P-17-left.stl has been changed" in told.out
    assert "1 problem, listed" in told.err.splitlines()[-1]
    for name in ("out.zip", "out"):
        assert run(["order", "verify", str(tmp_path / "nothing" / name)]) == 1
        assert "check the name" in capsys.readouterr().err


@pytest.fixture(scope="module")
def unknown(record: CaseRecord, tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Two cases of patients without pseudonym."""
    folder = tmp_path_factory.mktemp("unknown")
    paths = [folder / "a.insole", folder / "b.insole"]
    left = replace(record, feet=record.feet[:1])
    for path in paths:
        write_case(replace(left, patient=Patient("Astrid Malmsten")), path)
    return paths


def test_revisions_of_an_order_call_their_pieces_the_same_and_are_not_nested_together(
    unknown: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, earlier = tmp_path / "o.zip", tmp_path / "x"
    create = ["order", "create", str(unknown[0]), "--out", str(out), "--number", "26-7KQ4M"]
    assert run([*create, "--quantity", "2"]) == 0
    first = verify_order(out).order
    with zipfile.ZipFile(out) as archive:
        archive.extractall(earlier)
    assert run(create) == 0
    last = verify_order(out).order
    assert (first.release.revision, last.release.revision) == (1, 2)
    assert [file.name for file in last.files] == [file.name for file in first.files]
    (item,) = last.items
    assert item.pseudonym == "26-7KQ4M", "one identification leaves the clinic"
    assert item.serials == {Side.LEFT: "26-7KQ4M-2-L"}
    before = out.read_bytes()
    for other in ([*create[:-1], "26-OTHER"], create[:-2]):  # the second with a number drawn for it
        assert run(other) == 2
        told = capsys.readouterr().err.splitlines()[-1]
        assert f"{out} holds order 26-7KQ4M, and this one is 26-" in told
        assert "name another --out" in told
        assert out.read_bytes() == before
    nest = ["order", "nest", str(earlier), str(out), "--out", str(tmp_path / "n.3mf")]
    assert run([*nest, "--size", "1000x600x40"]) != 0
    told = capsys.readouterr().err.splitlines()[-1]
    assert "Order 26-7KQ4M is among them twice; name its last revision alone." in told
    assert not (tmp_path / "n.3mf").exists()


def test_several_patients_without_pseudonym_are_told_apart_by_their_places(
    unknown: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "o.zip"
    create = ["order", "create", *map(str, unknown), "--out", str(out), "--number", "26-8"]
    for _revision in range(2):
        assert run(create) == 0
        order = verify_order(out).order
        assert [item.pseudonym for item in order.items] == ["26-8-1", "26-8-2"]
        told = capsys.readouterr().err
        assert "a.insole is 26-8-1 in the order.\n" in told
        assert "b.insole is 26-8-2 in the order.\n" in told
    assert [piece.name for piece in pieces_of_order(out)] == ["26-8-1 left", "26-8-2 left"]


def test_a_case_that_is_named_twice_is_refused(
    unknown: list[Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(unknown[0].parent)
    again = ["a.insole", str(unknown[0])]
    assert run(["order", "create", *again, "--out", str(tmp_path / "o.zip")]) != 0
    told = capsys.readouterr().err.splitlines()[-1]
    assert f"{unknown[0]} is named twice; order more of a case with --quantity." in told
    assert not (tmp_path / "o.zip").exists()


@pytest.mark.parametrize("name", ["o8.txt", "o.ZIPX", "case.insole", "o.7z", "o.stl"])
def test_an_order_is_no_file_of_another_ending(
    name: str, unknown: list[Path], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / name
    assert run(["order", "create", str(unknown[0]), "--out", str(out)]) != 0
    assert "an order is a folder or a .zip file; name one of them" in capsys.readouterr().err
    assert not out.exists()


@pytest.mark.parametrize("name", ["26.11", "week.4", "o.ZIP", "Dr. Berg"])
def test_an_order_is_an_archive_or_any_folder(
    name: str, unknown: list[Path], tmp_path: Path
) -> None:
    assert run(["order", "create", str(unknown[0]), "--out", str(tmp_path / name)]) == 0
    assert (tmp_path / name).is_file() == (name == "o.ZIP")
