"""Make what is printed at true size: ``python resources/targets/make.py``.

The boards beside this file, and the plan of the reference system of bricks.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from insole_core.calibration.boards.board import Charuco, Chequerboard
from insole_core.calibration.markers.reference_file import load_reference_system, positions
from insole_core.errors import UsageError
from insole_core.geometry.arrays import FloatArray
from insole_core.recording.session import Marker, ReferenceSystem

A4_MM = (297.0, 210.0)
A3_MM = (420.0, 297.0)
STUD_MM = 8.0
PLATE_MM = 3.2
"""Three plates are one brick of 9.6 mm."""
_MARKER_MM = 15.8
_INCH_MM = 25.4
_RULER_MM = 100.0


def main() -> None:
    """Write the boards and the plan to their places among the resources."""
    here = Path(__file__).parent
    write([draw_chequerboard(Chequerboard(10, 7, 25), A4_MM)], here / "chequerboard-a4-25mm.pdf")
    write([draw_chequerboard(Chequerboard(12, 8, 30), A3_MM)], here / "chequerboard-a3-30mm.pdf")
    write([draw_charuco(Charuco(10, 7, 27, 20), A4_MM)], here / "charuco-a4-27mm.pdf")
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
    pages = []
    for face in dict.fromkeys(marker.face for marker in system.markers):
        markers = system.facing((face,))
        pages += [_table_page(system.name, face, markers), _template_page(face, markers)]
    return pages


def draw_chequerboard(board: Chequerboard, page_mm: tuple[float, float]) -> Figure:
    """Draw a chequerboard on a page at true size.

    Raises
    ------
    UsageError
        When it does not fit the page.
    """
    text = f"{board.columns}×{board.rows} inner corners, square {board.square_mm:g} mm"
    columns, rows = board.columns + 1, board.rows + 1
    figure, axes = _page(page_mm, (columns * board.square_mm, rows * board.square_mm), text)
    for row in range(rows):
        for column in range(row % 2, columns, 2):
            _box(axes, column * board.square_mm, row * board.square_mm, board.square_mm)
    return figure


def draw_charuco(board: Charuco, page_mm: tuple[float, float]) -> Figure:
    """Draw a ChArUco board on a page at true size.

    Raises
    ------
    UsageError
        When it does not fit the page.
    """
    text = (
        f"ChArUco {board.columns}×{board.rows}, square {board.square_mm:g} mm, marker "
        f"{board.marker_mm:g} mm, {board.dictionary}"
    )
    size = (board.columns * board.square_mm, board.rows * board.square_mm)
    figure, axes = _page(page_mm, size, text)
    picture = board.pattern().generateImage((board.columns * 200, board.rows * 200), marginSize=0)
    extent = (0.0, size[0], size[1], 0.0)
    axes.imshow(np.asarray(picture), cmap="gray", extent=extent, interpolation="nearest")
    axes.set(aspect="auto")
    return figure


def brick_steps(markers: Sequence[Marker]) -> list[tuple[str, int, int, float]]:
    """Say for each marker of a face: id, studs across, studs along, plates above the lowest.

    Plates may be fractions when the marker does not stand on the grid of the bricks.
    """
    across, along, height = _axes_of(positions(markers))
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


def _axes_of(points: FloatArray) -> tuple[int, int, int]:
    """Give the axis across the face, along it, and out of it: x, then y or z."""
    return (0, 2, 1) if np.ptp(points[:, 2]) > np.ptp(points[:, 1]) else (0, 1, 2)


def _table_page(name: str, face: str, markers: Sequence[Marker]) -> Figure:
    figure = Figure(figsize=(A4_MM[1] / _INCH_MM, A4_MM[0] / _INCH_MM))
    across, along, height = ("xyz"[axis] for axis in _axes_of(positions(markers)))
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


def _template_page(face: str, markers: Sequence[Marker]) -> Figure:
    points = positions(markers)
    across, along, _ = _axes_of(points)
    low = points[:, [across, along]].min(0) - _MARKER_MM
    size = points[:, [across, along]].max(0) + _MARKER_MM - low
    page = A3_MM if size[0] > size[1] else A3_MM[::-1]
    title = f"Face {face}: {'xyz'[across]} to the right, {'xyz'[along]} downwards"
    figure, axes = _page(page, (float(size[0]), float(size[1])), title)
    for marker, point in zip(markers, points, strict=True):
        x, y = (point[[across, along]] - low).tolist()
        _box(axes, x - _MARKER_MM / 2, y - _MARKER_MM / 2, _MARKER_MM, "#0057b8")
        axes.text(x + 10, y, marker.id, va="center", fontsize=8)
    return figure


def _page(
    page_mm: tuple[float, float], size_mm: tuple[float, float], text: str
) -> tuple[Figure, Axes]:
    """Give a page, and axes in mm for a drawing of a given size in its middle (y downwards)."""
    margin = 5.0
    if size_mm[0] > page_mm[0] - 2 * margin or size_mm[1] > page_mm[1] - 2 * margin:
        raise UsageError(
            "A drawing of {width_mm:.0f}×{height_mm:.0f} mm does not fit a page of "
            "{page_width_mm:.0f}×{page_height_mm:.0f} mm; choose a larger page or a smaller board.",
            width_mm=size_mm[0],
            height_mm=size_mm[1],
            page_width_mm=page_mm[0],
            page_height_mm=page_mm[1],
        )
    figure = Figure(figsize=(page_mm[0] / _INCH_MM, page_mm[1] / _INCH_MM), facecolor="white")
    whole = figure.add_axes((0, 0, 1, 1))
    whole.set(xlim=(0, page_mm[0]), ylim=(page_mm[1], 0))
    whole.axis("off")
    # The lower margin holds the words and the ruler, however narrow it is.
    base = page_mm[1] - 2.0
    whole.plot([10, 10 + _RULER_MM], [base, base], "k-", lw=0.8)
    for x in (10, 10 + _RULER_MM):
        whole.plot([x, x], [base - 1.5, base + 1], "k-", lw=0.8)
    note = f"{text}. Print at 100 %: this line is {_RULER_MM:.0f} mm."
    whole.text(14 + _RULER_MM, base, note, fontsize=6, va="center")
    left, top = (page_mm[0] - size_mm[0]) / 2, (page_mm[1] - size_mm[1]) / 2
    inner = figure.add_axes(
        (
            left / page_mm[0],
            1 - (top + size_mm[1]) / page_mm[1],
            size_mm[0] / page_mm[0],
            size_mm[1] / page_mm[1],
        )
    )
    inner.axis("off")
    inner.set(xlim=(0, size_mm[0]), ylim=(size_mm[1], 0))
    return figure, inner


def _box(axes: Axes, x: float, y: float, side: float, color: str = "black") -> None:
    axes.add_patch(Rectangle((x, y), side, side, facecolor=color, edgecolor="none"))


if __name__ == "__main__":
    main()
