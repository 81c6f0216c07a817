"""Help ▸ Examine this computer: what `Doctor` finds, examined while the window goes on."""

from __future__ import annotations

from html import escape

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QWidget
from shiboken6 import isValid

from insole_studio.app.doctor import Diagnosis, Doctor, FindSensors, report_lines
from insole_studio.app.graphics import examine_graphics
from insole_studio.app.text_dialog import TextDialog
from insole_studio.services.app_services import AppServices
from insole_studio.texts import tr, translate_core_message

CHANNEL = "doctor"


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
