"""Every declared format is complete, alone with its ending, and known wherever an order goes."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import get_args

import pytest
from tetrahedron import CORNERS, FACES, TETRA

from insole_core.export.shop_order import FILE_ROLES
from insole_core.formats.file_formats import (
    CHECKS,
    JOB_SHEET,
    MESH_FORMATS,
    PROGRAM,
    SCAN_SUFFIXES,
    SOLID_FORMATS,
    Carried,
    FileFormat,
    MeshFormat,
    can_carry,
    carriers,
    format_of,
    role_of,
)
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import file_content
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.records.order import Order, OrderFile, OrderState
from insole_core.records.person import Person
from insole_core.workflows.records.person_dossier import PersonDossier, pseudonymous

ALL = (*MESH_FORMATS, PROGRAM, JOB_SHEET, CHECKS)
ENDINGS = [(form, ending) for form in ALL for ending in form.endings]


def by_name(value: object) -> str:
    return value.name if isinstance(value, FileFormat) else str(value)


@pytest.mark.parametrize("form", MESH_FORMATS, ids=by_name)
def test_what_reads_and_writes_a_format_is_there(form: MeshFormat) -> None:
    named = [name for name in (form.reader, form.writer, form.text_writer) if name]
    assert form.reader or form.writer
    for name in named:
        module, function = name.split(".")
        assert callable(getattr(import_module(f"insole_core.formats.{module}"), function))
    assert form.carries <= set(get_args(Carried))
    assert not form.carries or form.writer
    assert (form.role == "solid") == form.names_nobody == bool(form.writer)


@pytest.mark.parametrize(("form", "ending"), ENDINGS, ids=by_name)
def test_an_ending_tells_one_format_and_its_role_in_an_order(form: FileFormat, ending: str) -> None:
    assert sum(ending in other.endings for other in ALL) == 1
    assert ending == ending.lower()
    assert format_of(f"P-17-left{ending.upper()}") is form
    assert role_of(f"P-17-left{ending}") == form.role in FILE_ROLES


def test_a_file_that_nobody_declares_has_no_role() -> None:
    assert format_of("letter.docx") is None
    assert role_of("letter.docx") == "other"
    assert not can_carry(".docx", "bodies")


def test_the_scan_that_says_most_is_read_of_several() -> None:
    ranks = [form.rank for form in MESH_FORMATS if form.reader]
    assert len(set(ranks)) == len(ranks)


@pytest.mark.parametrize("form", SOLID_FORMATS, ids=by_name)
def test_a_solid_is_read_back_as_it_was_written(form: MeshFormat, tmp_path: Path) -> None:
    path = tmp_path / f"insole{form.ending}"
    write_solids([SolidPart(TETRA, "left")], path)
    raw = read_raw(file_content(path))
    assert raw.vertices[raw.triangles] == pytest.approx(CORNERS[FACES])
    assert raw.unit in ("mm", None)
    assert (raw.unit == "mm") >= ("unit" in form.carries)


def test_bodies_stay_apart_where_a_format_carries_them() -> None:
    assert {form.ending for form in carriers("bodies")} <= {form.ending for form in SOLID_FORMATS}
    assert can_carry(".3MF", "print settings")
    assert not can_carry(".stl", "bodies")


@pytest.mark.parametrize(("form", "ending"), ENDINGS, ids=by_name)
def test_a_pseudonymous_export_takes_what_names_nobody(form: FileFormat, ending: str) -> None:
    name = f"P-17-left{ending}"
    files = (OrderFile(name, "0" * 64, 1), OrderFile(f"Bergqvist{ending}", "1" * 64, 1))
    order = Order(
        "o", "A7", "v", "p", OrderState.SENT, "", None, "", 1, "", (), files, (), "", "", 1
    )  # fmt: skip
    person = Person(name="Bergqvist", pseudonym="P-17")
    (kept,) = pseudonymous(PersonDossier(person, (), (order,), ())).orders
    assert [file.name for file in kept.files] == ([name] if form.names_nobody else [])


def test_every_format_of_scans_is_described() -> None:
    manual = Path(__file__).parents[3] / "docs"
    for page in ("formats/scans.md", "manual/formats.md", "manual/sv/formats.md"):
        text = (manual / page).read_text(encoding="utf-8")
        assert [suffix for suffix in SCAN_SUFFIXES if f"`{suffix}`" not in text] == []
    for page in ("manual/export.md", "manual/sv/export.md"):
        text = (manual / page).read_text(encoding="utf-8")
        assert [f.ending for f in SOLID_FORMATS if f"`{f.ending}`" not in text] == []
