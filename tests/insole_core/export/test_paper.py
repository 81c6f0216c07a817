"""The papers: PDF with the hash of the file, whatever the script of the names."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from insole_core.errors import InputError, OutputError
from insole_core.export import paper
from insole_core.export.height_picture import HeightPicture, MappedHeights
from insole_core.export.paper import (
    JobSheet,
    paragraph,
    write_job_sheet,
    write_pages,
    write_prescription,
)
from insole_core.geometry.height_map import HeightMap
from insole_core.resources import resource_path

TOP = np.full((40, 20), np.nan)
TOP[5:35, 4:16] = 8.0 + np.arange(12)
MM_PER_PT = 25.4 / 72
BOTTOM = np.where(np.isfinite(TOP), 0.0, np.nan)


def sheet(file: Path) -> JobSheet:
    return JobSheet(
        identification={"pseudonym": "Ø-足 <&> 7", "side": "left"},
        measures={"length": "248.5 mm"},
        make={"material": "EVA 40 Shore A", "tolerance": "±0.3 mm"},
        checks=("✓ closed",),
        file=file,
        file_name="insole.stl",
        height_map=HeightMap(TOP, BOTTOM),
    )


def test_papers_are_pdf(tmp_path: Path):
    file = tmp_path / "solid.stl"
    file.write_bytes(b"solid")
    write_job_sheet([sheet(file)], tmp_path / "sheet.pdf")
    write_prescription(
        {"pseudonym": "Ø-足"},
        ["pelott 6 mm, A. Berg, 2026-11-20"],
        {},
        tmp_path / "paper.pdf",
        responsible={"maker": "足 AB"},
    )
    for name in ("sheet.pdf", "paper.pdf"):
        content = (tmp_path / name).read_bytes()
        assert content.startswith(b"%PDF")
        assert content.rstrip().endswith(b"%%EOF")


def pages(path: Path) -> int:
    return path.read_bytes().count(b"/Type /Page\n")


def test_the_picture_of_a_job_sheet_takes_what_is_left_of_the_page(tmp_path: Path):
    """It goes on to a page of its own only where too little is left to see it."""
    file = tmp_path / "solid.stl"
    file.write_bytes(b"solid")
    alone, step = 0, 3
    for count in range(1, 41, step):
        made = replace(sheet(file), make={f"value {number}": "1 mm" for number in range(count)})
        write_job_sheet([made], tmp_path / "sheet.pdf")
        write_job_sheet([replace(made, height_map=None)], tmp_path / "bare.pdf")
        alone += pages(tmp_path / "sheet.pdf") > pages(tmp_path / "bare.pdf")
    row_mm = 15 * MM_PER_PT
    assert 0 < step * alone * row_mm < 70
    picture = HeightPicture(
        [MappedHeights(HeightMap(TOP, BOTTOM))], (0, 0, 20, 40), 400, least_pt=90
    )
    assert picture.wrap(500, 1000)[1] == pytest.approx(400)
    assert picture.wrap(500, 200)[1] == pytest.approx(200)
    assert picture.wrap(500, 20)[1] == pytest.approx(90)


def test_words_of_the_facts_can_be_edited(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    folder = tmp_path / "texts"
    shutil.copytree(resource_path("texts"), folder)
    (folder / "words.json").write_text('{"side": "Sida", "left": "vänster"}')
    monkeypatch.setattr(paper, "resource_path", lambda name: tmp_path / name)
    shown: list[str] = []
    monkeypatch.setattr(paper, "as_written", lambda text: shown.append(text) or text)
    write_prescription({"side": "left"}, [], {}, tmp_path / "paper.pdf", responsible={})
    assert {"Sida", "vänster"} <= set(shown)
    (folder / "words.json").write_text("{")
    with pytest.raises(InputError, match="correct the texts"):
        write_prescription({"side": "left"}, [], {}, tmp_path / "paper.pdf", responsible={})


def test_file_that_went_away(tmp_path: Path):
    with pytest.raises(InputError, match="export it again"):
        write_job_sheet([sheet(tmp_path / "none.stl")], tmp_path / "sheet.pdf")
    assert list(tmp_path.iterdir()) == []


def test_place_that_cannot_be_written(tmp_path: Path):
    file = tmp_path / "solid.stl"
    file.write_bytes(b"solid")
    with pytest.raises(OutputError, match="folder does not exist"):
        write_job_sheet([sheet(file)], tmp_path / "no" / "sheet.pdf")


@pytest.mark.parametrize("where", ["pseudonym", "line", "title", "file"])
def test_markup_in_a_foreign_text_is_written_as_it_is(tmp_path: Path, where: str):
    image = tmp_path / "beacon.png"
    Figure(figsize=(1, 1)).savefig(image)
    evil = f'<img src="{image}" width="50" height="50"/><b>$\\frac$ & EVIL'

    def written(text: str) -> bytes:
        path = tmp_path / "paper.pdf"
        if where == "title":
            write_pages([paragraph(text, paper.TITLE)], path, text, text)
        elif where == "file":
            file = tmp_path / "solid.stl"
            file.write_bytes(b"solid")
            write_job_sheet([replace(sheet(file), file_name=text)], path)
        else:
            facts = {"pseudonym": text if where == "pseudonym" else "A"}
            lines = [text if where == "line" else "pelott"]
            maker = {"maker": text if where == "maker" else "Sula AB"}
            write_prescription(facts, lines, {}, path, responsible=maker)
        return path.read_bytes()

    assert written(evil).count(b"/Subtype /Image") == written("plain").count(b"/Subtype /Image")
