"""Scans as clinics have them: which foot is found, how it lies, and what is asked.

    SCANS=4 SEED=0 TURNS=24 python -m benchmarks scan_import

Real feet (where the shared data are) and simulated ones: as they are, reduced to 2000 triangles,
cut at three heights, without toes, with a long leg in standing and pointed by 30 and 60 degrees,
without a sole; each turned 24 ways, in turn in millimetres, centimetres, metres, inches, and at no
scale at all, with the foot's length said. Asked for: the side
right or doubted in all, the axis within 3 degrees and the length within 1 % of the upright foot,
no wrong side without a doubt. The two last columns are of the scans that were not doubted.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from benchmarks._measure import print_table
from benchmarks._scan_variants import KnownFoot, known_feet, quarter_turns, turned
from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InsoleError
from insole_core.foot.foot_candidate import FoundFoot
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import rotation_angle_deg
from insole_core.scans.scale import KnownFootLength
from insole_core.workflows.import_scan import examine_scan

SIMULATED = int(os.environ.get("SCANS", "4"))
TURNS = int(os.environ.get("TURNS", "24"))
NO_UNIT = "none"
MM_PER_UNIT = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4, NO_UNIT: 41.7}
MOST_DEG, MOST_SHARE = 3.0, 0.01


@dataclass(frozen=True)
class Result:
    """What was found of one scan."""

    refused: bool
    doubted: bool = False
    right_side: bool = False
    axis_deg: float = 180.0
    length_error: float = 1.0

    @property
    def is_right(self) -> bool:
        placed = self.axis_deg <= MOST_DEG and abs(self.length_error) <= MOST_SHARE
        return self.right_side and placed


Examined = Callable[[KnownFoot, TriangleMesh, FloatArray, int, Path], Result]
"""Examine the scan of a foot, turned by a rotation (3, 3), the how manieth; a file to write."""


def main() -> None:
    examine_all(_found, SIMULATED, TURNS)


def examine_all(examined: Examined, simulated: int, most_turns: int) -> None:
    """Print what is found of all feet, scans and turns."""
    rows, start, count = [], time.process_time(), 0
    turns = list(quarter_turns())[:: max(24 // most_turns, 1)][:most_turns]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scan.ply"
        for known in known_feet(simulated):
            for name, variant in known.variants.items():
                mesh = variant(known.foot)
                results = [
                    examined(known, mesh, rotation, number, path)
                    for number, rotation in enumerate(turns)
                ]
                count += len(results)
                rows.append((known.name, name, *row_of(results)))
    print_table(
        ("foot", "scan", "scans", "right", "doubted", "refused", "wrong side unsaid",
         "worst axis deg", "worst length %"),
        rows,
    )  # fmt: skip
    print(f"{(time.process_time() - start) / count:.2f} s of processor time a scan")


def _found(
    known: KnownFoot, mesh: TriangleMesh, rotation: FloatArray, number: int, path: Path
) -> Result:
    unit = list(MM_PER_UNIT)[number % len(MM_PER_UNIT)]
    scan = turned(mesh, rotation)
    write_ply(replace(scan, vertices=scan.vertices / MM_PER_UNIT[unit]), path)
    known_size = KnownFootLength(known.foot.length_mm) if unit == NO_UNIT else None
    try:
        foot = examine_scan(path, ImportChoice(known_size=known_size)).feet[0]
    except InsoleError:
        return Result(refused=True)
    return result_of(known, foot, rotation)


def result_of(known: KnownFoot, foot: FoundFoot, rotation: FloatArray) -> Result:
    """Hold what was found first against the truth."""
    likely = foot.candidates[0]
    doubted = bool(foot.doubts) or foot.told_side is None
    axis_deg = rotation_angle_deg(likely.source2insole[:3, :3] @ rotation)
    length_error = likely.length_mm / known.foot.length_mm - 1
    return Result(False, doubted, likely.side is known.foot.side, axis_deg, length_error)


def row_of(results: list[Result]) -> tuple[object, ...]:
    """Count results; the columns of axis and length are of the scans that were not doubted."""
    sure = [one for one in results if not one.refused and not one.doubted]
    return (
        len(results),
        sum(one.is_right for one in results),
        sum(one.doubted for one in results),
        sum(one.refused for one in results),
        sum(not one.right_side for one in sure),
        f"{max((one.axis_deg for one in sure), default=0.0):.1f}",
        f"{100 * max((abs(one.length_error) for one in sure), default=0.0):.1f}",
    )


if __name__ == "__main__":
    main()
