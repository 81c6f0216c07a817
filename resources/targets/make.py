"""Make what is printed at true size: ``python resources/targets/make.py``.

The boards beside this file, and the plans of the reference systems of bricks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
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
from insole_core.recording.session import FootPlace, Marker, ReferenceSystem

A4_MM = (297.0, 210.0)
A3_MM = (420.0, 297.0)
STUD_MM = 8.0
PLATE_MM = 3.2
"""Three plates are one brick of 9.6 mm."""
_PLATES_A_BRICK = 3
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
    for name in ("lego-20", "lego-40"):
        plan = draw_building_plan(load_reference_system(systems / f"{name}.json"))
        write(plan, systems / f"{name}-plan.pdf")


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
    if not system.feet:
        return _building_sheets(system)
    sheets = [_building_sheets(_around(system, place)) for place in system.feet]
    return [_overview(system), *chain.from_iterable(sheets)]


def _around(system: ReferenceSystem, place: FootPlace) -> ReferenceSystem:
    """Return the markers around one of two feet, in the foot's own frame."""
    near = [m for m in system.markers if (m.position_mm[0] > 0) == (place.origin_mm[0] > 0)]
    part = replace(system, name=f"{system.name}, {place.side} foot", markers=tuple(near))
    return part.around(place)


def _building_sheets(system: ReferenceSystem) -> list[Figure]:
    faces = dict.fromkeys(marker.face for marker in system.markers)
    tables = [_table_page(system.name, face, system.facing((face,))) for face in faces]
    templates = [draw(page) for page in marker_pages(system, A3_MM)]
    return list(chain.from_iterable(zip(tables, templates, strict=True)))


def _overview(system: ReferenceSystem) -> Figure:
    """Show where both frames stand, and list the parts."""
    figure = Figure(figsize=(A4_MM[0] / _INCH_MM, A4_MM[1] / _INCH_MM), facecolor="white")
    axes = figure.add_axes((0.05, 0.08, 0.62, 0.8))
    axes.set_aspect("equal")
    axes.axis("off")
    for place in system.feet:
        box = place.volume_of_interest.moved(place.origin_mm)
        low, high = box.min_mm, box.max_mm
        size = (high[0] - low[0], high[1] - low[1])
        axes.add_patch(Rectangle(low[:2], *size, fill=False, ls="--", edgecolor="grey"))
        middle = (place.origin_mm[0], place.origin_mm[1])
        axes.text(*middle, f"{place.side} foot\ntoes up", ha="center", va="center", fontsize=9)
    for marker in system.markers:
        x, y, _ = marker.position_mm
        on_sole = marker.face == "sole"
        color = "#1634a8" if on_sole else "#9aa7d6"
        axes.add_patch(Rectangle((x - 7.9, y - 7.9), 15.8, 15.8, color=color, lw=0))
        if on_sole:  # those at the heel stand above each other
            axes.text(x + 10, y, marker.id, fontsize=5, va="center")
    left, right = (place.origin_mm[0] for place in system.feet)
    axes.annotate(
        "",
        (left, -185),
        (right, -185),
        arrowprops={"arrowstyle": "<->", "shrinkA": 0, "shrinkB": 0},
    )
    axes.text(0, -181, f"{right - left:.0f} mm = {(right - left) / STUD_MM:.0f} studs", ha="center")
    axes.set(xlim=(-250, 260), ylim=(-200, 195))
    figure.text(0.05, 0.92, f"{system.name}: frame for both feet, seen from above", fontsize=13)
    figure.text(
        0.05,
        0.04,
        "Dark blue: markers that face the sensors below the soles. Light blue: eight markers "
        "beside each heel, some above each other,\nthat face backwards. Dashed: the room for each "
        "foot. The patient's right is at the right. Not to scale; the templates that follow are.",
        fontsize=8,
    )
    figure.text(0.69, 0.85, "\n".join(_parts(system)), fontsize=9, va="top", linespacing=1.6)
    return figure


def _parts(system: ReferenceSystem) -> list[str]:
    """List the parts of a frame for both feet."""
    lines = ["Parts", ""]
    bricks, plates = 0, 0
    for face in dict.fromkeys(marker.face for marker in system.markers):
        for place in system.feet:
            markers = _around(system, place).facing((face,))
            raised = [round(steps) for *_, steps in brick_steps(markers)]
            bricks += sum(steps // _PLATES_A_BRICK for steps in raised)
            plates += sum(steps % _PLATES_A_BRICK for steps in raised)
    lines += [
        f"{len(system.markers)}  blue bricks of 2 × 2 studs (markers)",
        f"{bricks}  grey bricks of 2 × 2 studs, to raise them",
        f"{plates}  grey plates of 2 × 2 studs, to raise them",
        "    base plates of studs 8.0 mm apart, as large as",
        "    the four templates, open where the feet are",
        "1  stiff board, 600 × 450 mm, on which both",
        "    frames are screwed",
        "",
        "No part but the markers may be blue. The",
        "frame for the left foot and the one for the",
        "right differ, and neither is like the frame",
        "for one foot (lego-20): do not exchange them.",
    ]
    return lines


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
