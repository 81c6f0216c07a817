"""PDF of the set-up sheet: what lies at the router, in the order of the work, with a picture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from reportlab.lib import colors
from reportlab.lib.units import mm
from reportlab.platypus import Flowable

from insole_core.export.height_picture import HeightPicture, MappedHeights
from insole_core.export.paper import (
    HEAD,
    NOTE,
    TITLE,
    Facts,
    facts_table,
    listed,
    paper_texts,
    paragraph,
    write_pages,
)
from insole_core.geometry.height_map import HeightMap
from insole_core.messages import Translate

_FONT: Final = "DejaVuSans"
_SMALL_PT: Final = 7.0
_MARK: Final = colors.HexColor("#b3261e")
_AROUND_MM: Final = 14.0
_PICTURE_MM: Final = 150.0


@dataclass(frozen=True, eq=False)
class LyingPiece:
    """A piece where it lies, seen from above along the axes of the machine.

    Parameters
    ----------
    heights : mm, from the zero of the program along x and y, from the bottom of the block along z
    labels
        Place along x and y, and a text, each.
    """

    heights: HeightMap
    labels: tuple[tuple[float, float, str], ...]


@dataclass(frozen=True, eq=False)
class SetupPlan:
    """The block on the machine; all places are mm from the zero of the program.

    Parameters
    ----------
    block_mm
        Least x and y, greatest x and y.
    height_mm
        Of the block.
    dowels_mm
        x and y of each; empty for a block that is not turned. The axis runs through them.
    dowel_diameter_mm
        For the picture.
    """

    block_mm: tuple[float, float, float, float]
    height_mm: float
    pieces: tuple[LyingPiece, ...]
    dowels_mm: tuple[tuple[float, float], ...] = ()
    dowel_diameter_mm: float = 0.0


@dataclass(frozen=True, eq=False)
class SetupSheet:
    """What a router's operator needs; all texts are translated.

    Parameters
    ----------
    sections
        Facts, by the keys of the texts of the paper.
    steps
        What to do, one after the other.
    notes
        What the operator should know of the work, one sentence each.
    """

    sections: Mapping[str, Facts]
    steps: Sequence[str]
    plan: SetupPlan
    notes: Sequence[str] = ()


def write_setup_paper(sheet: SetupSheet, path: Path, translate: Translate = str) -> None:
    """Write a set-up sheet.

    Raises
    ------
    OutputError
        When the place cannot be written.
    InputError
        When the texts of the paper cannot be read.
    """
    texts = paper_texts("setup_sheet", translate)
    story: list[Flowable] = [paragraph(texts["title"], TITLE)]
    for key, facts in sheet.sections.items():
        story += facts_table(texts[key], facts, translate)
    story += listed(
        texts["steps"], [f"{number}. {step}" for number, step in enumerate(sheet.steps, 1)]
    )
    if sheet.notes:
        story += listed(texts["notes"], sheet.notes)
    story += [paragraph(texts["picture"], HEAD), _SetupPicture(sheet.plan, texts)]
    story.append(paragraph(texts["footer"], NOTE))
    write_pages(story, path, texts["title"])


class _SetupPicture(HeightPicture):
    """The block from above, with its pieces, the zero, the dowels and the axis of turning."""

    def __init__(self, plan: SetupPlan, texts: Mapping[str, str]) -> None:
        left, low, right, high = plan.block_mm
        frame = (
            min(left, 0.0) - _AROUND_MM, min(low, 0.0) - _AROUND_MM,
            max(right, 0.0) + _AROUND_MM, max(high, 0.0) + _AROUND_MM,
        )  # fmt: skip
        mapped = [MappedHeights(piece.heights, labels=piece.labels) for piece in plan.pieces]
        super().__init__(
            mapped, frame, _PICTURE_MM * mm, most_mm=plan.height_mm, block_mm=plan.block_mm
        )
        self._plan, self._texts = plan, texts

    def draw(self) -> None:
        """Draw the picture, and on it what has to be found on the machine."""
        super().draw()
        canvas = self.canv
        canvas.setStrokeColor(_MARK)
        canvas.setFillColor(_MARK)
        canvas.setFont(_FONT, _SMALL_PT)
        x, y = self._place(0, 0)
        canvas.setLineWidth(1.2)
        canvas.circle(x, y, 4, fill=0)
        canvas.line(x - 8, y, x + 8, y)
        canvas.line(x, y - 8, x, y + 8)
        canvas.drawString(x + 6, y + 5, self._texts["zero"])
        self._draw_axis()
        canvas.setFillColor(colors.black)

    def _draw_axis(self) -> None:
        canvas, dowels = self.canv, self._plan.dowels_mm
        if not dowels:
            return
        left, low, right, high = self._plan.block_mm
        (x, y), (far_x, _) = dowels
        ends = ((x, low - 8), (x, high + 8)) if x == far_x else ((left - 8, y), (right + 8, y))
        canvas.setLineWidth(0.8)
        canvas.setDash([8, 2, 1, 2])
        canvas.line(*self._place(*ends[0]), *self._place(*ends[1]))
        canvas.setDash()
        for at in dowels:
            x, y = self._place(*at)
            canvas.circle(x, y, self._plan.dowel_diameter_mm / 2 * self._scale, fill=0)
            beside = 5 if at[1] < (low + high) / 2 else -12
            canvas.drawString(x + 7, y + beside, f"X{at[0]:.1f} Y{at[1]:.1f}")
