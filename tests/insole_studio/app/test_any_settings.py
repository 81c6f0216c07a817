"""Whatever lies in the folders of the user, the window starts, and says what it set aside."""

from __future__ import annotations

import base64
import json
import os
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import fields
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PySide6.QtCore import QTimer
from PySide6.QtWidgets import QApplication

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.solids.shop import read_shop
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import OrderChoice
from insole_studio.app.bootstrap import run_application
from insole_studio.app.main_window import MainWindow
from insole_studio.document.journal import find_recovered
from insole_studio.features.export.order_form import OrderForm, Stock
from insole_studio.settings import Settings, load_settings, save_settings
from insole_studio.user_paths import UserPaths
from insole_studio.widgets.message_label import ErrorDialog

LOOK_MS = 300
HUGE = "9" * 400
ANYTHING = st.recursive(
    st.none()
    | st.booleans()
    | st.integers()
    | st.sampled_from([10**400, -(10**400), 1e308, -1.0, 0])
    | st.floats()
    | st.text(st.characters(), max_size=30)
    | st.sampled_from(["\ud800", "\0", "x" * 5000, "../..", "dark", "<img src=x>", ".exe"]),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner),
    max_leaves=8,
)


def entries_of(names: list[str]) -> st.SearchStrategy[bytes]:
    """Files that hold some known entries with any values, or any bytes."""
    known = st.dictionaries(st.sampled_from(names), ANYTHING)
    return known.map(lambda entries: json.dumps(entries).encode()) | st.binary(max_size=60)


SETTINGS = entries_of(list(vars(Settings())))
ORDERS = entries_of([field.name for field in fields(OrderChoice)])
ORIGINS = entries_of(["path", "digest"])


class Started:
    """What a start of the window showed."""

    title = ""
    sentences = ""

    def look(self) -> None:
        for widget in QApplication.topLevelWidgets():
            if isinstance(widget, ErrorDialog):
                self.sentences += widget.text()
                widget.done(0)
            if isinstance(widget, MainWindow):
                self.title = widget.windowTitle()
                widget.close_for_good()


@pytest.fixture
def start(qapp: QApplication) -> Iterator[Callable[[UserPaths], Started]]:
    hook = sys.excepthook
    unexpected: list[BaseException] = []

    def run(paths: UserPaths) -> Started:
        shown = Started()

        def look() -> None:
            try:
                shown.look()
            finally:
                qapp.quit()

        QTimer.singleShot(LOOK_MS, qapp, look)
        assert run_application([], paths) == 0
        assert shown.title
        assert unexpected == []
        return shown

    sys.excepthook = lambda _kind, error, _trace: unexpected.append(error)
    yield run
    sys.excepthook = hook


def in_folder(folder: Path) -> UserPaths:
    paths = UserPaths(folder / "config" / "settings.json", folder / "data" / "autosave")
    paths.settings_folder.mkdir(parents=True)
    paths.autosave_folder.mkdir(parents=True)
    return paths


@pytest.mark.slow
@settings(
    max_examples=8, suppress_health_check=[HealthCheck.function_scoped_fixture], derandomize=True
)
@given(stored=SETTINGS, origin=ORIGINS, copy=st.binary(max_size=40) | st.none())
def test_the_window_starts_whatever_is_stored(
    start: Callable[[UserPaths], Started], stored: bytes, origin: bytes, copy: bytes | None
) -> None:
    with tempfile.TemporaryDirectory() as folder:
        paths = in_folder(Path(folder))
        paths.settings_file.write_bytes(stored)
        (paths.autosave_folder / "abc.json").write_bytes(origin)
        left = paths.autosave_folder / "abc.insole"
        if copy is None:
            write_case(CaseRecord(Patient(name="Anna")), left)
        else:
            left.write_bytes(copy)
        shown = start(paths)
        assert ("abc.insole" in shown.sentences) is (copy is not None)


@settings(
    max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture], derandomize=True
)
@given(stored=SETTINGS)
def test_settings_are_of_their_types_and_a_broken_file_is_kept(stored: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "settings.json"
        path.write_bytes(stored)
        complaints: list[str] = []
        loaded = load_settings(path, complaints.append)
        assert [type(value) for value in vars(loaded).values()] == [
            type(value) for value in vars(Settings()).values()
        ] or isinstance(loaded.largest_residual_mm, int | float)
        kept = [p.read_bytes() for p in Path(folder).iterdir() if p.name != "settings.json"]
        assert kept == [stored] * len(complaints)
        assert all("settings.json.broken-1" in sentence for sentence in complaints)
        save_settings(loaded, path)
        assert load_settings(path, complaints.append) == loaded
        assert len(complaints) == len(kept)


@settings(
    max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture], derandomize=True
)
@given(stored=ORDERS)
def test_the_form_shows_any_last_order(qapp: QApplication, stored: bytes) -> None:
    shop = read_shop()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "order.json"
        path.write_bytes(stored)
        choice = LastOrder(path, shop).load()
    form = OrderForm(Stock(shop.blocks, shop.materials))
    form.show_choice(choice, has_pair=True)
    assert form.choice().kind in ("insole", "block", "positive")
    assert form.choice().suffix == choice.suffix
    form.deleteLater()


