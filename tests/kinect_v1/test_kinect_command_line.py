"""``python -m kinect_v1`` on the emulated bus."""

from __future__ import annotations

import json
import re
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from kinect_samples import SERIALS, Images

from kinect_v1.__main__ import main
from kinect_v1.errors import LibusbMissingError
from kinect_v1.recordings import read_depth, read_received, read_recording
from kinect_v1.usb_bus import UsbBus
from tests.patience import PATIENCE_S, wait_for

AS_IN_A_TERMINAL = """
import runpy, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
signal.signal(signal.SIGHUP, signal.SIG_DFL)
runpy.run_module("kinect_v1", run_name="__main__", alter_sys=True)
"""
"""Tests may run in the background or by nohup, where Ctrl+C or a hang-up is ignored."""

Output = pytest.CaptureFixture[str]


def is_one_of(image: np.ndarray, sent: list[np.ndarray]) -> bool:
    return any(np.array_equal(image, other) for other in sent)


def test_list_names_every_sensor(bus: UsbBus, capsys: Output) -> None:
    assert main(["list"], lambda: bus) == 0
    lines = [line.split("\t") for line in capsys.readouterr().out.splitlines()]
    assert lines == [
        [SERIALS[0], "1414", "1-1.1", "ready"],
        [SERIALS[1], "1473", "2-1.1", "ready"],
        [SERIALS[2], "K4W", "3-1.1", "ready"],
    ]


def test_info_is_json(bus: UsbBus, capsys: Output) -> None:
    assert main(["info", "--serial", SERIALS[1]], lambda: bus) == 0
    info = json.loads(capsys.readouterr().out)
    assert (info["model"], info["serial"]) == ("1473", SERIALS[1])
    assert set(info["calibration"]) == {"zero_plane", "registration", "padding", "constant_shift"}


@pytest.mark.parametrize(
    ("color", "kind", "mode"),
    [
        ("640x480", "b", "bayer-640x480"),
        ("1280x1024", "b", "bayer-1280x1024"),
        ("ir", "i", "ir-640x488"),
    ],
)
def test_record_keeps_frames_exactly(
    color: str, kind: str, mode: str, bus: UsbBus, tmp_path: Path, images: Images
) -> None:
    folder = tmp_path / "taken"
    command = ["record", str(folder), "--serial", SERIALS[0], "--frames", "4", "--color", color]
    assert main(command, lambda: bus) == 0
    recording = read_recording(folder)
    depth = [read_depth(file) for file in recording.of_kind("d")]
    assert len(depth) == 4
    pictures = [read_received(file) for file in recording.of_kind(kind)]
    assert pictures
    assert all(is_one_of(image, images[SERIALS[0]]["depth-11"]) for image in depth)
    assert all(is_one_of(image, images[SERIALS[0]][mode]) for image in pictures)
    assert len(recording.of_kind("a")) == 1


def test_record_without_colour(bus: UsbBus, tmp_path: Path) -> None:
    folder = tmp_path / "taken"
    command = ["record", str(folder), "--serial", SERIALS[2], "--color", "none"]
    assert main(command, lambda: bus) == 0
    assert [len(read_recording(folder).of_kind(kind)) for kind in "drb"] == [10, 0, 0]


