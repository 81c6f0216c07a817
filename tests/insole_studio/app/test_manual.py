"""F1 opens the right page of the manual; its pages and pictures are there, none of the past."""

from __future__ import annotations

import importlib
import inspect
import json
import pkgutil
import re
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from command_reference import each_command, help_of
from dialog_pictures import DIALOGS, OF_JOURNEYS, OF_WINDOWS, SCAN, show
from PySide6.QtCore import QObject, Qt, QUrl, Slot
from PySide6.QtGui import QDesktopServices
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication, QDialog, QMessageBox, QPushButton
from value_reference import each_part, rows_of

import insole_studio.features
from insole_core.cases.scan_source import ScanSource
from insole_core.errors import InputError
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.elements import CORRECTION_TYPES
from insole_core.insole.fields import declared
from insole_core.resources import resource_path
from insole_studio.app import help_actions, manual_pages
from insole_studio.app.bootstrap import Application
from insole_studio.app.manual_pages import PAGE_OF_TOOL, PAGES, manual_page, page_of_kind
from insole_studio.cli.main import COMMANDS, command_parser
from insole_studio.services.stage_window import StageWindow
from insole_studio.texts import translation_into
from insole_studio.widgets.tab_order import StageFrame

MANUAL = Path(__file__).parents[3] / "docs" / "manual"
IMAGES = MANUAL / "images"
PICTURE = re.compile(r"!\[[^\]]*\]\((?:\.\./)?images/(?:sv/)?([\w-]+)\.png\)")


class Browser(QObject):
    """Takes the place of the browser, and keeps what it is asked to show."""

    def __init__(self) -> None:
        super().__init__()
        self.shown: list[str] = []

    @Slot(QUrl)
    def open(self, url: QUrl) -> None:
        self.shown.append(Path(url.toLocalFile()).stem)


