"""The window's own feature, appearance and help, and its actions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from insole_studio.app.appearance import Appearance
from insole_studio.app.help_actions import HelpActions
from insole_studio.app.main_window import MainWindow
from insole_studio.languages import LANGUAGES, Language
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr


def _language(key: Language, text: Callable[[], str]) -> ActionRecord[WindowFeature]:
    return ActionRecord(
        f"language_{key}",
        text,
        lambda: tr("The language of the window, from the next start on"),
        lambda main, on: main.appearance.set_language(key) if on else None,
        checkable=True,
        group="languages",
    )


WINDOW_ACTIONS: tuple[ActionRecord[WindowFeature], ...] = (
    ActionRecord(
        "quit",
        lambda: tr("Quit"),
        lambda: tr("Close Insole Studio"),
        lambda main, _on: main.window.close(),
        shortcut="Ctrl+Q",
    ),
    ActionRecord(
        "linked",
        lambda: tr("Linked views"),
        lambda: tr("Foot and insole turn together"),
        lambda main, on: main.appearance.set_linked(on),
        icon="link",
        shortcut="L",
        checkable=True,
    ),
    ActionRecord(
        "dark",
        lambda: tr("Dark theme"),
        lambda: tr("Light text on a dark ground"),
        lambda main, on: main.appearance.set_dark(on),
        icon="dark",
        checkable=True,
    ),
    ActionRecord(
        "touch",
        lambda: tr("Touch mode"),
        lambda: tr("Large targets for fingers"),
        lambda main, on: main.appearance.set_touch(on),
        checkable=True,
    ),
    ActionRecord(
        "software_rendering",
        lambda: tr("Software rendering"),
        lambda: tr("Draw with the processor, where the graphics card cannot; from the next start"),
        lambda main, on: main.appearance.set_software_rendering(on),
        checkable=True,
    ),
    _language("system", lambda: tr("Language of the system")),
    *(_language(code, partial(str, name)) for code, name in LANGUAGES.items()),
    ActionRecord(
        "manual",
        lambda: tr("Manual"),
        lambda: tr("The page of the manual about what is in front"),
        lambda main, _on: main.help.show_manual(),
        shortcut="F1",
    ),
    ActionRecord(
        "tour",
        lambda: tr("Take the tour"),
        lambda: tr("From a scan to the written file, on the example; again, to reach its bubble"),
        lambda main, _on: main.help.begin_tour(),
        shortcut="Ctrl+F1",
    ),
    ActionRecord(
        "keys",
        lambda: tr("Keys…"),
        lambda: tr("All that the keys do"),
        lambda main, _on: main.help.show_keys(),
        shortcut="Shift+F1",
    ),
    ActionRecord(
        "news",
        lambda: tr("What is new"),
        lambda: tr("The page of the manual about what this version can do"),
        lambda main, _on: main.help.show_news(),
    ),
    ActionRecord(
        "doctor",
        lambda: tr("Examine this computer…"),
        lambda: tr("Graphics, sensors, disk, settings and record, with advice"),
        lambda main, _on: main.help.show_doctor(),
    ),
    ActionRecord(
        "licences",
        lambda: tr("Licences…"),
        lambda: tr("Of all that the program comes with"),
        lambda main, _on: main.help.show_licences(),
    ),
    ActionRecord(
        "about",
        lambda: tr("About Insole Studio"),
        lambda: tr("Version and licence"),
        lambda main, _on: main.help.show_about(),
    ),
)


@dataclass(frozen=True, eq=False)
class WindowFeature:
    """The main window, its appearance and its help."""

    window: MainWindow
    appearance: Appearance
    help: HelpActions
