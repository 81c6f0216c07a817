"""A session gives the same foot, however many threads the environment asks for."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from insole_studio.__main__ import LINEAR_ALGEBRA_THREADS
from insole_studio.cli.main import run

MANY = dict.fromkeys(LINEAR_ALGEBRA_THREADS, "4") | {"OMP_NUM_THREADS": "3"}


@pytest.mark.slow
def test_threads_in_the_environment_leave_the_mesh_as_it_is(
    small_session: Path, tmp_path: Path
) -> None:
    call = ["reconstruct", str(small_session), "--out"]
    usual, many = tmp_path / "usual.ply", tmp_path / "many.ply"
    assert run([*call, str(usual)]) == 0
    command = [sys.executable, "-m", "insole_studio", *call, str(many)]
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, **MANY})
    assert usual.stat().st_size > 100_000
    assert many.read_bytes() == usual.read_bytes()