@pytest.fixture
def browser(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[Browser]:
    monkeypatch.setattr(help_actions, "manual_page", lambda name, _language: tmp_path / name)
    taken = Browser()
    QDesktopServices.setUrlHandler("file", taken, "open")
    yield taken
    QDesktopServices.unsetUrlHandler("file")


def test_f1_opens_the_page_about_the_window_in_front(
    clinic: Application, browser: Browser, settle: Callable[[], None]
) -> None:
    clinic.window.show()
    settle()
    QTest.keyClick(clinic.window, Qt.Key.Key_F1)
    clinic.window.show_panels()
    clinic.window.actions_by_key["manual"].trigger()
    clinic.window.actions_by_key["backup"].trigger()
    dialog = QApplication.activeModalWidget()
    assert isinstance(dialog, QDialog)
    QTest.keyClick(dialog, Qt.Key.Key_F1)
    QTest.keyClick(dialog, Qt.Key.Key_F1, Qt.KeyboardModifier.ControlModifier)
    dialog.reject()
    clinic.window.actions_by_key["calibrate"].trigger()
    settle()
    stage = clinic.features.calibrate.stage
    assert stage is not None
    clinic.window.hide()  # it would stay active where there is no screen, and its shortcut count
    QTest.keyClick(stage, Qt.Key.Key_F1)
    assert browser.shown == ["patients", "first-insole", "clinic", "calibration"]


def test_f1_follows_the_tool(
    opened: Application, browser: Browser, settle: Callable[[], None]
) -> None:
    opened.window.activateWindow()
    for action in ("tool_pelott", "tool_rim", "tool_plantar"):
        opened.window.actions_by_key[action].trigger()
        settle()
        opened.window.actions_by_key["manual"].trigger()
    assert browser.shown == ["design", "rim-and-device", "pressure"]


def test_what_is_new_is_offered_once_after_an_update(app: Application, browser: Browser) -> None:
    app.main.help.offer_news()  # the first start of all
    assert app.services.notices.notices == []
    app.settings.version_used = "0.0.1"
    app.main.help.offer_news()
    (notice,) = app.services.notices.notices
    assert notice.text.startswith("Insole Studio was updated to version")
    button = next(b for b in app.window.findChildren(QPushButton) if b.text() == "What is new")
    button.click()
    assert browser.shown == ["whats-new"]
    app.main.help.offer_news()
    assert app.services.notices.notices == []


def test_a_missing_manual_is_told(app: Application, monkeypatch: pytest.MonkeyPatch) -> None:
    def none(name: str) -> Path:
        raise FileNotFoundError(name)

    monkeypatch.setattr(manual_pages, "resource_path", none)
    with pytest.raises(InputError, match="make manual"):
        manual_page("capture", "en")
    app.window.actions_by_key["manual"].trigger()
    (dialog,) = app.services.messages.dialogs
    assert isinstance(dialog, QMessageBox)
    assert "manual is missing" in dialog.text()


def test_a_language_without_a_page_gets_the_english_one(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def resource(name: str) -> Path:
        if not (tmp_path / name).exists():
            raise FileNotFoundError(name)
        return tmp_path / name

    monkeypatch.setattr(manual_pages, "resource_path", resource)
    for name in ("en/manual/foot.html", "en/manual/scans.html", "sv/manual/sv/foot.html"):
        page = tmp_path / "manual" / name
        page.parent.mkdir(parents=True, exist_ok=True)
        page.touch()
    assert manual_page("foot", "sv") == tmp_path / "manual/sv/manual/sv/foot.html"
    assert manual_page("scans", "sv") == tmp_path / "manual/en/manual/scans.html"
    assert manual_page("foot", "en") == tmp_path / "manual/en/manual/foot.html"


def modules_of_features() -> Iterator[str]:
    package = insole_studio.features
    for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
        yield found.name


def test_every_dialog_and_stage_has_a_page() -> None:
    without = [
        name
        for module in modules_of_features()
        for name, kind in inspect.getmembers(importlib.import_module(module), inspect.isclass)
        if kind.__module__ == module
        and issubclass(kind, (QDialog, StageFrame, StageWindow))
        and page_of_kind(kind) is None
    ]
    assert without == []


def test_pages_that_the_window_opens_exist_and_their_modules_too() -> None:
    for name in PAGES:
        module, _, kind = name.rpartition(".")
        if kind[0].isupper():
            assert inspect.isclass(
                getattr(importlib.import_module(f"insole_studio.{module}"), kind)
            )
        else:
            assert importlib.util.find_spec(f"insole_studio.{name}") is not None, name
    pages = {*PAGES.values(), *PAGE_OF_TOOL.values(), manual_pages.FIRST_PAGE}
    assert [page for page in sorted(pages) if not (MANUAL / f"{page}.md").exists()] == []


def test_swedish_has_the_pages_of_english() -> None:
    english, swedish = (
        {page.name for page in folder.glob("*.md")} for folder in (MANUAL, MANUAL / "sv")
    )
    assert swedish == english


def test_every_picture_is_used_there_and_listed() -> None:
    used = {
        name for page in MANUAL.rglob("*.md") for name in PICTURE.findall(page.read_text("utf-8"))
    }
    listed = {*(p.name for p in (*DIALOGS, SCAN)), *OF_JOURNEYS, *OF_WINDOWS}
    assert used == listed
    for folder in (IMAGES, IMAGES / "sv"):
        assert {file.stem for file in folder.glob("*.png")} == listed


def test_the_swedish_manual_shows_the_swedish_window() -> None:
    text = "".join(page.read_text("utf-8") for page in (MANUAL / "sv").glob("*.md"))
    assert "](../images/sv/" in text
    assert re.findall(r"images/(?!sv/)[\w-]+\.png", text) == []
    assert all(
        (IMAGES / "sv" / file.name).read_bytes() != file.read_bytes()
        for file in IMAGES.glob("*.png")
    )


def test_all_supplied_findings_are_named_where_the_search_finds_them() -> None:
    supplied = json.loads(resource_path("findings/findings.json").read_text("utf-8"))["findings"]
    words = " ".join((MANUAL / "rim-and-device.md").read_text("utf-8").split())
    assert supplied
    assert [each["name"] for each in supplied if each["name"] not in words] == []


def test_journeys_still_take_their_pictures() -> None:
    journeys = Path(__file__).parents[1] / "journeys"
    for name, journey in OF_JOURNEYS.items():
        assert f'"{name}"' in (journeys / f"{journey}.py").read_text("utf-8"), name


class Studio:
    """What `show` needs of a scripted window."""

    def __init__(self, app: Application, settle: Callable[[], None]) -> None:
        self.app, self.settle = app, settle


def test_the_dialogs_of_pictures_are_opened_by_their_actions(
    clinic: Application, settle: Callable[[], None], make_foot: Callable[[Side], Foot]
) -> None:
    clinic.case.open_foot(make_foot(Side.LEFT), ScanSource("mesh", "/nowhere/f.ply", "0" * 64))
    settle()
    seen: list[str] = []
    for picture in DIALOGS:
        show(Studio(clinic, settle), picture, lambda shown: seen.append(type(shown).__name__))  # type: ignore[arg-type]
    assert seen == [picture.window.__name__ for picture in DIALOGS]


def test_every_command_is_described() -> None:
    names = [parser.prog for parser in each_command(command_parser())]
    assert len(names) == len(set(names)) > len(COMMANDS)
    for command in COMMANDS:
        assert f"insole-studio {command.NAME}" in names
    (distortion,) = (p for p in each_command(command_parser()) if p.prog.endswith(" distortion"))
    assert "--serial" in help_of(distortion)


def test_the_manual_tells_every_value_of_a_prescription_in_both_languages() -> None:
    english, swedish = (
        {
            (kind.__name__, row.key, number): row
            for _, _, kind in each_part()
            for number, row in enumerate(rows_of(kind, translation_into(language)))
        }
        for language in ("en", "sv")
    )
    assert {key[:2] for key in english} == {
        (kind.__name__, name) for _, _, kind in each_part() for name in declared(kind)
    }
    assert [row.key for row in english.values() if not row.tip] == []
    assert [key for key, row in english.items() if row.tip == swedish[key].tip] == []
    lift, turn = english["FullLift", "heads_share", 1], swedish["HeelSkive", "slope_deg", 1]
    assert lift[:3] == ("At the heads", "0 to 100 %", "50 %")
    assert turn[:3] == ("Lutning", "5 till 30 grader", "15°")
    assert set(CORRECTION_TYPES.values()) <= {kind for _, _, kind in each_part()}