def test_a_recording_can_be_viewed_as_a_sensor(
    bus: UsbBus, tmp_path: Path, capsys: Output, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "taken"
    main(["record", str(folder), "--serial", SERIALS[0], "--frames", "2"], lambda: bus)
    monkeypatch.setenv("COLUMNS", "61")
    monkeypatch.setenv("LINES", "20")
    capsys.readouterr()
    assert main(["--emulate", str(folder), "view", "--frames", "2"]) == 0
    lines = capsys.readouterr().out.split("\x1b[H")[-1].splitlines()
    assert [line.count("▀") for line in lines[:-1]] == [2 * 29] * 10
    assert "discarded=0" in lines[-1]


def test_errors_are_one_sentence_and_exit_code_one(bus: UsbBus, capsys: Output) -> None:
    assert main(["info"], lambda: bus) == 1
    error = capsys.readouterr().err
    assert error.startswith("Several sensors are plugged in; choose one of:")
    assert error.count("\n") == 1


def test_a_missing_libusb_is_said(capsys: Output) -> None:
    def no_libusb() -> UsbBus:
        raise LibusbMissingError("libusb is missing on this computer; install libusb-1.0.")

    assert main(["list"], no_libusb) == 1
    assert "install libusb-1.0" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        ([], 0, ""),  # the only end of an endless view
        (["--frames", "9"], 130, "Stopped on request; nothing was written.\n"),
    ],
)
def test_ctrl_c_ends_a_view(
    bus: UsbBus, monkeypatch: pytest.MonkeyPatch, capsys: Output,
    options: list[str], code: int, said: str,
) -> None:  # fmt: skip
    def interrupt(*_arguments: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("kinect_v1.__main__.color_picture", interrupt)
    assert main(["view", "--serial", SERIALS[0], *options], lambda: bus) == code
    assert capsys.readouterr().err == said


@pytest.mark.parametrize("name", ["SIGINT", "SIGTERM", "SIGHUP"])
def test_a_stopped_recording_says_what_was_discarded(
    name: str, bus: UsbBus, tmp_path: Path
) -> None:
    played = tmp_path / "played"
    main(["record", str(played), "--serial", SERIALS[0], "--frames", "2"], lambda: bus)
    target = tmp_path / "taken"
    command = ["--emulate", str(played), "record", str(target), "--frames", "100000"]
    with subprocess.Popen(
        [sys.executable, "-c", AS_IN_A_TERMINAL, *command], stderr=subprocess.PIPE, text=True
    ) as process:
        wait_for(lambda: process.poll() is not None or list(tmp_path.glob(".taken.*/d-*")))
        process.send_signal(getattr(signal, name))
        _out, said = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + getattr(signal, name)
    assert re.fullmatch(
        rf"Stopped on request; \d+ of 100000 depth frames had come and are discarded, and "
        rf"{re.escape(str(target))} was not written\.\n",
        said,
    )
    assert [path.name for path in tmp_path.iterdir()] == ["played"]


@pytest.mark.parametrize(
    ("name", "code"), [("SIGINT", 0), ("SIGTERM", 128 + 15), ("SIGHUP", 128 + 1)]
)
def test_only_ctrl_c_is_the_usual_end_of_a_view(
    name: str, code: int, bus: UsbBus, tmp_path: Path
) -> None:
    played = tmp_path / "played"
    main(["record", str(played), "--serial", SERIALS[0], "--frames", "2"], lambda: bus)
    command = [sys.executable, "-c", AS_IN_A_TERMINAL, "--emulate", str(played), "view"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdout is not None
        process.stdout.read(1)
        process.send_signal(getattr(signal, name))
        process.communicate(timeout=PATIENCE_S)
    assert process.returncode == code


def test_nohup_is_heeded(bus: UsbBus, tmp_path: Path) -> None:
    played, target = tmp_path / "played", tmp_path / "taken"
    main(["record", str(played), "--serial", SERIALS[0], "--frames", "2"], lambda: bus)
    program = [sys.executable, "-m", "kinect_v1", "--emulate", str(played)]
    command = ["nohup", *program, "record", str(target), "--frames", "60"]
    with subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, cwd=tmp_path
    ) as process:
        wait_for(lambda: process.poll() is not None or list(tmp_path.glob(".taken.*/d-*")))
        process.send_signal(signal.SIGHUP)
        assert process.wait(timeout=PATIENCE_S) == 0
    assert target.is_dir()


def test_a_wrong_call_is_exit_code_two(bus: UsbBus, tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(["record", str(tmp_path), "--frames", "0"], lambda: bus)
