"""The certificate of the reference foot, and its markers at true size; in English."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from reportlab.graphics.shapes import Drawing, Rect, String
from reportlab.lib import colors
from reportlab.lib.units import mm
from reportlab.platypus import Flowable, PageBreak

from insole_core.calibration.boards.printed_page import BLUE, MARKER_MM, RULER_MM
from insole_core.evaluation.printed_body import MOST_SIZE, MOST_SKEW_DEG
from insole_core.export.paper import HEAD, TITLE, facts_table, paragraph, write_pages
from insole_core.geometry.mesh import TriangleMesh
from insole_core.recording.session import ReferenceSystem
from insole_core.simulate.reference_foot import (
    BAR_MM,
    BED_MM,
    FILM_MM,
    NAME,
    PLATE_MM,
    ReferenceFoot,
    reference_system,
)

BODY_FILE, BAR_FILE = "reference-foot.stl", "scale-bar.stl"
_BLUE = colors.HexColor(BLUE)
_PAGE_MM = (170.0, 210.0)
_SPARE, _GAP_MM = 4, 6.0
_PLAN_SCALE, _PLAN_LOW = 0.4, 40.0
_STEPS = (
    "Print both with the same settings, one after the other, as they lie in the files: no turning, "
    "no scaling, layers of 0.12 mm or finer, no support below the foot.",
    "Measure the bar with callipers when it is cold: its edges along x, y and z, then the two "
    "diagonals of its large face, first the one from the corner of least x and y. Enter the five "
    "readings with --callipers. Check the print itself by the distances above.",
    "Glue the blue squares of the next page, or film of that size, onto the ends of the posts and "
    "onto the upper ends of the steps that look backwards, flush with their edges.",
    "Choose reference-system.json as the reference system, stand the body where a foot would hang, "
    "and capture it as a left foot.",
)


@dataclass(frozen=True)
class ControlLength:
    """A distance between two flat faces of the print.

    Parameters
    ----------
    between
        The faces, in words.
    drawn_mm
    axis
        Of the printer, ``x``, ``y`` or ``z``.
    """

    between: str
    drawn_mm: float
    axis: str


def control_lengths() -> tuple[ControlLength, ...]:
    """Return what callipers check on the print itself: its plate and its posts."""
    (low, high), places = PLATE_MM, {one.id: one.position_mm for one in reference_system().markers}
    return (
        ControlLength("sides of the plate", high[0] - low[0], "x"),
        ControlLength("ends of the plate", high[1] - low[1], "y"),
        ControlLength(
            "outer sides of the posts S1 and S3", places["S3"][0] - places["S1"][0] + MARKER_MM, "x"
        ),
        ControlLength(
            "ends of the posts S8 and S6, outer sides",
            places["S8"][1] - places["S6"][1] + MARKER_MM,
            "y",
        ),
        ControlLength(
            "underside of the plate and end of S5", high[2] - places["S5"][2] - FILM_MM, "z"
        ),
        ControlLength(
            "underside of the plate and end of S9", high[2] - places["S9"][2] - FILM_MM, "z"
        ),
    )


def certificate(foot: ReferenceFoot, body: TriangleMesh, bar: TriangleMesh) -> dict[str, object]:
    """Return the numbers of the certificate (docs/formats/calibration.md).

    Parameters
    ----------
    body, bar
        As they are printed, mm.
    """
    return {
        "format": "insole-studio-reference-foot",
        "version": 1,
        "name": NAME,
        "side": str(foot.side),
        "measures_mm": {key: round(value, 2) for key, value in foot.measures_mm.items()},
        "bar_mm": list(BAR_MM),
        "bar_diagonal_mm": round(math.hypot(*BAR_MM[:2]), 2),
        "control_lengths": [
            {"between": one.between, "axis": one.axis, "mm": round(one.drawn_mm, 2)}
            for one in control_lengths()
        ],
        "size_mm": [round(float(size), 1) for size in np.ptp(body.bounds_mm, axis=0)],
        "volume_cm3": {
            BODY_FILE: round(body.volume_mm3 / 1000, 1),
            BAR_FILE: round(bar.volume_mm3 / 1000, 1),
        },
        "most_size_error": MOST_SIZE,
        "most_skew_deg": MOST_SKEW_DEG,
    }


def write_paper(foot: ReferenceFoot, body: TriangleMesh, bar: TriangleMesh, path: Path) -> None:
    """Write the certificate for people, with the blue markers to cut out.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    wide, deep, high = np.ptp(body.bounds_mm, axis=0)
    print_facts = {
        "Name and version": NAME,
        "Side": str(foot.side),
        "Size, mm": f"{wide:.0f} × {deep:.0f} × {high:.0f}, for a bed of "
        f"{BED_MM[0]:.0f} × {BED_MM[1]:.0f} mm",
        "Volume, cm³": f"{body.volume_mm3 / 1000:.0f}, and {bar.volume_mm3 / 1000:.0f} of the bar",
    }
    diagonal = math.hypot(*BAR_MM[:2])
    bar_facts = {
        **{f"Edge along {axis}, mm": f"{mm_:.2f}" for axis, mm_ in zip("xyz", BAR_MM, strict=True)},
        "Both diagonals in x and y, mm": f"{diagonal:.2f}",
    }
    lengths = {
        f"{one.between} ({one.axis}), mm": f"{one.drawn_mm:.2f}" for one in control_lengths()
    }
    measures = {f"{name}, mm": f"{value:.2f}" for name, value in foot.measures_mm.items()}
    story: list[Flowable] = [paragraph("Reference foot: certificate", TITLE)]
    story += facts_table("The print", print_facts) + facts_table("Its measures, as drawn", measures)
    story += facts_table("The scale bar, as drawn", bar_facts)
    story += facts_table("Distances between flat faces, as drawn", lengths)
    story += [
        paragraph("Use", HEAD),
        *(paragraph(f"{n}. {text}") for n, text in enumerate(_STEPS, 1)),
    ]
    story += [PageBreak(), paragraph("Markers, to print at 100 %", TITLE), _squares(foot.system)]
    write_pages(story, path, "Reference foot: certificate")


