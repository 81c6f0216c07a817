"""The frame: actions in menus and toolbars, the stage's panels as docks, the status bar."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Sequence
from typing import Any

from PySide6.QtCore import QByteArray, QEvent, QObject, QSignalBlocker, Qt, QTimer, Signal
from PySide6.QtGui import (
    QAction,
    QActionGroup,
    QCloseEvent,
    QKeyEvent,
    QKeySequence,
    QResizeEvent,
    QShowEvent,
)
from PySide6.QtWidgets import (
    QApplication,
    QDockWidget,
    QMainWindow,
    QMenu,
    QProxyStyle,
    QSizePolicy,
    QStackedWidget,
    QStyle,
    QStyleOption,
    QToolBar,
    QToolButton,
    QWidget,
)

from insole_core.visible_text import visible_value
from insole_studio.app.menus import (
    BESIDE_KEYS,
    MAP_KEYS,
    MAPS,
    MENUS,
    PADS,
    RECENT,
    SEPARATOR,
    STRIP,
    TOOLBAR,
)
from insole_studio.app.status_bar import StatusBar
from insole_studio.features.design.pad_menu import PadMenu
from insole_studio.features.design.stage import DesignStage
from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr
from insole_studio.widgets.icons import icon
from insole_studio.widgets.screen_room import Scrolled
from insole_studio.widgets.tab_order import StageFrame, go_on

PATIENT_PX, PATIENT_SHARE, WIDEST_PATIENT_PX = 248, 0.19, 400
FOOT_SHARE = 0.46
MOST_OF_PATIENT = 0.34
"""Largest share of the width that the patient panel keeps in a narrow window."""
PARAMETERS_PX, MOST_OF_PARAMETERS = 152, 0.22
"""Height of the parameters, and the share of a low window that they take at most."""
SECTION_SHARE, RIM_SHARE = 0.34, 0.5
"""Shares of the width that section and rim take from the parameters."""
LEAST_CHART_PX = 300


class _RoomForMore(QProxyStyle):
    """Lets a toolbar leave as much room for its button "more" as the style sheet makes it wide."""

    def __init__(self, bar: QToolBar) -> None:
        super().__init__("Fusion")
        self.setParent(bar)
        more = bar.findChild(QToolButton, "qt_toolbar_ext_button")
        assert more is not None, "Qt makes it with the toolbar"
        self._more = more

    def pixelMetric(
        self,
        metric: QStyle.PixelMetric,
        option: QStyleOption | None = None,
        widget: QWidget | None = None,
    ) -> int:
        """Return a measure of the style."""
        px = super().pixelMetric(metric, option, widget)
        if metric is QStyle.PixelMetric.PM_ToolBarExtensionExtent:
            return max(px, self._more.minimumWidth())
        return px


class MainWindow(QMainWindow):
    """The main window; the controller decides what an action or closing does."""

    action_triggered = Signal(str, bool)
    close_requested = Signal()
    recent_chosen = Signal(str)
    pad_chosen = Signal(int)
    back_requested = Signal()
    layout_changed = Signal()

    def __init__(
        self,
        stage: DesignStage,
        status: StatusBar,
        pads: PadMenu,
        records: Sequence[ActionRecord[Any]],
    ) -> None:
        super().__init__()
        self._may_close = False
        self._foot_share = FOOT_SHARE
        self._patient_px = PATIENT_PX
        """Width of the patient panel in a window that has room for it."""
        self._is_restored = False
        """Whether the panels stand as at the last start, perhaps in a window of another size."""
        self._sharing = QTimer(self)  # Qt still lays out while it tells of a new size
        self._sharing.setSingleShot(True)
        self._sharing.timeout.connect(self._share_width)
        self._panels = stage.panels
        self.status = status
        self.setStatusBar(status)
        self._records = records
        self.actions_by_key = {record.key: self._make_action(record) for record in records}
        self._group_actions()
        self._pads = pads
        self._make_menus()
        self._worded: list[QToolButton] = []
        """Toolbar buttons that show their label while there is space for it."""
        self._make_strip(stage)
        self._make_toolbar()
        self._make_notices(stage)
        self._insole = stage.insole
        self._fields = stage.parameters
        self._pages = QStackedWidget()
        self._pages.addWidget(stage.insole)
        self._held: dict[QWidget, Scrolled] = {}
        """The pages of the record that were shown."""
        self._of_stage: QByteArray | None = None
        """How the panels stand, while a page has taken their place."""
        self._wanted_charts: set[QDockWidget] = set()
        self.setCentralWidget(self._pages)
        self._patient = self._dock("patient", tr("Patient"), stage.patient)
        self._foot = self._dock("foot", tr("Foot in colour"), stage.foot)
        self._parameters = self._dock("parameters", tr("Parameters"), stage.parameters)
        self._section = self._dock("section", tr("Section"), stage.section)
        self._rim = self._dock("rim", tr("Rim"), stage.rim)
        self._docks = (self._patient, self._foot, self._parameters, self._rim, self._section)
        self._place_docks()
        for dock in (self._patient, self._foot):
            dock.installEventFilter(self)
        self._add_dock_actions()
        stage.section_wanted.connect(self._show_section)
        stage.section_chosen.connect(self._section.raise_)
        stage.rim_wanted.connect(self._show_rim)
        self._section.hide()
        self._rim.hide()

    @property
    def page(self) -> QWidget | None:
        """The page that has taken the place of the panels; None while they are shown."""
        shown = self._pages.currentWidget()
        return shown.widget() if isinstance(shown, Scrolled) else None

    def show_page(self, page: QWidget) -> None:
        """Show a page of the record in place of the panels and their toolbar."""
        if page not in self._held:
            self._held[page] = Scrolled(page)
            self._pages.addWidget(self._held[page])
        if self._of_stage is None:
            self._of_stage = self.saveState()
            for dock in self._docks:
                dock.hide()
                dock.toggleViewAction().setEnabled(False)
            self._toolbar.hide()
            self.status.show_tool_texts(False)
        self._bring(self._held[page])

    def show_panels(self) -> None:
        """Show the panels again as they stood before a page took their place."""
        if self._of_stage is None:
            return
        before, self._of_stage = self._of_stage, None
        self._bring(self._insole)
        has_notices = not self._notices.isHidden()
        self.restoreState(before)
        self.status.show_tool_texts(True)
        self._notices.setVisible(has_notices)
        for dock in self._docks:
            dock.toggleViewAction().setEnabled(True)
        for chart in (self._section, self._rim):
            chart.setVisible(chart in self._wanted_charts)

    def _bring(self, page: QWidget) -> None:
        """Show a page; the others ask for no space meanwhile."""
        ignored, preferred = QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Preferred
        before = self._pages.currentWidget()
        if before is not None:
            before.setSizePolicy(ignored, ignored)
        page.setSizePolicy(preferred, preferred)
        self._pages.setCurrentWidget(page)

    def show_title(self, name: str, unsaved: bool) -> None:
        """Show which case is open."""
        written = name.replace("[*]", "[*][*]")  # Qt's mark of what is not saved, and its escape
        self.setWindowTitle(f"{written}[*] – Insole Studio")
        self.setWindowModified(unsaved)

    def show_action(self, key: str, enabled: bool, text: str | None = None) -> None:
        """Enable or disable an action; `text` replaces its label."""
        action = self.actions_by_key[key]
        action.setEnabled(enabled)
        if text is not None:
            action.setText(text)

    def allow_action(self, key: str, has_sense: bool, why_not: str) -> None:
        """Enable an action where it has a sense, or let it say there why it is not enabled.

        Parameters
        ----------
        why_not
            An empty sentence enables it; it then says what it does.
        """
        self.show_action(key, has_sense and not why_not)
        why_not = why_not if has_sense else ""
        record, action = next(r for r in self._records if r.key == key), self.actions_by_key[key]
        action.setToolTip(why_not or _tip(record))
        action.setStatusTip(why_not or record.tip())

    def show_pads(self, enabled: bool) -> None:
        """Show whether a pad of the library can be chosen in the menu."""
        self._pads_entry.setEnabled(enabled)

    def check_action(self, key: str, checked: bool) -> None:
        """Check or uncheck an action without running it."""
        action = self.actions_by_key[key]
        group = action.actionGroup()
        with QSignalBlocker(self):  # not the action, by whose signals its group unchecks another
            action.setChecked(checked)
            for other in () if group is None else group.actions():
                if other is not action:
                    other.setChecked(False)  # also one that was checked on the way

    def renew_icons(self) -> None:
        """Redraw the icons in the colours of the palette."""
        for record in self._records:
            if record.icon:
                self.actions_by_key[record.key].setIcon(icon(record.icon))
        self._maps.setIcon(icon("map"))

    def tool_button(self, key: str) -> QWidget:
        """Return the button of an action in the toolbar."""
        return self._toolbar.widgetForAction(self.actions_by_key[key])

    def show_recent(self, names: Sequence[str]) -> None:
        """List the recently opened files."""
        self._recent.clear()
        for name in names:
            action = self._recent.addAction(visible_value(name).replace("&", "&&"))
            action.setData(name)
            action.triggered.connect(self._choose_recent)
        self._recent.setEnabled(bool(names))

    def arrange(self) -> None:
        """Set the default sizes of the panels: the two views share what the fields leave."""
        self._sharing.stop()
        horizontal, vertical = Qt.Orientation.Horizontal, Qt.Orientation.Vertical
        patient = min(max(round(PATIENT_SHARE * self.width()), PATIENT_PX), WIDEST_PATIENT_PX)
        self._patient_px, self._foot_share = patient, FOOT_SHARE
        foot = round(FOOT_SHARE * (self.width() - patient))
        self.resizeDocks([self._patient, self._foot], [patient, foot], horizontal)
        parameters = min(PARAMETERS_PX, round(MOST_OF_PARAMETERS * self.height()))
        self.resizeDocks([self._parameters], [parameters], vertical)
        section = round(SECTION_SHARE * self.width())
        self.resizeDocks(
            [self._parameters, self._section], [self.width() - section, section], horizontal
        )

    def layout_state(self) -> tuple[str, str]:
        """Return geometry and dock state, encoded as text."""
        docks = self.saveState() if self._of_stage is None else self._of_stage
        return _sealed(self.saveGeometry()), _sealed(docks)

    def restore_layout(self, geometry: str, docks: str) -> bool:
        """Restore a saved geometry and dock state; return whether they were intact, or empty."""
        packed = [_unsealed(text) for text in (geometry, docks)]
        if None in packed:
            return False
        if geometry:
            self.restoreGeometry(QByteArray(packed[0] or b""))
        if docks:
            self.restoreState(QByteArray(packed[1] or b""))
            self._is_restored = True
        self._section.hide()  # shown with the first section
        self._rim.hide()
        self._notices.hide()
        return True

    def come_forward(self) -> None:
        """Raise the window and give it the keyboard focus."""
        self.raise_()
        self.activateWindow()

    def close_for_good(self) -> None:
        """Close without asking."""
        self._may_close = True
        self.close()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Go back on Escape, unless another widget handles the key."""
        if event.key() == Qt.Key.Key_Escape:
            self.back_requested.emit()
        else:
            super().keyPressEvent(event)

    def focusNextPrevChild(self, forward: bool) -> bool:
        """Move the focus through the panels in reading order."""
        page = self.page
        # On a page of the record, only the steps and the notices stay of the panels.
        return go_on(self._panels if page is None else (*self._panels[:2], page), forward)

    def closeEvent(self, event: QCloseEvent) -> None:
        """Leave the decision to the controller."""
        if not self._may_close:
            self.close_requested.emit()
        event.setAccepted(self._may_close)

    def _make_action(self, record: ActionRecord[Any]) -> QAction:
        action = QAction(record.text(), self)
        action.setObjectName(record.key)
        action.setToolTip(_tip(record))
        action.setStatusTip(record.tip())
        if record.short is not None:
            action.setIconText(record.short())
        action.setCheckable(record.checkable)
        if record.icon:
            action.setIcon(icon(record.icon))
        shortcuts = filter(None, (record.shortcut, record.other_shortcut))
        action.setShortcuts([QKeySequence(shortcut) for shortcut in shortcuts])
        if record.everywhere:
            action.setShortcutContext(Qt.ShortcutContext.ApplicationShortcut)
            action.triggered.connect(self._come_forward)
        signal = action.toggled if record.checkable else action.triggered
        signal.connect(self._pass_on)
        return action

    def _come_forward(self) -> None:
        """Leave the window of a stage, if it is in front and keeps nothing that would be lost."""
        active = QApplication.activeWindow()
        if isinstance(active, StageFrame):
            active.step_aside()
            self.activateWindow()
            self.raise_()

    def _pass_on(self, checked: bool = False) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        if checked or action.actionGroup() is None:  # of a group, what is chosen counts alone
            self.action_triggered.emit(action.objectName(), checked)

    def _choose_recent(self) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        self.recent_chosen.emit(action.data())

    def _group_actions(self) -> None:
        groups: dict[str, QActionGroup] = {}
        for record in self._records:
            if record.group:
                group = groups.setdefault(record.group, QActionGroup(self))
                group.addAction(self.actions_by_key[record.key])

    def _make_menus(self) -> None:
        self._menus = []
        for title, keys in MENUS:
            menu = self.menuBar().addMenu(title())
            self._menus.append(menu)
            for key in keys:
                if key == SEPARATOR:
                    menu.addSeparator()
                elif key == RECENT:
                    self._recent = menu.addMenu(tr("Open recent"))
                elif key == PADS:
                    self._pads_entry = menu.addMenu(self._pad_menu(menu))
                else:
                    menu.addAction(self.actions_by_key[key])

    def _make_strip(self, stage: DesignStage) -> None:
        bar = self.addToolBar(tr("Steps"))
        bar.setObjectName("steps")
        bar.setMovable(False)
        bar.addWidget(stage.steps)
        for key in STRIP:
            bar.addAction(self.actions_by_key[key])
        bar.setStyle(_RoomForMore(bar))
        self.addToolBarBreak()

    def _make_toolbar(self) -> None:
        self._toolbar = bar = self.addToolBar(tr("Tools"))
        bar.setObjectName("toolbar")
        bar.setMovable(False)
        for number, part in enumerate(TOOLBAR):
            if number:
                bar.addSeparator()
            for key in part:
                if key == MAPS:
                    bar.addWidget(self._maps_button())
                else:
                    bar.addAction(self.actions_by_key[key])
                    self._style_button(bar, key)
        bar.setStyle(_RoomForMore(bar))

    def _make_notices(self, stage: DesignStage) -> None:
        self.addToolBarBreak()
        self._notices = self.addToolBar(tr("Notices"))
        self._notices.setObjectName("notices")
        self._notices.setMovable(False)
        self._notices.addWidget(stage.notices)
        self._notices.hide()
        stage.notices.filled.connect(self._notices.setVisible)

    def _fit_toolbar(self) -> None:
        """Hide as many labels of the toolbar, from its end, as the window is too narrow for."""
        layout = self._toolbar.layout()
        assert layout is not None
        for button in self._worded:
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        for button in reversed(self._worded):
            layout.invalidate()  # it learns of the new style only later
            if self._toolbar.sizeHint().width() <= self.width():
                return
            button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonIconOnly)

    def _style_button(self, bar: QToolBar, key: str) -> None:
        button = bar.widgetForAction(self.actions_by_key[key])
        if key.startswith("tool_") and isinstance(button, QToolButton):
            self._worded.append(button)
        if key == "tool_pelott" and isinstance(button, QToolButton):
            button.setMenu(self._pad_menu(button))
            button.setPopupMode(QToolButton.ToolButtonPopupMode.MenuButtonPopup)

    def _pad_menu(self, parent: QWidget) -> QMenu:
        return self._submenu(self._pads, parent)

    def _submenu(self, pads: PadMenu, parent: QWidget) -> QMenu:
        menu = QMenu(pads.title, parent)
        for entry in pads.entries:
            if isinstance(entry, PadMenu):
                menu.addMenu(self._submenu(entry, menu))
                continue
            action = menu.addAction(entry.text)
            action.setData(entry.number)
            action.triggered.connect(self._choose_pad)
        return menu

    def _maps_button(self) -> QToolButton:
        button = QToolButton()
        button.setText(tr("Maps"))
        button.setIcon(icon("map"))
        button.setToolTip(tr("Colour maps, contour lines and wireframe"))
        button.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        menu = QMenu(button)
        for key in (*MAP_KEYS, *BESIDE_KEYS, "contours", "grazing_light", "ghost", "wireframe"):
            menu.addAction(self.actions_by_key[key])
        button.setMenu(menu)
        self._maps = button
        self._worded.append(button)
        return button

    def _choose_pad(self) -> None:
        action = self.sender()
        assert isinstance(action, QAction)
        self.pad_chosen.emit(action.data())

    def _dock(self, name: str, title: str, panel: QWidget) -> QDockWidget:
        dock = QDockWidget(title, self)
        dock.setObjectName(f"dock-{name}")
        dock.setWidget(panel)
        dock.visibilityChanged.connect(self._note_layout)
        dock.dockLocationChanged.connect(self._note_layout)
        return dock

    def _show_section(self, wanted: bool) -> None:
        self._show_beside(self._section, wanted, SECTION_SHARE)

    def _show_rim(self, wanted: bool) -> None:
        self._show_beside(self._rim, wanted, RIM_SHARE)
        if wanted:
            self._rim.raise_()

    def _show_beside(self, dock: QDockWidget, wanted: bool, share: float) -> None:
        """Give a chart its share of the width when it is shown beside the parameters."""
        (self._wanted_charts.add if wanted else self._wanted_charts.discard)(dock)
        if self.page is not None:
            return
        comes = wanted and dock.isHidden()
        dock.setVisible(wanted)
        if comes:
            # The thickness stays in sight, beside what is selected.
            spare = self.width() - self._fields.width_up_to("insole.thickness_mm")
            width = min(round(share * self.width()), max(spare, LEAST_CHART_PX))
            self.resizeDocks(
                [self._parameters, dock],
                [self.width() - width, width],
                Qt.Orientation.Horizontal,
            )

    def _note_layout(self) -> None:
        if self.isVisible():
            self.layout_changed.emit()

    def showEvent(self, event: QShowEvent) -> None:
        """Fit the toolbar once its buttons have the fonts they are shown in."""
        super().showEvent(event)
        QTimer.singleShot(0, self, self._fit_toolbar)

    def changeEvent(self, event: QEvent) -> None:
        """Fit the toolbar again when targets for touch make its buttons larger or smaller."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.StyleChange:
            QTimer.singleShot(0, self, self._fit_toolbar)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Share what the window gains or loses between the two views, and announce the layout."""
        super().resizeEvent(event)
        if self.isVisible():
            self._sharing.start()
        self._fit_toolbar()
        self._note_layout()

    def _share_width(self) -> None:
        """Let patient and foot keep their shares; Qt gives and takes where it likes."""
        if self._is_restored:
            self._is_restored = False
            self._note_shares()
        patient = min(self._patient_px, round(MOST_OF_PATIENT * self.width()))
        widths = {self._patient: patient}
        if self._is_docked(self._foot):
            widths[self._foot] = round(self._foot_share * (self.width() - patient))
        self.resizeDocks(list(widths), list(widths.values()), Qt.Orientation.Horizontal)
        layout = self.layout()
        assert layout is not None
        layout.invalidate()  # else the sizes count from the next change of the window on
        layout.activate()

    def _note_shares(self) -> None:
        """Note the widths that a hand has given to patient and foot."""
        if self._is_docked(self._patient) and (
            self._patient.width() > self._patient.minimumSizeHint().width()
        ):
            self._patient_px = self._patient.width()  # else only the window was too narrow
        if self._is_docked(self._foot):
            self._foot_share = self._foot.width() / max(self.width() - self._patient.width(), 1)

    def _is_docked(self, dock: QDockWidget) -> bool:
        return dock.isVisible() and not dock.isFloating()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Tell a hand that moves the edge of a panel from a window that grows or shrinks."""
        is_held = bool(QApplication.mouseButtons() & Qt.MouseButton.LeftButton)
        if event.type() == QEvent.Type.Resize and is_held:
            self._note_shares()
        return super().eventFilter(watched, event)

    def _place_docks(self) -> None:
        area = Qt.DockWidgetArea
        self.setCorner(Qt.Corner.BottomLeftCorner, area.BottomDockWidgetArea)
        self.setCorner(Qt.Corner.BottomRightCorner, area.BottomDockWidgetArea)
        self.addDockWidget(area.LeftDockWidgetArea, self._patient)
        self.addDockWidget(area.RightDockWidgetArea, self._foot)
        self.addDockWidget(area.BottomDockWidgetArea, self._parameters)
        self.splitDockWidget(self._parameters, self._section, Qt.Orientation.Horizontal)
        self.tabifyDockWidget(self._section, self._rim)

    def _add_dock_actions(self) -> None:
        view = self._menus[2]
        view.addSeparator()
        for dock in self._docks:
            view.addAction(dock.toggleViewAction())


def _sealed(state: QByteArray) -> str:
    """Return a packed state as text with a checksum: Qt crashes when it restores a damaged one."""
    packed = bytes(state.data())
    return f"{_checksum(packed)}:{base64.b64encode(packed).decode()}"


def _unsealed(text: str) -> bytes | None:
    """Return the packed state, empty if the text is; None if it is damaged."""
    seal, _colon, packed = text.partition(":")
    try:
        state = base64.b64decode(packed, validate=True)
    except ValueError:
        return None
    return state if not text or _checksum(state) == seal else None


def _checksum(packed: bytes) -> str:
    return hashlib.sha256(packed).hexdigest()[:16]


def _tip(record: ActionRecord[Any]) -> str:
    return f"{record.tip()} ({record.shortcut})" if record.shortcut else record.tip()
