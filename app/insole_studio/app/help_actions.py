"""The actions of the Help menu, and F1."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from html import escape
from importlib.metadata import version

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QApplication, QMessageBox, QWidget
from shiboken6 import isValid

from insole_core.errors import InputError, InsoleError
from insole_studio.acquisition.examined_sensors import examine_sensors
from insole_studio.app.doctor_dialog import DoctorDialog
from insole_studio.app.features import Features
from insole_studio.app.licences import Licence, licence_text, licences
from insole_studio.app.main_window import MainWindow
from insole_studio.app.manual_pages import (
    FIRST_PAGE,
    NEWS_PAGE,
    PAGE_OF_TOOL,
    manual_page,
    page_about,
    page_of_module,
)
from insole_studio.app.text_dialog import TextDialog
from insole_studio.app.tour_stops import tour_stops
from insole_studio.services.app_services import AppServices
from insole_studio.services.other_programs import open_file
from insole_studio.texts import language_code, tr
from insole_studio.widgets.key_help import KeyHelp, Line
from insole_studio.widgets.tour import Tour

TOUR_NOTICE = "tour"


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
            return page_of_module(type(self._window.page).__module__) or FIRST_PAGE
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
