"""The actions of the Help menu and F1, and what they show: the computer examined, the licences."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from html import escape
from importlib.metadata import Distribution, distributions, version

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget
from shiboken6 import isValid

from insole_core.errors import InputError, InsoleError
from insole_core.resources import resource_path
from insole_studio.acquisition.examined_sensors import examine_sensors
from insole_studio.app.doctor import Diagnosis, Doctor, FindSensors, report_lines
from insole_studio.app.features import Features
from insole_studio.app.graphics import examine_graphics
from insole_studio.app.main_window import MainWindow
from insole_studio.app.manual_pages import (
    FIRST_PAGE,
    NEWS_PAGE,
    PAGE_OF_TOOL,
    manual_page,
    page_about,
    page_of_kind,
)
from insole_studio.app.text_dialog import TextDialog
from insole_studio.app.tour_stops import tour_stops
from insole_studio.services.app_services import AppServices
from insole_studio.services.other_programs import open_file
from insole_studio.texts import language_code, tr, translate_core_message
from insole_studio.widgets.key_help import KeyHelp, Line
from insole_studio.widgets.tour import Tour

CHANNEL = "doctor"
LIST = "licences/licences.json"
_NAMES = ("licen", "copying", "notice")
TOUR_NOTICE = "tour"


class DoctorDialog(TextDialog):
    """What may keep the program from working here, and a sentence of advice for each."""

    def __init__(self, services: AppServices, find_sensors: FindSensors, parent: QWidget) -> None:
        title = tr("Examine this computer")
        super().__init__(title, "insole-studio-doctor.txt", services.messages, parent)
        self._services = services
        self._find_sensors = find_sensors
        self.again = self.add_button(tr("Examine again"), self.examine)
        self.buttons.insertWidget(0, self.again)

    def examine(self) -> None:
        """Examine the computer and show what is found."""
        self._enable(examined=False)
        self.show_html(f"<p>{escape(tr('Examining…'))}</p>", "")
        graphics = examine_graphics(QGuiApplication.platformName())
        doctor = Doctor(
            self._services.paths, graphics, self._find_sensors, self._services.clinic.location
        )
        self._services.jobs.start(
            CHANNEL, lambda _progress: doctor.examine(), self._show, self._show_failure
        )

    def _show(self, found: list[Diagnosis]) -> None:
        if not isValid(self):  # closed meanwhile
            return
        lines = report_lines(found, translate_core_message)
        self.show_html("".join(map(_paragraph, found)), "\n".join(lines) + "\n")
        self._enable(examined=True)

    def _show_failure(self, error: Exception) -> None:
        if not isValid(self):
            return
        self._enable(examined=True)
        self._services.messages.show_error(error, self)

    def _enable(self, *, examined: bool) -> None:
        for button in (self.copy, self.save, self.again):
            button.setEnabled(examined)


def _paragraph(diagnosis: Diagnosis) -> str:
    said = (translate_core_message(text) for text in (diagnosis.topic, diagnosis.state))
    topic, state = map(escape, said)
    advice = escape(translate_core_message(diagnosis.advice))
    if not advice:
        return f"<p>✓ <b>{topic}</b>: {state}</p>"
    return f"<p>⚠ <b>{topic}</b>: {state}<br/>→ {advice}</p>"


@dataclass(frozen=True)
class Licence:
    """A component and its licence.

    Parameters
    ----------
    licence
        Its short name; empty where the component does not give it.
    text
        In full; empty where the component brings none.
    """

    name: str
    version: str
    licence: str
    text: str


def licences() -> tuple[list[Licence], str]:
    """Return the licences, by name, and how Qt is replaced.

    Returns
    -------
    tuple of list and str
        The text is empty in an installation from the sources, where Qt is a package like others.
    """
    try:
        path = resource_path(LIST)
    except FileNotFoundError:
        found = {dist.name.lower(): _of_package(dist) for dist in distributions() if dist.name}
        return [found[name] for name in sorted(found)], ""
    listed = json.loads(path.read_text(encoding="utf-8"))
    parts = [
        Licence(
            part["name"],
            part["version"],
            part["licence"],
            "\n\n".join(f"{text['name']}\n\n{text['text']}" for text in part["texts"]),
        )
        for part in listed["components"]
    ]
    own = listed["program"]
    program = Licence(own["name"], own["version"], own["licence"], own["text"])
    return [program, *parts], listed["replacing_qt"]


def licence_text(found: list[Licence], replacing_qt: str) -> str:
    """Return a list of all, how Qt is replaced, and the texts in full."""
    lines = [f"{part.name} {part.version}: {part.licence or '?'}" for part in found]
    texts = [f"{part.name} {part.version}\n\n{part.text}" for part in found if part.text]
    return ("\n\n" + "=" * 72 + "\n\n").join(filter(None, ("\n".join(lines), replacing_qt, *texts)))


def _of_package(dist: Distribution) -> Licence:
    meta = dist.metadata.json
    texts = [
        file.read_text()
        for file in dist.files or ()
        if file.parts[0].endswith(".dist-info")
        and any(word in file.name.lower() for word in _NAMES)
    ]
    short = str(meta.get("license_expression") or meta.get("license") or "").split("\n")[0]
    return Licence(dist.name, dist.version, short, "\n\n".join(texts))


class HelpActions(QObject):
    """Manual, tour, list of keyboard shortcuts, and about box."""

    panels_requested = Signal()

    def __init__(
        self,
        services: AppServices,
        window: MainWindow,
        features: Features,
        keys: Callable[[], Iterable[tuple[str, list[Line]]]],
    ) -> None:
        super().__init__(window)
        self._services = services
        self._window = window
        self._features = features
        self._keys = keys
        self._tour: Tour | None = None

    def show_manual(self) -> None:
        """Open the manual at the page about what is in front."""
        self.show_manual_about(QApplication.focusWidget() or self._window)

    def show_manual_about(self, widget: QWidget) -> None:
        """Open the manual in the browser, at the page about a widget or what holds it."""
        try:
            self._open_page(page_about(widget, self._about_panels))
        except InsoleError as error:
            self._services.messages.show_error(error, over=widget.window())

    def _about_panels(self) -> str:
        """Name the page about what the main window shows, wherever in its frame the focus is."""
        if self._window.page is not None:
            return page_of_kind(type(self._window.page)) or FIRST_PAGE
        if self._services.case.foot is None:
            return FIRST_PAGE
        return PAGE_OF_TOOL.get(self._features.design.stage.tool_controller.tool.key, "design")

    def _open_page(self, name: str) -> None:
        path = manual_page(name, language_code(self._services.settings.language))
        if not open_file(path):
            raise InputError(
                "No browser could be opened; open {path} in one to read the manual.", path=path
            )

    def show_news(self) -> None:
        """Open the page on what is new."""
        try:
            self._open_page(NEWS_PAGE)
        except InsoleError as error:
            self._services.messages.show_error(error)

    def offer_news(self) -> None:
        """Offer the page on what is new, once after each update."""
        settings, running = self._services.settings, version("insole-studio")
        if settings.version_used not in {"", running}:
            text = tr("Insole Studio was updated to version {version}.").format(version=running)
            self._services.notices.put(
                NEWS_PAGE, text, (tr("What is new"), self.show_news), stays=True
            )
        settings.version_used = running

    def offer_tour(self) -> None:
        """Offer the tour until it was taken once, or is not wanted."""
        if self._services.settings.tour_seen:
            return
        self._services.notices.put(
            TOUR_NOTICE,
            tr("New here? The tour makes a whole insole of an example, from scan to file."),
            (tr("Take the tour"), self.begin_tour),
            (tr("Not now"), self._note_tour),
            stays=True,
        )

    def begin_tour(self) -> None:
        """Begin the tour on the first page; one that is under way gets the focus instead."""
        if self._tour is None:
            self._services.notices.drop(TOUR_NOTICE)
            before = self._window.page
            self._features.records.show_start()
            stops = tour_stops(
                self._features, self._window, self._services.case, self.panels_requested.emit
            )
            self._tour = Tour(stops, self._window, self._features.design.stage.steps)
            self._tour.ended.connect(partial(self._end_tour, before))
            self._tour.begin()
        self._tour.take_focus()

    def show_keys(self) -> None:
        """List all keyboard shortcuts."""
        KeyHelp(self._keys(), self._window).show()

    def show_doctor(self) -> None:
        """Examine the computer, and show what may keep the program from working."""
        dialog = DoctorDialog(self._services, examine_sensors, self._window)
        dialog.show()
        dialog.examine()

    def show_licences(self) -> None:
        """Show the licences of all that the program comes with."""
        title = tr("Licences")
        messages = self._services.messages
        dialog = TextDialog(title, "insole-studio-licences.txt", messages, self._window)
        dialog.show_html(f"<p>{escape(tr('Reading…'))}</p>", "")
        dialog.show()

        def show(found: tuple[list[Licence], str]) -> None:
            if isValid(dialog):
                text = licence_text(*found)
                dialog.show_html(f"<pre style='white-space: pre-wrap'>{escape(text)}</pre>", text)

        self._services.run("licences", lambda _progress: licences(), show)

    def show_about(self) -> None:
        """Show the about box."""
        QMessageBox.about(
            self._window,
            tr("About Insole Studio"),
            tr("Version {version}").format(version=version("insole-studio"))
            + "\n\n"
            + tr("Insole Studio: from the scan of a foot to its insole. BSD 3-Clause licence."),
        )

    def _end_tour(self, before: QWidget | None) -> None:
        """Lead back to what was shown before, if the tour has not got beyond its first page."""
        self._tour = None
        self._note_tour()
        records = self._features.records
        if self._window.page is not records.start:
            return
        if before is not None:
            records.page_requested.emit(before)
        elif not self._services.case.is_empty:
            self.panels_requested.emit()

    def _note_tour(self) -> None:
        self._services.settings.tour_seen = True
        self._services.save_settings()
