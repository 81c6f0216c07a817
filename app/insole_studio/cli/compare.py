"""``insole-studio compare``: measure how far two surfaces differ, without a window."""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from insole_core.errors import UsageError
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_studio.cli.argument_parser import whole
from insole_studio.cli.foot_argument import A_MESH
from insole_studio.cli.path_arguments import OutputPath

if TYPE_CHECKING:
    from insole_core.compare.comparison import Alignment, ComparisonSource

NAME = "compare"
_ALIGNMENTS: dict[str, Literal["best", "none", "dots"]] = {
    "best": "best",
    "none": "none",
    "dots": "dots",
}
HELP = "measure how far two surfaces differ: feet, insoles, scans of moulds"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    for name in "ab":
        parser.add_argument(
            name,
            type=Path,
            metavar=name.upper(),
            help=f"{A_MESH}, a session, or a mould or insole recorded in one view",
        )
    parser.add_argument("--report", action=OutputPath, required=True, metavar="difference.json")
    parser.add_argument("--picture", action=OutputPath, metavar="difference.png")
    parser.add_argument(
        "--paper", action=OutputPath, metavar="difference.pdf", help="report to print"
    )
    parser.add_argument(
        "--surface", action=OutputPath, metavar="difference.ply", help="A in the colours"
    )
    parser.add_argument(
        "--align", type=_word_or_path, default="best", metavar="best|none|dots|points.json",
        help="fit B to A (default), take both as they lie, use four black dots, or picked points",
    )  # fmt: skip
    parser.add_argument(
        "--median", type=whole, default=1, metavar="PIXELS",
        help="spatial median filter of both, in pixels of 1 mm; 6 as in the thesis (default: none)",
    )  # fmt: skip


def run(arguments: argparse.Namespace, progress: Progress) -> None:
    """Read both surfaces, align B with A, measure the difference and write it."""
    _check_call(arguments)
    from insole_core.compare.comparison import compare_surfaces
    from insole_core.compare.comparison_report import (
        colored_surface,
        draw_picture,
        report_json,
        write_report,
    )
    from insole_core.files.atomic import write_text
    from insole_core.files.transaction import Transaction
    from insole_core.formats.ply import write_ply

    with Transaction() as outputs:
        report, picture, surface, paper = (
            path and outputs.file(path)
            for path in (arguments.report, arguments.picture, arguments.surface, arguments.paper)
        )
        names = visible_line(arguments.a.name), visible_line(arguments.b.name)
        a = _read(arguments.a, progress.part(0.0, 0.2))
        b = _read(arguments.b, progress.part(0.2, 0.4)).like(a)
        _say_notes(arguments.a, a)
        _say_notes(arguments.b, b)
        difference = compare_surfaces(
            a.mesh, b.mesh, _alignment(arguments.align, b),
            median_pixels=arguments.median, progress=progress.part(0.4, 0.9),
        )  # fmt: skip
        difference = replace(difference, feet=(a.measures, b.measures), b_is_mirrored=b.is_mirrored)
        progress.step(0.9, "Writing the report")
        text = json.dumps(report_json(difference), indent=1, allow_nan=False)
        write_text(text + "\n", report)
        if picture:
            draw_picture(difference, picture, names)
        if paper:
            write_report(difference, names, paper)
        if surface:
            write_ply(colored_surface(difference), surface)
    mean, largest = (difference.statistics[key] for key in ("mean_abs", "max"))
    progress.step(1.0, f"Done: {mean:.2f} mm on average, {largest:.2f} mm at most")


def _check_call(arguments: argparse.Namespace) -> None:
    for path, suffix in (
        (arguments.picture, ".png"),
        (arguments.surface, ".ply"),
        (arguments.paper, ".pdf"),
    ):
        if path is not None and path.suffix.lower() != suffix:
            raise UsageError(f"{path} names no file that can be written; let it end in {suffix}.")
    if not 1 <= arguments.median <= 25:
        raise UsageError(f"--median is {arguments.median}, and must be 1 to 25 pixels.")
    if arguments.align not in _ALIGNMENTS and not isinstance(arguments.align, Path):
        raise UsageError(
            f"--align is {arguments.align}; write best, none, dots, or the name of a .json file."
        )


def _word_or_path(text: str) -> str | Path:
    return Path(text) if text.endswith(".json") else text


def _alignment(given: str | Path, b: ComparisonSource) -> Alignment:
    from insole_core.compare.best_fit import read_picked_points

    if isinstance(given, Path):
        return b.points_like(read_picked_points(given))
    return _ALIGNMENTS[given]


def _read(path: Path, progress: Progress) -> ComparisonSource:
    from insole_core.compare.comparison import read_source
    from insole_core.workflows.calibration.correction_choice import is_corrected
    from insole_core.workflows.calibration.repeat_tests import repeated_limits_of

    return read_source(path, progress, is_corrected, repeated_limits_of)


def _say_notes(path: Path, source: ComparisonSource) -> None:
    for note in source.notes:
        print(visible_line(f"{path.name}: {note}"), file=sys.stderr)
