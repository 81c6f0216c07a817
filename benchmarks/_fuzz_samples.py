"""Sound files of every kind that the product reads: what the fuzz program damages."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks._fuzz_mutations import entries_of
from insole_core.cases.case_file import read_case, write_case
from insole_core.cases.case_record import Annotations, CaseRecord, FootRecord, KeyPoint
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.foot.foot_placement import place_foot
from insole_core.foot.landmarks import find_landmarks
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.elements import CORRECTION_TYPES
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_to_json
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.template import make_template, template_to_json
from insole_core.resources import resource_path
from insole_core.simulate.foot_model import build_foot
from insole_core.simulate.foot_shape import FootShape

DATA = Path(__file__).parents[1] / "tests" / "data"
SESSION = (DATA / "sessions" / "left_small.zip").read_bytes()
CASES = {n: (DATA / "cases" / f"version_{n}.insole").read_bytes() for n in (1, 2)}


@cache
def foot_mesh() -> TriangleMesh:
    """Return a left foot of 245 mm, reference frame, closed, of some thousand triangles."""
    return build_foot(FootShape(side=Side.LEFT), np.random.default_rng(1), cell_mm=4.0).mesh


@cache
def foot() -> Foot:
    return place_foot(foot_mesh(), Side.LEFT, frame="reference")


@cache
def design() -> InsoleDesign:
    """Return a design with a correction of every type and a grid that is quick."""
    given: dict[str, dict[str, Any]] = {
        "pelott": {
            "centre_mm": (5.0, 150.0),
            "length_mm": 60.0,
            "width_mm": 40.0,
            "height_mm": 4.0,
        },
        "posting": {"rearfoot_deg": 4.0, "forefoot_deg": 0.0},
        "brush": {"points_mm": ((0.0, 60.0), (5.0, 70.0)), "radius_mm": 12.0, "strength": 0.5},
    }
    corrections = []
    for name, kind in CORRECTION_TYPES.items():
        try:
            corrections.append(kind(**given.get(name, {})))
        except TypeError:  # it asks for values that every design of this type must have
            corrections.append(kind(**{**_usual(kind), **given.get(name, {})}))
    return InsoleDesign(Side.LEFT, tuple(corrections), grid_mm=2.0, outline=Outline())


def _usual(kind: type[Any]) -> dict[str, Any]:
    from insole_core.insole.fields import choices_of, ranges_of

    numbers = {
        key: (allowed.least + allowed.greatest) / 2
        for key, allowed in ranges_of(kind).items()
        if not key.endswith("s_mm")
    }
    return numbers | {key: words[0] for key, words in choices_of(kind).items()}


def design_values() -> Any:
    return json.loads(json.dumps(design_to_json(design())))


def case_bytes(folder: Path) -> bytes:
    """Return a case of one foot with annotations and two variants."""
    record = FootRecord.begun(foot(), ScanSource("mesh", "foot.ply", "0" * 64), design())
    marks = Annotations((KeyPoint("apex", (1.0, 2.0, 3.0)),))
    path = folder / "case.insole"
    write_case(CaseRecord.of_foot(replace(record, annotations=marks)), path)
    read_case(path)
    return path.read_bytes()


def session_values(name: str) -> Any:
    return json.loads(dict(entries_of(SESSION))[name])


def template_values() -> Any:
    template = make_template("usual", design(), find_landmarks(foot()))
    return json.loads(json.dumps(template_to_json(template)))


def resource_values(name: str) -> Any:
    return json.loads(resource_path(name).read_text(encoding="utf-8"))


def device_values() -> Any:
    from kinect_v1.emulation.playback import TYPICAL_CALIBRATION
    from kinect_v1.recordings import _encode_calibration

    values = {"serial": "A1", "model": "1414", **_encode_calibration(TYPICAL_CALIBRATION)}
    return json.loads(json.dumps(values))
