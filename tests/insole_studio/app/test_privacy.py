"""What concerns a patient is readable for its owner only, wherever it is written."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from insole_core.cases.case_record import Patient
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_studio.acquisition.draft import Draft
from insole_studio.app.bootstrap import Application
from insole_studio.user_paths import UserPaths

OTHERS = stat.S_IRWXG | stat.S_IRWXO


@pytest.fixture(autouse=True)
def open_umask() -> Iterator[None]:
    """The widest umask: whatever relies on it is open to everybody."""
    before = os.umask(0)
    yield
    os.umask(before)


def open_to_others(folder: Path) -> list[str]:
    """Name what others may read; locks tell only which program holds them."""
    found = [path for path in folder.rglob("*") if path.lstat().st_mode & OTHERS]
    return [str(path.relative_to(folder)) for path in found if "lock" not in path.name]


@pytest.fixture
def home(tmp_path: Path) -> Path:
    return tmp_path / "home"


@pytest.fixture
def paths(home: Path) -> UserPaths:
    return UserPaths(home / "config" / "settings.json", home / "data" / "autosave")


def test_what_the_window_writes(
    home: Path,
    opened: Application,
    questions: object,
    settle: Callable[[], None],
    export: Callable[[Path], Path],
) -> None:
    out = home / "out"
    out.mkdir(mode=0o700)
    opened.case.apply(Patient(name="Anna"), "Edit")
    opened.autosave.write_now()
    opened.services.save_settings()
    for action, name in [
        ("save_template", "a.insole-template"),
        ("save_measures", "a.csv"),
        ("print_outline", "a.pdf"),
        ("save_as", "a.insole"),
    ]:
        questions.path = out / name  # type: ignore[attr-defined]
        opened.window.actions_by_key[action].trigger()
        settle()
    opened.case.apply(Patient(name="Anna B."), "Edit")
    opened.autosave.write_now()
    assert export(out / "a.stl").is_file()
    written = {path.suffix for path in home.rglob("*")}
    assert {".insole", ".insole-template", ".csv", ".pdf", ".stl", ".json"} <= written
    assert open_to_others(home) == []


def test_sessions_and_drafts(small_session: Path, home: Path) -> None:
    session = read_session(small_session)
    home.mkdir(mode=0o700)
    write_session(session, home / "session")
    write_session(session, home / "session.zip")
    draft = Draft(home / "drafts" / "one", session.manifest, [view.name for view in session.views])
    draft.close()
    assert open_to_others(home) == []


def test_folders_of_an_earlier_version_are_closed(home: Path, paths: UserPaths) -> None:
    for folder in (paths.settings_folder, paths.autosave_folder):
        folder.mkdir(parents=True, mode=0o755)
    paths.make_private()
    assert [stat.S_IMODE(f.stat().st_mode) for f in (paths.settings_folder, paths.data_folder)] == [
        0o700,
        0o700,
    ]
