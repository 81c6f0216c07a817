"""Three clicks on scans as clinics have them: heel, toe and sole decide how the foot lies.

    SCANS=4 TURNS=4 python -m benchmarks scan_clicks

The feet, scans and turns of `scan_import`. Each place is clicked with an error of 4 mm standard
deviation in every direction, as with a mouse; a missing toe is clicked at the front that is there.
Asked for: the side right or doubted, the axis within 3 degrees and the length within 1 % of the
upright foot. A scan without toes has no tip to click, so its length is an estimate.
"""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks._scan_variants import KnownFoot, turned
from benchmarks.scan_import import Result, examine_all, result_of
from insole_core.cases.scan_source import ImportChoice
from insole_core.errors import InsoleError
from insole_core.foot.foot_candidate import PoseClicks
from insole_core.formats.ply import write_ply
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.workflows.import_scan import examine_scan

SIMULATED = int(os.environ.get("SCANS", "4"))
TURNS = int(os.environ.get("TURNS", "4"))
CLICK_SD_MM = 4.0


def main() -> None:
    examine_all(_clicked, SIMULATED, TURNS)


def _clicked(
    known: KnownFoot, mesh: TriangleMesh, rotation: FloatArray, number: int, path: Path
) -> Result:
    rng = np.random.default_rng(number)
    places = _places(mesh) + rng.normal(scale=CLICK_SD_MM, size=(3, 3))
    clicked = turned(replace(mesh, vertices=np.vstack([mesh.vertices, places])), rotation)
    heel, toe, sole = ((float(x), float(y), float(z)) for x, y, z in clicked.vertices[-3:])
    write_ply(turned(mesh, rotation), path)
    try:
        found = examine_scan(path, ImportChoice(pose=PoseClicks(heel, toe, sole)))
    except InsoleError:
        return Result(refused=True)
    return result_of(known, found.feet[0], rotation)


def _places(mesh: TriangleMesh) -> FloatArray:
    """Return the end of the heel, the foremost tip and the sole at the ball, insole frame, mm."""
    points = mesh.vertices
    low = points[points[:, 2] < np.percentile(points[:, 2], 2) + 45]
    ball = low[np.abs(low[:, 1] - 0.68 * np.ptp(low[:, 1])) < 10]
    return np.stack([low[low[:, 1].argmin()], low[low[:, 1].argmax()], ball[ball[:, 2].argmin()]])


if __name__ == "__main__":
    main()
