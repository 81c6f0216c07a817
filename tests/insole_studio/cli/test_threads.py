"""A session gives the same foot, however many threads the environment asks for."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from insole_studio.__main__ import LINEAR_ALGEBRA_THREADS

ENVIRONMENTS: tuple[dict[str, str], ...] = (
    {},
    dict.fromkeys(LINEAR_ALGEBRA_THREADS, "4") | {"OMP_NUM_THREADS": "3"},
)


def foot_of(session: Path, foot: Path, threads: dict[str, str]) -> bytes:
    """The fused mesh that the command writes when the environment asks for these threads."""
    others = {name: v for name, v in os.environ.items() if name not in LINEAR_ALGEBRA_THREADS}
    command = [sys.executable, "-m", "insole_studio", "reconstruct", str(session), "--out"]
    subprocess.run(
        [*command, str(foot)], check=True, capture_output=True, env={**others, **threads}
    )
    return foot.read_bytes()


@pytest.mark.slow
def test_threads_in_the_environment_leave_the_mesh_as_it_is(
    small_session: Path, tmp_path: Path
) -> None:
    feet = [
        foot_of(small_session, tmp_path / f"{index}.ply", threads)
        for index, threads in enumerate(ENVIRONMENTS)
    ]
    assert len(feet[0]) > 100_000
    assert [foot == feet[0] for foot in feet] == [True] * len(feet)
