"""Where OpenGL is missing or too old, the program says so and offers to draw with the processor."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication, QMessageBox

from insole_studio.app import graphics
from insole_studio.app.bootstrap import Application
from insole_studio.app.graphics import MESA, OF_CARD, Graphics, can_draw, prepare_software_rendering
from insole_studio.settings import load_settings, peek_settings
from insole_studio.user_paths import UserPaths
from tests.patience import PATIENCE_S

PROGRAM = Path(__file__).with_name("drawn_window.py")
RESTART = "Restart with software rendering"
needs_screen = pytest.mark.skipif(
    shutil.which("xvfb-run") is None, reason="needs a virtual screen with GL"
)


def run_broken(folder: Path, button: str, **broken: str) -> int:
    """Run the program on a virtual screen whose OpenGL is broken; return its exit code."""
    wait = 'until [ -e "$0/drawn.txt" ] || [ -e "$0/left" ]; do sleep 0.1; done; sleep 1'
    leave = "" if button == RESTART else 'touch "$0/left";'
    script = f'"$@"; code=$?; {leave} {wait}; exit $code'
    call = ["xvfb-run", "-a", "-s", "-screen 0 800x600x24", "sh", "-c", script, str(folder)]
    environment = {**os.environ, "QT_QPA_PLATFORM": "xcb", "LC_ALL": "C.UTF-8", **broken}
    child = [sys.executable, str(PROGRAM), str(folder), button]
    ended = subprocess.run([*call, *child], env=environment, timeout=PATIENCE_S, check=False)
    return ended.returncode


@needs_screen
@pytest.mark.slow
def test_missing_graphics_are_told_and_the_restarted_program_draws(tmp_path: Path) -> None:
    assert run_broken(tmp_path, RESTART, LIBGL_DRIVERS_PATH="nowhere") == 3
    asked = (tmp_path / "asked.txt").read_text(encoding="utf-8")
    assert "this computer has no OpenGL" in asked
    assert "llvmpipe" in (tmp_path / "drawn.txt").read_text(encoding="utf-8")
    assert peek_settings(tmp_path / "settings.json").software_rendering


@needs_screen
@pytest.mark.slow
def test_old_graphics_are_told_and_can_be_left_as_they_are(tmp_path: Path) -> None:
    assert run_broken(tmp_path, "Quit", MESA_GL_VERSION_OVERRIDE="1.4") == 3
    asked = (tmp_path / "asked.txt").read_text(encoding="utf-8")
    assert "they need OpenGL 3.2, and this is 1.4" in asked
    assert not (tmp_path / "drawn.txt").exists()
    assert not (tmp_path / "settings.json").exists()


@pytest.mark.parametrize("version", [None, (2, 1)])
def test_nothing_more_is_offered_once_the_processor_draws(
    qapp: QApplication,
    paths: UserPaths,
    monkeypatch: pytest.MonkeyPatch,
    version: tuple[int, int] | None,
) -> None:
    buttons: list[str] = []

    def answer(box: QMessageBox) -> int:
        buttons.extend(button.text() for button in box.buttons())
        return 0

    monkeypatch.setattr(graphics, "has_gl", lambda: True)
    monkeypatch.setattr(graphics, "examine_graphics", lambda _: Graphics(version))
    monkeypatch.setattr(QMessageBox, "exec", answer)
    assert not can_draw(qapp, paths, is_software=True)
    assert sorted(buttons) == ["Quit", "Start all the same"]


@pytest.mark.skipif(sys.platform != "linux", reason="Mesa's variables")
def test_the_choice_is_remembered_and_reversible(
    app: Application, paths: UserPaths, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in (*MESA, *OF_CARD):
        monkeypatch.setenv(name, "broken")
    action = app.window.actions_by_key["software_rendering"]
    assert not action.isChecked()
    assert not prepare_software_rendering(paths)
    action.trigger()
    assert load_settings(paths.settings_file).software_rendering
    assert prepare_software_rendering(paths)
    assert {name: os.environ.get(name) for name in MESA} == MESA
    assert not set(OF_CARD).intersection(os.environ)
    action.trigger()
    assert not prepare_software_rendering(paths)


def test_damaged_settings_are_read_without_a_word_and_left(paths: UserPaths) -> None:
    paths.settings_file.parent.mkdir(parents=True)
    paths.settings_file.write_text(json.dumps({"software_rendering": "yes"}), encoding="utf-8")
    assert not peek_settings(paths.settings_file).software_rendering
    assert [path.name for path in paths.settings_file.parent.iterdir()] == ["settings.json"]