def lay_directory(paths: UserPaths) -> None:
    (paths.settings_file / "inside").mkdir(parents=True)


def lay_pipe(paths: UserPaths) -> None:
    os.mkfifo(paths.settings_file)


def lay_huge(paths: UserPaths) -> None:
    with paths.settings_file.open("wb") as file:
        file.truncate(2**40)


def lay_deep(paths: UserPaths) -> None:
    paths.settings_file.write_text("[" * 100_000)


@pytest.mark.parametrize("lay", [lay_directory, lay_pipe, lay_huge, lay_deep])
def test_settings_that_are_no_settings_are_set_aside(
    start: Callable[[UserPaths], Started], tmp_path: Path, lay: Callable[[UserPaths], None]
) -> None:
    paths = in_folder(tmp_path)
    lay(paths)
    shown = start(paths)
    kept = paths.settings_file.with_name("settings.json.broken-1")
    assert shown.sentences == (
        f"{paths.settings_file} is damaged or cannot be read, so the defaults are used; "
        f"the file is kept as {kept}."
    )
    assert kept.exists()
    assert paths.settings_file.is_file()


def test_wrong_entries_are_told_and_the_others_kept(
    start: Callable[[UserPaths], Started], tmp_path: Path
) -> None:
    paths = in_folder(tmp_path)
    text = f'{{"author": "A. Ek", "recent": ["\\ud800"], "largest_residual_mm": {HUGE}}}'
    paths.settings_file.write_text(text)
    shown = start(paths)
    assert "largest_residual_mm, recent cannot be understood" in shown.sentences
    assert load_settings(paths.settings_file).author == "A. Ek"
    assert paths.settings_file.with_name("settings.json.broken-1").read_text() == text


def damaged_layout() -> tuple[str, str]:
    """A state of docks that crashes Qt: its list of docks goes on for ever."""
    return "", base64.b64encode(b"\0\0\0\xff\0\0\0\0\xfd" + b"\x7f" * 200).decode()


@pytest.mark.parametrize(
    "layout", [damaged_layout(), ("ä", ""), ("00:", "11:AAAA"), ("\u20ac:", "")]
)
def test_a_damaged_arrangement_is_told(
    start: Callable[[UserPaths], Started], tmp_path: Path, layout: tuple[str, str]
) -> None:
    paths = in_folder(tmp_path)
    save_settings(Settings(window_geometry=layout[0], window_docks=layout[1]), paths.settings_file)
    shown = start(paths)
    assert shown.sentences == "The arrangement of the window is damaged, so it has its usual one."


@pytest.mark.parametrize("place", ["config", "data"])
def test_a_place_that_keeps_nothing_is_told_at_the_start(
    start: Callable[[UserPaths], Started], tmp_path: Path, place: str
) -> None:
    paths = in_folder(tmp_path)
    shutil.rmtree(tmp_path / place)
    (tmp_path / place).touch()
    assert (
        f"Neither settings nor unsaved work can be kept: {tmp_path / place} cannot be "
        "written: a file is there where a folder is needed; choose another name."
    ) in start(paths).sentences


@pytest.mark.parametrize(
    "origin",
    [
        None,
        b"",
        b"\0\0",
        b'"/old/form.insole"',
        b'{"path": 5}',
        b'{"path": "../x.insole", "digest": ""}',
        b'{"path": "/", "digest": ""}',
    ],
)
def test_a_lost_origin_does_not_hide_an_intact_copy(tmp_path: Path, origin: bytes | None) -> None:
    write_case(CaseRecord(Patient(name="Anna")), tmp_path / "abc.insole")
    if origin is not None:
        (tmp_path / "abc.json").write_bytes(origin)
    (recovered,) = find_recovered(tmp_path)
    assert recovered.record.patient.name == "Anna"
    assert recovered.path is None


def test_damaged_copies_are_kept_aside_beside_intact_ones(tmp_path: Path) -> None:
    write_case(CaseRecord(Patient(name="Anna")), tmp_path / "abc.insole")
    (tmp_path / "cut.insole").write_bytes(b"cut off")
    (tmp_path / "folder.insole").mkdir()
    os.mkfifo(tmp_path / "pipe.insole")
    complaints: list[str] = []
    (recovered,) = find_recovered(tmp_path, complaints.append)
    assert recovered.record.patient.name == "Anna"
    assert len(complaints) == 3
    assert (tmp_path / "cut.insole.broken-1").read_bytes() == b"cut off"
    recovered.release()
    assert find_recovered(tmp_path, complaints.append)
    assert len(complaints) == 3  # told once