def _squares(system: ReferenceSystem) -> Drawing:
    """Draw a blue square for each marker, and some to spare, with a ruler to check their size."""
    page = Drawing(_PAGE_MM[0] * mm, _PAGE_MM[1] * mm)
    names = [marker.id for marker in system.markers] + [""] * _SPARE
    step = MARKER_MM + _GAP_MM
    columns = int(_PAGE_MM[0] // step)
    for number, name in enumerate(names):
        row, column = divmod(number, columns)
        x, y = column * step * mm, (_PAGE_MM[1] - (row + 1) * step) * mm
        page.add(Rect(x, y, MARKER_MM * mm, MARKER_MM * mm, fillColor=_BLUE, strokeColor=None))
        page.add(String(x, y - 9, name, fontSize=8))
    _draw_plan(page, system)
    page.add(Rect(0, 10, RULER_MM * mm, 2, fillColor=colors.black, strokeColor=None))
    page.add(String(0, 0, f"{RULER_MM:.0f} mm", fontSize=8))
    return page


def _draw_plan(page: Drawing, system: ReferenceSystem) -> None:
    """Draw the posts as they are seen when one looks at the sole, the toes up, at reduced size."""
    (_, rear, _), (right, front, _) = PLATE_MM
    scale = _PLAN_SCALE * mm

    def box(x: float, y: float, width: float, height: float, **look: object) -> None:
        left, low = (right - x - width) * scale, (y - rear) * scale + _PLAN_LOW
        page.add(Rect(left, low, width * scale, height * scale, **look))

    box(-right, rear, 2 * right, front - rear, fillColor=None, strokeWidth=0.5)
    for marker in system.markers:
        x, y, _ = marker.position_mm
        is_below = marker.face == "sole"
        depth, color = (MARKER_MM, _BLUE) if is_below else (2.0, colors.black)
        start = y - depth / 2 if is_below else y
        box(x - MARKER_MM / 2, start, MARKER_MM, depth, fillColor=color, strokeColor=None)
        text_y = (start - rear) * scale + _PLAN_LOW + (3 if is_below else -7)
        ink = colors.white if is_below else colors.black
        left = (right - x - MARKER_MM / 2) * scale + 2
        page.add(String(left, text_y, marker.id, fontSize=6, fillColor=ink))
