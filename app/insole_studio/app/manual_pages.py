"""The pages of the manual, and which of them is about a window, a dialog or a panel."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtWidgets import QWidget

from insole_core.errors import InputError
from insole_core.resources import resource_path

FIRST_PAGE = "first-insole"
NEWS_PAGE = "whats-new"
PAGES = {
    "app.help_actions": "troubleshooting",
    "app.text_dialog": "troubleshooting",
    "features.calibrate": "calibration",
    "features.capture": "capture",
    "features.case_files": "design",
    "features.clinic": "clinic",
    "features.clinic.place_dialog": "stations",
    "features.compare": "two-feet",
    "features.design.devices": "rim-and-device",
    "features.design.load": "pressure-change",
    "features.design.plantar": "pressure",
    "features.design.shoe": "design",
    "features.export": "export",
    "features.foot": "foot",
    "features.import_scan": "scans",
    "features.records": "patients",
    "features.records.import_dialog": "import-and-export",
    "features.records.record_transfer": "import-and-export",
    "features.records.version_dialogs": "stations",
    "features.records.version_dialogs.HistoryDialog": "patients",
    "widgets.key_help": "keyboard",
    "widgets.message_label.ErrorDialog": "troubleshooting",
    "widgets.rim_chart": "rim-and-device",
}
"""The page about the widgets of a package, module or class; the longest name that fits counts."""
PAGE_OF_TOOL = {"rim": "rim-and-device", "plantar": "pressure"}
"""The page about a tool of the design, where it has one of its own."""


def page_about(widget: QWidget | None, panels: Callable[[], str]) -> str:
    """Return the page about a widget, or about the innermost that holds it and has a page.

    Parameters
    ----------
    widget
        What has the focus, else the window in front.
    panels
        Names the page about the panels of the main window, which belong to none of the others.
    """
    while widget is not None:
        page = page_of_kind(type(widget))
        if page is not None:
            return page
        widget = widget.parentWidget()
    return panels()


def page_of_kind(kind: type) -> str | None:
    """Return the page about a kind of widget, if there is one."""
    name = f"{kind.__module__}.{kind.__name__}".removeprefix("insole_studio.")
    while name and name not in PAGES:
        name = name.rpartition(".")[0]
    return PAGES.get(name)


def manual_page(name: str, language: str) -> Path:
    """Return the file of a page; it is one of English where the language has no manual.

    Parameters
    ----------
    language
        Code of a language, such as "sv".

    Raises
    ------
    InputError
        When the manual is missing.
    """
    inside = "" if language == "en" else f"{language}/"
    for page in (f"{language}/manual/{inside}{name}.html", f"en/manual/{name}.html"):
        try:
            # A browser may read only where documentation is installed: not a link to there.
            return resource_path(f"manual/{page}").resolve()
        except FileNotFoundError:
            continue
    raise InputError(
        "The manual is missing from this installation; install Insole Studio again, or in its"
        " source, run make manual."
    )
