"""The look: Qt's Fusion style with two small palettes and one accent colour."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication

from insole_core.resources import resource_path


@dataclass(frozen=True)
class Colors:
    """The colours of one theme."""

    window: str
    base: str
    raised: str
    text: str
    quiet: str
    line: str
    accent: str
    on_accent: str
    warning: str
    on_warning: str


LIGHT = Colors(
    window="#f1f2f4",
    base="#ffffff",
    raised="#e6e8eb",
    text="#22262a",
    quiet="#5b636b",
    line="#c9ced3",
    accent="#1668b8",
    on_accent="#ffffff",
    warning="#fdf0d5",
    on_warning="#6b4200",
)
DARK = Colors(
    window="#26292d",
    base="#1c1f22",
    raised="#33373c",
    text="#e6e8ea",
    quiet="#a3abb3",
    line="#454b52",
    accent="#4f9fee",
    on_accent="#0b1016",
    warning="#4a3a16",
    on_warning="#ffdf9e",
)


def apply_theme(application: QApplication, dark: bool, touch: bool = False) -> None:
    """Set palette, style and icon colours of the whole application, unless it has them.

    Parameters
    ----------
    application
        The running Qt application.
    dark
        Whether to use the dark palette.
    touch
        Whether to enlarge the controls for touch.
    """
    colors = DARK if dark else LIGHT
    sheet = _style_sheet(colors) + _box_sheet(colors) + _sign_sheet(colors)
    sheet += _touch_sheet(colors) if touch else ""
    if application.styleSheet() == sheet:  # Qt would polish every widget anew
        return
    if not application.styleSheet():
        application.setStyle("Fusion")
    application.setPalette(_palette(colors))
    application.setStyleSheet(sheet)


def _palette(colors: Colors) -> QPalette:
    role = QPalette.ColorRole
    palette = QPalette()
    for name, color in {
        role.Window: colors.window,
        role.Base: colors.base,
        role.AlternateBase: colors.window,
        role.Button: colors.raised,
        role.WindowText: colors.text,
        role.Text: colors.text,
        role.ButtonText: colors.text,
        role.PlaceholderText: colors.quiet,
        role.Highlight: colors.accent,
        role.HighlightedText: colors.on_accent,
        role.Link: colors.accent,
        role.ToolTipBase: colors.raised,
        role.ToolTipText: colors.text,
    }.items():
        palette.setColor(name, QColor(color))
    for name in (role.WindowText, role.Text, role.ButtonText):
        disabled = QColor(colors.quiet)
        disabled.setAlpha(110)
        palette.setColor(QPalette.ColorGroup.Disabled, name, disabled)
    return palette


def _style_sheet(colors: Colors) -> str:
    return f"""
    QLabel#panel-strip {{ background: {colors.raised}; padding: 4px 8px; }}
    QLabel#heading {{ font-weight: 600; color: {colors.quiet}; padding-top: 4px; }}
    QLabel#numbers {{ font-weight: 600; }}
    QLabel#title {{ font-weight: 600; font-size: 15pt; }}
    QLineEdit#search {{ font-size: 12pt; padding: 4px 6px; }}
    QFrame#card {{ background: {colors.base}; border: 1px solid {colors.line};
                   border-radius: 8px; }}
    QLabel#picture {{ background: {colors.window}; border-radius: 4px; }}
    QTableView#rows {{ border: 1px solid {colors.line}; background: {colors.base};
                  selection-background-color: {colors.accent};
                  selection-color: {colors.on_accent}; }}
    QTableView#rows QHeaderView {{ background: {colors.base}; }}
    QTableView#rows QHeaderView::section {{ background: {colors.base}; color: {colors.quiet};
                            border: none; border-bottom: 1px solid {colors.line};
                            padding: 4px 11px; }}
    QTableView#rows::item {{ padding: 4px 8px; }}
    QTableView#rows:focus {{ border: 2px solid {colors.accent}; }}
    QLabel#quiet {{ color: {colors.quiet}; }}
    QLabel#warning {{ background: {colors.warning}; color: {colors.on_warning};
                      border-radius: 4px; padding: 4px 8px; }}
    QPushButton#warning_count {{ background: {colors.warning}; color: {colors.on_warning};
                                 border: none; border-radius: 4px; padding: 2px 8px; }}
    QPushButton#warning_count:focus {{ border: 2px solid {colors.accent}; }}
    QToolBar {{ border: none; border-bottom: 1px solid {colors.line};
                spacing: 1px; padding: 2px; }}
    QToolBar QToolButton {{ padding: 4px; border-radius: 4px; }}
    QToolButton:checked {{ background: {colors.accent}; color: {colors.on_accent};
                           border-radius: 4px; }}
    QToolButton#fold {{ font-weight: 600; color: {colors.quiet}; padding: 4px 4px 0 0; }}
    QToolButton#fold:checked {{ background: transparent; color: {colors.quiet}; }}
    QToolButton:checked:disabled {{ background: {colors.raised}; color: {colors.quiet}; }}
    QLabel#check-sign {{ border-radius: 11px; font-weight: 700; background: {colors.raised}; }}
    QLabel#check-sign[state="passed"] {{ background: #1b7a3d; color: white; }}
    QLabel#check-sign[state="warning"] {{ background: {colors.warning};
                                          color: {colors.on_warning}; }}
    QLabel#check-sign[state="blocking"] {{ background: #b3261e; color: white; }}
    QPushButton#row {{ text-align: left; padding: 4px 6px; border: none; border-radius: 4px; }}
    QPushButton#row:checked {{ background: {colors.accent}; color: {colors.on_accent}; }}
    QPushButton#primary {{ background: {colors.accent}; color: {colors.on_accent};
                           border: none; border-radius: 4px; padding: 8px 16px; font-weight: 600; }}
    QPushButton#primary:disabled {{ background: {colors.raised}; color: {colors.quiet}; }}
    QPushButton#primary:focus {{ border: 2px solid {colors.text}; padding: 6px 14px; }}
    QToolButton#step {{ border: none; padding: 3px 6px; color: {colors.quiet}; }}
    QToolButton#step[state="current"] {{ color: {colors.text}; font-weight: 600; }}
    QToolButton:focus, QPushButton#row:focus, QToolButton#step:focus,
    QToolButton#warning-row:focus {{ border: 2px solid {colors.accent}; border-radius: 4px; }}
    QToolButton:checked:focus, QPushButton#row:checked:focus {{ border-color: {colors.text}; }}
    QCheckBox:focus, QRadioButton:focus, QLabel:focus {{ border: 2px solid {colors.accent};
                                                        border-radius: 4px; }}
    QToolButton#step[state="done"] {{ color: {colors.text}; }}
    QToolButton#step:disabled {{ color: {colors.quiet}; font-weight: 400; }}
    QToolButton#warning-row {{ background: {colors.warning}; color: {colors.on_warning};
                               border-radius: 4px; padding: 3px 8px; text-align: left; }}
    QFrame#notice {{ background: {colors.raised}; border-left: 4px solid {colors.accent}; }}
    QFrame#tour {{ background: {colors.base}; border: 2px solid {colors.accent};
                   border-radius: 8px; }}
    QDockWidget::title {{ background: {colors.raised}; padding: 4px 8px; }}
    QMainWindow::separator {{ background: {colors.line}; width: 3px; height: 3px; }}
    QMenu {{ menu-scrollable: 1; }}
    QMenu::item {{ padding: 4px 20px; border: 1px solid transparent; }}
    QMenu::item:selected {{ background: {colors.raised}; border-color: {colors.accent}; }}
    QMenu::indicator {{ left: 5px; }}
    QMenu::separator {{ height: 1px; background: {colors.line}; margin: 2px 0; }}
    QMenu::icon {{ left: 5px; border: 1px solid transparent; border-radius: 4px; }}
    QMenu::icon:checked {{ background: {colors.accent}; border-color: {colors.on_accent}; }}
    QStatusBar {{ border-top: 1px solid {colors.line}; }}
    QStatusBar::item {{ border: none; }}
    """


def _box_sheet(colors: Colors) -> str:
    """Return the style sheet of boxes to tick: Fusion's have no edge that is seen on dark."""
    check = _sign("check", colors)
    return f"""
    QCheckBox::indicator, QAbstractItemView::indicator, QMenu::indicator:non-exclusive {{
        width: 14px; height: 14px; border: 1px solid {colors.quiet}; border-radius: 3px;
        background: {colors.base}; }}
    QCheckBox::indicator:checked, QAbstractItemView::indicator:checked,
    QMenu::indicator:non-exclusive:checked {{
        background: {colors.accent}; border-color: {colors.accent}; image: url("{check}"); }}
    QRadioButton {{ border: 2px solid transparent; padding: 2px; }}
    QRadioButton::indicator {{
        width: 14px; height: 14px; border: 1px solid {colors.quiet}; border-radius: 8px;
        background: {colors.base}; }}
    QRadioButton::indicator:checked {{
        width: 6px; height: 6px; border: 5px solid {colors.accent}; }}
    QRadioButton::indicator:disabled {{ border-color: {colors.line}; }}
    QCheckBox::indicator:disabled {{ border-color: {colors.line}; background: {colors.window}; }}
    QCheckBox::indicator:checked:disabled {{ background: {colors.quiet}; }}
    """


