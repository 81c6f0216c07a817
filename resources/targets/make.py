"""Make what is printed at true size: ``python resources/targets/make.py``.

The boards beside this file, and the plan of the reference system of bricks.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from pathlib import Path

from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from insole_core.calibration.boards.board import Charuco, Chequerboard
from insole_core.calibration.boards.printed_page import (
    RULER_MM,
    PrintedPage,
    axes_of_face,
    charuco_page,
    chequerboard_page,
    marker_pages,
)
from insole_core.calibration.markers.reference_file import load_reference_system, positions
from insole_core.recording.session import Marker, ReferenceSystem

A4_MM = (297.0, 210.0)
A3_MM = (420.0, 297.0)
STUD_MM = 8.0
PLATE_MM = 3.2
"""Three plates are one brick of 9.6 mm."""
_INCH_MM = 25.4


def main() -> None:
    """Write the boards and the plan to their places among the resources."""
    here = Path(__file__).parent
    for page, name in (
        (chequerboard_page(Chequerboard(10, 7, 25), A4_MM), "chequerboard-a4-25mm.pdf"),
        (chequerboard_page(Chequerboard(12, 8, 30), A3_MM), "chequerboard-a3-30mm.pdf"),
        (charuco_page(Charuco(10, 7, 27, 20), A4_MM), "charuco-a4-27mm.pdf"),
    ):
        write([draw(page)], here / name)
    systems = here.parent / "reference_systems"
    plan = draw_building_plan(load_reference_system(systems / "lego-20.json"))
    write(plan, systems / "lego-20-plan.pdf")


def write(pages: Sequence[Figure], path: Path) -> None:
    """Write pages as PDF; print it at 100 % and check the ruler."""
    with PdfPages(path, metadata={"CreationDate": None}) as pdf:
        for page in pages:
            pdf.savefig(page)


def draw_building_plan(system: ReferenceSystem) -> list[Figure]:
    """Say how to build a reference system from bricks, with templates of its faces at true size.

    Raises
    ------
    UsageError
        When a face does not fit A3.
    """
    faces = dict.fromkeys(marker.face for marker in system.markers)
    tables = [_table_page(system.name, face, system.facing((face,))) for face in faces]
    templates = [draw(page) for page in marker_pages(system, A3_MM)]
    return list(chain.from_iterable(zip(tables, templates, strict=True)))


def draw(page: PrintedPage) -> Figure:
    """Draw a page at true size, with its words and the ruler in the lower margin."""
    width, height = page.size_mm
    figure = Figure(figsize=(width / _INCH_MM, height / _INCH_MM), facecolor="white")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, width), ylim=(height, 0))
    axes.axis("off")
    base = height - 2.0
    axes.plot([10, 10 + RULER_MM], [base, base], "k-", lw=0.8)
    for x in (10, 10 + RULER_MM):
        axes.plot([x, x], [base - 1.5, base + 1], "k-", lw=0.8)
    note = f"{page.note}. Print at 100 %: this line is {RULER_MM:.0f} mm."
    axes.text(14 + RULER_MM, base, note, fontsize=6, va="center")
    for x, y, wide, tall in page.boxes_mm:
        axes.add_patch(Rectangle((x, y), wide, tall, facecolor=page.color, edgecolor="none"))
    for text, x, y in page.labels:
        axes.text(x, y, text, va="center", fontsize=8)
    return figure


def brick_steps(markers: Sequence[Marker]) -> list[tuple[str, int, int, float]]:
    """Say for each marker of a face: id, studs across, studs along, plates above the lowest.

    Plates may be fractions when the marker does not stand on the grid of the bricks.
    """
    across, along, height = axes_of_face(positions(markers))
    points = positions(markers)
    low = points.min(0)
    return [
        (
            marker.id,
            round((point[across] - low[across]) / STUD_MM),
            round((point[along] - low[along]) / STUD_MM),
            float(round((point[height] - low[height]) / PLATE_MM, 2)),
        )
        for marker, point in zip(markers, points, strict=True)
    ]


def _table_page(name: str, face: str, markers: Sequence[Marker]) -> Figure:
    figure = Figure(figsize=(A4_MM[1] / _INCH_MM, A4_MM[0] / _INCH_MM))
    across, along, height = ("xyz"[axis] for axis in axes_of_face(positions(markers)))
    lines = [
        f"{name}: face {face}",
        "",
        "Build on a base plate of studs 8.0 mm apart. Count studs and plates from the marker that",
        f"is lowest in {across}, {along} and {height}; 3 plates (3.2 mm) are 1 brick (9.6 mm).",
        "Two and a half plates are one stud of a brick that is turned on its side.",
        "A marker is a blue brick of 2 x 2 studs on top; its position is the centre of its face.",
        "",
        f"{'marker':8}{'studs in ' + across:>14}{'studs in ' + along:>14}"
        f"{'plates in ' + height:>14}   x, y, z in mm",
    ]
    for marker, (_, i, j, plates) in zip(markers, brick_steps(markers), strict=True):
        place = ", ".join(f"{value:7.1f}" for value in marker.position_mm)
        lines.append(f"{marker.id:8}{i:>14}{j:>14}{plates:>14g}   {place}")
    for row, line in enumerate(lines):
        figure.text(0.08, 0.94 - row * 0.022, line, fontsize=9, family="monospace")
    return figure


if __name__ == "__main__":
    main()
