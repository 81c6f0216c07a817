"""Where no window can be shown, a sentence says why, instead of Qt's end of the process."""

from __future__ import annotations

import subprocess
import sys

import pytest

from insole_studio.app import screen
from insole_studio.app.screen import NoScreenError, check_screen
from insole_studio.cli import window
from insole_studio.cli.main import run

pytestmark = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="other systems always have a screen"
)


@pytest.fixture(autouse=True)
def no_screen(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"):
        monkeypatch.delenv(name, raising=False)


def test_without_a_screen_the_window_does_not_open(capsys: pytest.CaptureFixture[str]) -> None:
    assert run([]) == 1
    assert capsys.readouterr().err.startswith("There is no screen to open a window on")


def test_a_screen_that_does_not_answer_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("DISPLAY", ":4711")
    with pytest.raises(NoScreenError, match="The screen :4711 does not answer"):
        check_screen()


def test_off_screen_nothing_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("QT_QPA_PLATFORM", "offscreen")
    check_screen()


def test_a_library_that_the_system_lacks_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def lacking(*_arguments: object) -> None:
        raise ImportError("libEGL.so.1: cannot open shared object file: No such file or directory")

    monkeypatch.setattr(window, "run", lacking)
    assert run([]) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("The system lacks the library libEGL.so.1; install Insole Studio")


def test_a_library_that_only_the_window_needs_is_named(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def load(_path: str) -> None:
        raise OSError("libxkbcommon-x11.so.0: cannot open shared object file: No such file")

    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(screen.ctypes, "CDLL", load)
    assert run([]) == 1
    assert "lacks the library libxkbcommon-x11.so.0" in capsys.readouterr().err


def test_the_process_ends_with_a_sentence_and_no_core() -> None:
    call = [sys.executable, "-m", "insole_studio"]
    ended = subprocess.run(call, capture_output=True, text=True, check=False)
    assert ended.returncode == 1
    assert ended.stderr.count("\n") == 1
