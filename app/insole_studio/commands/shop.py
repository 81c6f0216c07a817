"""What `insole-studio design` hands to the shop: the solid, checked, with its papers."""

from __future__ import annotations

import argparse
import getpass
import json
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from insole_core.errors import UsageError
from insole_core.progress import Progress

if TYPE_CHECKING:
    from insole_core.geometry.mesh import TriangleMesh
    from insole_core.insole.build import Insole
    from insole_core.solids.checks import Finding
    from insole_core.solids.rules import CheckName

_CHECKS_OF: dict[str, tuple[CheckName, ...]] = {
    "insole": ("watertight", "thickness", "cutter", "undercut", "step", "block", "shoe_height"),
    "block": ("watertight", "thickness", "cutter", "step", "block"),
    "positive": ("watertight", "undercut"),
}


@dataclass(frozen=True)
class Outputs:
    """Where to write, beside the final places; None for what is not wanted."""

    solid: Path
    checks: Path | None
    sheet: Path | None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare how the solid is made and what comes with it."""
    shape = parser.add_argument_group("make")
    shape.add_argument("--draft", type=float, default=3.0, metavar="DEG", help="lean of the walls")
    shape.add_argument("--chamfer", type=float, default=0.0, metavar="MM", help="bevel of the rim")
    shape.add_argument("--mark", metavar="TEXT", help="engrave this into the flat bottom")
    shape.add_argument("--triangles", type=int, metavar="N", help="at most so many triangles")
    shape.add_argument(
        "--deviation", type=float, default=0.05, metavar="MM", help="for --triangles"
    )
    shape.add_argument("--ascii", action="store_true", help="STL as text")
    papers = parser.add_argument_group("checks and papers")
    papers.add_argument("--rules", type=Path, metavar="rules.json", help="of the clinic and shop")
    papers.add_argument("--checks", type=Path, metavar="checks.json", help="outcome of the checks")
    papers.add_argument("--job-sheet", type=Path, metavar="sheet.pdf")
    papers.add_argument("--override", metavar="REASON", help="let pass what a rule would stop")


@contextmanager
def outputs(arguments: argparse.Namespace) -> Iterator[Outputs]:
    """Open every place before the work begins; nothing stays if it fails."""
    from insole_core.export.atomic import replacing_file

    if arguments.job_sheet is not None and arguments.job_sheet.suffix.lower() != ".pdf":
        raise UsageError(f"--job-sheet is {arguments.job_sheet}, but it is written as .pdf.")
    with ExitStack() as stack:
        yield Outputs(
            *(
                path and stack.enter_context(replacing_file(path))
                for path in (arguments.out, arguments.checks, arguments.job_sheet)
            )
        )


def deliver(
    insole: Insole, arguments: argparse.Namespace, paths: Outputs, progress: Progress
) -> None:
    """Make the solid, check it, and write everything that is wanted."""
    from insole_core.export.solid_file import write_solids
    from insole_core.export.three_mf import Part

    solid = _solid(insole, arguments, progress.part(0.0, 0.4))
    findings, record = _checked(solid, arguments, progress.part(0.4, 0.8))
    progress.step(0.8, f"Writing the {arguments.kind}")
    name = f"{insole.design.side} {arguments.kind}"
    write_solids([Part(solid, name)], paths.solid, ascii_stl=arguments.ascii)
    if paths.checks:
        text = json.dumps(record, indent=1, ensure_ascii=False)
        paths.checks.write_text(text + "\n", encoding="utf-8")
    if paths.sheet:
        _write_sheet(insole, solid, findings, arguments, paths)


def _solid(insole: Insole, arguments: argparse.Namespace, progress: Progress) -> TriangleMesh:
    from insole_core.solids.marking import mark
    from insole_core.solids.simplification import simplify
    from insole_core.solids.solid import SolidOptions, make_solid

    options = SolidOptions(draft_deg=arguments.draft, chamfer_mm=arguments.chamfer)
    solid = make_solid(insole, arguments.kind, options, progress)
    if arguments.mark:
        progress.step(0.4, "Engraving")
        lines = tuple(arguments.mark.split("\\n"))
        # Under the heel, where the bottom is wide and whole for every foot.
        length = insole.foot.length_mm
        sign = -1.0 if arguments.kind == "positive" else 1.0
        x = sign * float(insole.contact.x_mm.mean())
        solid = mark(solid, lines, centre_mm=(x, 0.35 * length), room_mm=(30.0, 0.5 * length))
    if arguments.triangles:
        progress.step(0.6, "Reducing the triangles")
        simple = simplify(solid, arguments.triangles, arguments.deviation)
        solid = simple.mesh
        print(
            f"{len(solid.triangles)} triangles; they deviate by {simple.deviation_mm:.3f} mm"
            " at most.",
            file=sys.stderr,
        )
    return solid


def _checked(
    solid: TriangleMesh, arguments: argparse.Namespace, progress: Progress
) -> tuple[tuple[Finding, ...], dict[str, Any]]:
    from insole_core.solids.checks import Override, check_solid, require_export
    from insole_core.solids.rules import read_rules

    rules = read_rules(arguments.rules).only(_CHECKS_OF[arguments.kind])
    findings = check_solid(solid, rules, progress)
    for finding in findings:
        if not finding.passed:
            print(f"Warning: {finding.sentence}", file=sys.stderr)
    now = datetime.now(UTC).isoformat(timespec="seconds")
    override = arguments.override and Override(getpass.getuser(), arguments.override, now)
    return findings, require_export(findings, override or None)


def _write_sheet(
    insole: Insole,
    solid: TriangleMesh,
    findings: tuple[Finding, ...],
    arguments: argparse.Namespace,
    paths: Outputs,
) -> None:
    from insole_core.export.paper import JobSheet, section_along, write_job_sheet
    from insole_core.solids.checks import survey_heights

    assert paths.sheet is not None
    top, bottom = survey_heights(solid)
    length, width, height = (solid.bounds_mm[1] - solid.bounds_mm[0])[[1, 0, 2]]
    design = insole.design
    sheet = JobSheet(
        identification={
            "side": str(design.side), "kind": arguments.kind,
            "mark": arguments.mark or "–", "date": datetime.now(UTC).date().isoformat(),
        },
        measures={
            "length × width × height": f"{length:.1f} × {width:.1f} × {height:.1f} mm",
            "volume": f"{solid.volume_mm3 / 1000:.1f} cm³",
            "triangles": str(len(solid.triangles)),
        },
        make={
            "least thickness": f"{design.least_thickness_mm:g} mm",
            "bottom": design.bottom,
            "draft of the walls": f"{arguments.draft:g}°",
        },
        sections=tuple(
            section_along(top, bottom, 1.0, share=share, across=across)
            for share, across in ((0.5, False), (0.12, True), (0.5, True), (0.72, True))
        ),
        checks=tuple(f"{'✓' if f.passed else '✗'} {f.sentence}" for f in findings),
        file=paths.solid,
        file_name=arguments.out.name,
        height_map_mm=top,
    )  # fmt: skip
    write_job_sheet(sheet, paths.sheet)
