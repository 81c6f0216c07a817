"""Every printed command line that makes files of files, run as it stands beside what it names.

Those with placeholders in capitals, those of the clinic's record (which ask for passwords, and have
tests of their own) and those for sensors are left out, and counted. Failures must be 0.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from benchmarks._fuzz_samples import DATA, case_bytes, design_values, foot_mesh
from benchmarks._measure import print_table
from benchmarks._printed_commands import Printed, printed_commands
from insole_core.formats.obj import write_obj
from insole_core.formats.ply import write_ply
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.recording.writer import write_session
from insole_core.resources import resource_path
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.foot_shape import FootShape
from insole_core.simulate.known_bodies import KnownBody, ball

_PLACEHOLDER = re.compile(r"\b(FOLDER|SESSION|SCAN|FOOT|CASE|MAP|PERSON|SERIAL|OUT)\b")
_OTHERS = ("records", "calibrate", "capture", "sensors", "self-test", "doctor", "open")
_BALL = ball(408 / np.pi)
"""By the circumference that the manual gives."""


def main() -> None:
    counts: Counter[tuple[str, str]] = Counter()
    with tempfile.TemporaryDirectory() as name:
        given = Path(name) / "given"
        given.mkdir()
        prepare(given)
        commands = printed_commands()
        for page in dict.fromkeys(one.page for one in commands):
            folder = Path(name) / page.replace("/", "_")
            shutil.copytree(given, folder)
            for one in commands:
                if one.page == page and one.in_block:
                    counts[page, _outcome(one, folder)] += 1
            shutil.rmtree(folder)
    pages = dict.fromkeys(page for page, _ in counts)
    kinds = ("ran", "failed", "left out")
    rows = [[page, *(counts[page, kind] for kind in kinds)] for page in pages]
    total = [sum(counts[page, kind] for page in pages) for kind in kinds]
    print_table(["page", *kinds], [*rows, ["all", *total]])
    if total[1]:
        raise SystemExit(1)


def _outcome(one: Printed, folder: Path) -> str:
    if one.is_synopsis or one.words[0] in _OTHERS or _PLACEHOLDER.search(one.text):
        return "left out"
    environment = {**os.environ, "HOME": str(folder), "XDG_DATA_HOME": str(folder / "data")}
    call = [sys.executable, "-m", "insole_studio", *one.words]
    done = subprocess.run(
        call, check=False, cwd=folder, env=environment, capture_output=True, text=True
    )
    if done.returncode:
        print(f"{one.page}: {one.text}\n  {done.stderr.strip().splitlines()[-1]}", flush=True)
    return "failed" if done.returncode else "ran"


def prepare(folder: Path) -> None:
    """Write what the command lines name and do not make themselves."""
    mesh = foot_mesh()
    write_obj(mesh.mirrored(), folder / "scan.obj")
    for name in ("scan", "foot", "left"):
        write_ply(mesh, folder / f"{name}.ply")
    write_ply(mesh.mirrored(), folder / "right.ply")
    shutil.copy(DATA / "sessions" / "left_small.zip", folder / "demo.zip")
    shutil.copy(DATA / "sessions" / "both_small.zip", folder / "both.zip")
    (folder / "design.json").write_text(json.dumps(design_values()))
    shutil.copy(resource_path("rules/materials.json"), folder / "shop.json")
    zones = {"format": "insole-zones", "version": 1, "preset": "TPU, Shore 85", "zones": []}
    (folder / "zones.json").write_text(json.dumps(zones))
    for name in ("anna", "bo", "case"):
        (folder / f"{name}.insole").write_bytes(case_bytes(folder))
    captured(folder, ("ball1", "ball2", "ball3"), ("boll1", "boll2", "boll3"), _BALL)
    captured(folder, ("cast1", "cast2"), ("gips1", "gips2"), None)


def captured(
    folder: Path, names: Sequence[str], swedish: Sequence[str], body: KnownBody | None
) -> None:
    """Write sessions of the same sensors, of a body or of the foot that stands for a cast."""
    shape = FootShape(side=Side.LEFT) if body is None else None
    for seed, (name, other) in enumerate(zip(names, swedish, strict=True)):
        options = SimulationOptions(
            seed=seed, sensor_seed=0, body=body, shape=shape, frames=3, color_size=(640, 480)
        )
        simulated = simulate_session(options)
        write_session(simulated.session, folder / name)
        shutil.copytree(folder / name, folder / other)
        if body is None:
            for scan in ("cast.stl", "gips.stl"):
                write_stl(simulated.truth, folder / scan)
