"""Sections of the drawing: ends, heights and the thinnest place of a known face."""

from __future__ import annotations

import re
import string
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from read_pdf import bytes_of_pdf, paths_of_pdf, text_of_pdf
from reportlab.lib.units import mm
from reportlab.pdfgen.canvas import Canvas

from insole_core.export.insole_drawing import (
    SCALES,
    DrawnInsole,
    Element,
    Section,
    SectionsPage,
    ViewsPage,
)
from insole_core.export.paper import JobSheet, write_job_sheet
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.side import Side


def test_a_section_tells_the_dimensions_of_its_face() -> None:
    # 40 mm wide, flat below, 10 mm high at both rims, sloping to 2 mm at 25.
    face = np.array([(0, 0), (40, 0), (40, 10), (25, 2), (0, 10)], float)
    section = Section("heel", 0.0, (face,))
    assert section.ends_mm == (0, 40)
    assert section.heights_mm(12.5) == pytest.approx((0, 6))
    assert section.thinnest_mm() == pytest.approx(25)
    assert (section.rim_mm(0), section.rim_mm(1)) == (10, 10)


def test_a_section_of_two_faces_spans_both() -> None:
    faces = (np.array([(0, 0), (4, 0), (4, 3), (0, 3)], float),)
    faces += (faces[0] + [6, 5],)
    section = Section("heel", 0.0, faces)
    assert section.ends_mm == (0, 10)
    assert section.heights_mm(8.0) == pytest.approx((5, 8))


def drawn_box() -> DrawnInsole:
    """A box of 73 × 140 × 11 mm."""
    heights = HeightMap(np.full((140, 73), 11.0), np.zeros((140, 73)), (-36.0, 0.5))

    def face(wide: float, tall: float) -> np.ndarray:
        return np.array([(0, 0), (wide, 0), (wide, tall), (0, tall)]) - [wide / 2, 0]

    across = {"A": Section("ball", 90.0, (face(73, 11),))}
    return DrawnInsole(
        Side.LEFT, np.array([(-36.5, 0, 0), (36.5, 140, 11)]), heights,
        (face(73, 140),), (face(140, 11),), across, Section("along the axis", 0, (face(140, 11),)),
    )  # fmt: skip


def test_what_is_drawn_at_one_to_one_has_its_true_size(tmp_path: Path) -> None:
    """The bar and every face; on the paper of A4, which no printer has to scale."""
    from insole_core.export.paper import paragraph

    paragraph("")  # the fonts
    sizes: dict[str, list[np.ndarray]] = {}
    for page in (
        SectionsPage(drawn_box(), (173, 259), {}, {}),
        ViewsPage([drawn_box()], (173, 259), {}, {}),
    ):
        path = tmp_path / f"{type(page).__name__}.pdf"
        canvas = Canvas(str(path))
        page.drawOn(canvas, 16 * mm, 16 * mm)
        canvas.save()
        sizes[type(page).__name__] = [np.ptp(line, axis=0) for line in paths_of_pdf(path)]
        assert b"/MediaBox [ 0 0 595.2756 841.8898 ]" in path.read_bytes()

    def count(page: str, *size_mm: float) -> int:
        exact = 3e-4 * np.array(size_mm)
        return sum(bool((np.abs(size - size_mm) <= exact + 1e-6).all()) for size in sizes[page])

    assert count("SectionsPage", 73, 11) == 1
    assert count("SectionsPage", 140, 11) == 1
    assert count("SectionsPage", 10, 1.4) == 5, "the fields of the bar of 50 mm"
    assert max(count("ViewsPage", 10 / scale, 1.4) for scale in SCALES) == 5


