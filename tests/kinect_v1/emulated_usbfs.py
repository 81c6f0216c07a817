"""Runs clients of the real libusb on an emulated usbfs; needs umockdev (Debian: umockdev,
gir1.2-umockdev-1.0, python3-gi).
"""

from __future__ import annotations

import ctypes.util
import functools
import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from kinect_samples import Footage, make_calibration

from kinect_v1.models import Model
from tests.patience import PATIENCE_S

HERE = Path(__file__).resolve().parent
PRELOAD = "libumockdev-preload.so.0"
SYSTEM_PYTHON = "/usr/bin/python3"


@functools.cache
def missing() -> str | None:
    """Tell what is absent, for the skip's reason."""
    if sys.platform != "linux":
        return "umockdev emulates Linux only"
    check = "import gi; gi.require_version('UMockdev', '1.0'); from gi.repository import UMockdev"
    command = [SYSTEM_PYTHON, "-c", check]
    if not Path(SYSTEM_PYTHON).exists() or subprocess.call(command, stderr=subprocess.DEVNULL):
        return "umockdev is absent (apt install umockdev gir1.2-umockdev-1.0 python3-gi)"
    return None


@functools.cache
def missing_libfreenect() -> str | None:
    """Tell whether Debian's libfreenect is absent."""
    absent = "libfreenect is absent (apt install libfreenect-bin libfreenect0.5)"
    return missing() or (None if ctypes.util.find_library("freenect") else absent)


def require_usbfs() -> None:
    """Skip, by name, where the bus cannot be emulated."""
    reason = missing()
    if reason:
        pytest.skip(reason)


def require_libfreenect() -> None:
    """Skip, by name, where the independent witness is absent."""
    reason = missing_libfreenect()
    if reason:
        pytest.skip(reason)


def describe_kinect(
    folder: Path,
    model: Model,
    serial: str,
    footage: Footage,
    *,
    seed: int = 0,
    controller: int = 1,
    **more: Any,
) -> dict[str, Any]:
    """Write a sensor's footage to files; give its part of a scenario."""
    files: dict[str, list[str]] = {}
    for mode, frames in footage.get(serial, {}).items():
        for number, frame in enumerate(frames):
            file = folder / "sent" / f"{serial}-{mode}-{number}"
            file.parent.mkdir(exist_ok=True)
            file.write_bytes(frame)
            files.setdefault(mode, []).append(str(file))
    return {
        "model": model.value,
        "serial": serial,
        "controller": controller,
        "calibration": make_calibration(seed).as_dict(),
        "footage": files,
        **more,
    }


class EmulatedUsbfs:
    """A running emulator."""

    def __init__(self, server: subprocess.Popen[str], root: str) -> None:
        self._server = server
        self._environment = {**os.environ, "LD_PRELOAD": PRELOAD, "UMOCKDEV_DIR": root}

    def tell(self, verb: str, serial: str) -> None:
        """Plug a sensor in, unplug it, or end the hold of a killed program on it."""
        assert self._server.stdin
        assert self._server.stdout
        self._server.stdin.write(f"{verb} {serial}\n")
        self._server.stdin.flush()
        assert self._server.stdout.readline() == "done\n"

    def run(self, *command: str | Path) -> subprocess.CompletedProcess[str]:
        """Run a program on this bus until it ends."""
        return subprocess.run(
            [str(word) for word in command],
            env=self._environment,
            capture_output=True,
            text=True,
            timeout=PATIENCE_S,
            check=False,
        )

    def start(self, *command: str | Path) -> subprocess.Popen[str]:
        """Start a program on this bus and talk to it."""
        return subprocess.Popen(
            [str(word) for word in command],
            env=self._environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )


@contextmanager
def emulated_usbfs(folder: Path, *kinects: dict[str, Any]) -> Iterator[EmulatedUsbfs]:
    """Emulate a bus with these sensors."""
    scenario = folder / "scenario.json"
    scenario.write_text(json.dumps({"kinects": kinects}), encoding="utf-8")
    paths = [str(HERE.parents[1] / "drivers" / "kinect"), str(HERE)]
    environment = {**os.environ, "LD_PRELOAD": PRELOAD, "PYTHONPATH": os.pathsep.join(paths)}
    with subprocess.Popen(
        [SYSTEM_PYTHON, str(HERE / "usbfs_server.py"), str(scenario)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    ) as server:
        try:
            assert server.stdout
            root = server.stdout.readline().strip()
            assert root, "the emulator did not start"
            yield EmulatedUsbfs(server, root)
        finally:
            assert server.stdin
            server.stdin.close()
            try:
                server.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                server.kill()