def _sign_sheet(colors: Colors) -> str:
    """Return the style sheet of signs of panels, toolbars, files: Qt's own are dark on dark."""
    close, more = _sign("close", colors), _sign("more", colors)
    return f"""
    QDockWidget {{ titlebar-close-icon: url("{close}"); dockwidget-close-icon: url("{close}");
                   titlebar-normal-icon: url("{_sign("float", colors)}"); }}
    QToolButton#qt_toolbar_ext_button {{ qproperty-icon: url("{more}"); }}
    QFileDialog {{ backward-icon: url("{_sign("back", colors)}");
                   forward-icon: url("{_sign("forward", colors)}");
                   filedialog-parent-directory-icon: url("{_sign("up", colors)}"); }}
    """


def _sign(name: str, colors: Colors) -> str:
    """Return the file of a sign that is seen in a theme."""
    return resource_path(f"icons/{name}-{'dark' if colors is DARK else 'light'}.svg").as_posix()


def _touch_sheet(colors: Colors) -> str:
    """Return the style sheet for touch: controls at least 44 pixels high, plus beside minus."""
    plus, minus = (resource_path(f"icons/{name}.svg").as_posix() for name in ("plus", "minus"))
    return f"""
    QToolButton, QPushButton, QComboBox, QLineEdit, QAbstractSpinBox {{ min-height: 40px; }}
    QToolButton {{ min-width: 40px; }}
    QToolBar QToolButton {{ padding: 4px 2px; }}
    QCheckBox, QRadioButton, QTabBar::tab, QAbstractItemView::item {{ min-height: 44px; }}
    QAbstractSpinBox {{ border: 1px solid {colors.line}; border-radius: 4px; min-height: 42px;
                        background: {colors.base}; padding-right: 90px; }}
    QAbstractSpinBox:focus {{ border: 2px solid {colors.accent}; }}
    QAbstractSpinBox::up-button, QAbstractSpinBox::down-button {{
        subcontrol-origin: border; subcontrol-position: center right; width: 44px; height: 42px;
        background: {colors.raised}; border: none; border-left: 1px solid {colors.line}; }}
    QAbstractSpinBox::down-button {{ right: 45px; }}
    QAbstractSpinBox::up-button:pressed, QAbstractSpinBox::down-button:pressed {{
        background: {colors.line}; }}
    QAbstractSpinBox::up-arrow {{ image: url("{plus}"); width: 22px; height: 22px; }}
    QAbstractSpinBox::down-arrow {{ image: url("{minus}"); width: 22px; height: 22px; }}
    QLineEdit, QPlainTextEdit {{ border: 1px solid {colors.line}; border-radius: 4px; }}
    QLineEdit:focus, QPlainTextEdit:focus {{ border: 2px solid {colors.accent}; }}
    QAbstractSpinBox QLineEdit, QComboBox QLineEdit {{ border: none; min-height: 0; }}
    QLineEdit QToolButton {{ min-width: 0; min-height: 0; }}
    QLabel[form="true"] {{ min-height: 44px; }}
    QMenu::item, QMenuBar::item {{ padding: 12px 20px; }}
    QMenuBar::item:selected {{ background: {colors.raised}; }}
    QMenu::icon, QMenu::indicator {{ left: 8px; }}
    QMenu::separator {{ height: 1px; background: {colors.line}; }}
    QMenu::scroller {{ height: 44px; }}
    """