def test_no_arrow_crosses_the_width_of_a_section(tmp_path: Path) -> None:
    from insole_core.export.paper import paragraph

    paragraph("")  # the fonts
    path = tmp_path / "sections.pdf"
    canvas = Canvas(str(path))
    SectionsPage(drawn_box(), (173, 259), {}, {}).drawOn(canvas, 16 * mm, 16 * mm)
    canvas.save()
    lines = [np.array(line) for line in paths_of_pdf(path)]
    sizes = [np.ptp(line, axis=0) for line in lines]
    (face,) = [one for one, size in zip(lines, sizes, strict=True) if np.allclose(size, (73, 11))]
    bottom = face[:, 1].min()
    upright = [one for one, (wide, tall) in zip(lines, sizes, strict=True) if wide < 0.01 < tall]
    below = [one[:, 1].min() for one in upright if abs(one[0, 0] - face[:, 0].mean()) < 20]
    arrow = min(y for y in below if bottom - 10 < y < bottom)
    level = [one for one, (wide, tall) in zip(lines, sizes, strict=True) if tall < 0.01 < wide]
    (width,) = {
        round(float(one[0, 1]), 2)
        for one in level
        if np.ptp(one[:, 0]) > 70 and bottom - 10 < one[0, 1] < bottom - 1
    }
    assert arrow < bottom - 3
    assert width + 1.3 < arrow  # half the height of the number


@pytest.mark.parametrize(
    ("count", "remarks", "sheets", "goes_on"),
    [(3, "", 3, []), (17, "", 4, ["right"]), (40, "", 5, ["left", "right"]),
     (90, "cork\n", 7, ["left", "left", "right", "right"])],
)  # fmt: skip
def test_all_that_is_prescribed_stands_on_the_drawing(
    tmp_path: Path, count: int, remarks: str, sheets: int, goes_on: list[str]
) -> None:
    """What finds no room beside the views goes on, with its side, on the sheets that follow."""
    file, path = tmp_path / "a.stl", tmp_path / "sheet.pdf"
    file.write_bytes(b"solid")
    pieces = [
        replace(
            drawn_box(),
            side=side,
            elements=tuple(Element(n, "", f"{side} pad {n} ends") for n in range(1, count + 1)),
        )
        for side in Side
    ]
    drawn = [
        JobSheet({}, {}, {}, (), file, "a.stl", drawn=piece, remarks=remarks) for piece in pieces
    ]
    write_job_sheet(drawn, path, pieces=pieces)
    lines = text_of_pdf(path).splitlines()
    for piece in pieces:
        for element in piece.elements:
            assert lines.count(element.text) == 1, element
    # The views, the sheets on which the table goes on, and the sections of each piece.
    numbers = [lines.index(f"{n} / {sheets}") for n in range(1, sheets + 1)]
    assert numbers == sorted(numbers)
    assert len(re.findall(rb"/Type /Page\b", bytes_of_pdf(path))) == sheets + len(pieces)
    assert sum(line.endswith("see the next sheet") for line in lines) == bool(goes_on)
    tables = [at for at, line in enumerate(lines) if line == "Posts, pads and corrections"]
    assert len(tables) == 1 + len(goes_on)
    assert [lines[at + 1] for at in tables] == ["left", *goes_on]


@pytest.mark.parametrize("letters", [8, 60, 120])
def test_nothing_of_what_identifies_a_piece_is_cut(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, letters: int
) -> None:
    """Each sheet has the whole number of what it shows, however long it is, within its field."""
    ends: list[float] = []
    draw = Canvas.drawString

    def note(canvas: Canvas, x: float, y: float, text: str) -> None:
        if len(text) > 2 and text[:3] in 2 * string.ascii_uppercase:
            ends.append(x / mm + canvas.stringWidth(text) / mm)
        draw(canvas, x, y, text)

    monkeypatch.setattr(Canvas, "drawString", note)
    file, path = tmp_path / "a.stl", tmp_path / "sheet.pdf"
    file.write_bytes(b"solid")
    left, right = ((string.ascii_uppercase * 5)[:letters] + f"-1-{side}" for side in "LR")
    sheets = [
        JobSheet(
            {}, {}, {}, (), file, "a.stl", drawn=replace(drawn_box(), side=side),
            title={"serial number": f"{left}, {right}", "cover": "Nora"},
            own_title={"serial number": own, "cover": "Nora"},
        )
        for side, own in zip(Side, (left, right), strict=True)
    ]  # fmt: skip
    write_job_sheet(sheets, path, pieces=[sheet.drawn for sheet in sheets if sheet.drawn])
    blocks = re.findall(r"Serial number of the piece\n(.*?)\nCover\n", text_of_pdf(path), re.DOTALL)
    numbers = [re.sub(r"[,\s]", "", block) for block in blocks]
    assert numbers == [left + right, left, right]
    assert max(ends) < 173 / 4
