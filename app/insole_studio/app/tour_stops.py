"""The stops of the tour: through a whole insole, from the first page to the written file."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtWidgets import QWidget

from insole_core.cases.case_record import CaseRecord
from insole_studio.app.features import Features
from insole_studio.app.main_window import MainWindow
from insole_studio.document.case import Case
from insole_studio.texts import tr
from insole_studio.widgets.tour import IsDone, Stop


def tour_stops(
    features: Features, window: MainWindow, case: Case, show_panels: Callable[[], object]
) -> tuple[Stop, ...]:
    """Return the stops in the order of the work; each ends when the user has done what it says.

    Parameters
    ----------
    show_panels
        Leads from a page of the record back to the open case.
    """
    return _TourOfWork(features, window, case, show_panels).stops()


class _TourOfWork:
    """Knows where in the window each stop is, and what tells that it is done."""

    def __init__(
        self,
        features: Features,
        window: MainWindow,
        case: Case,
        show_panels: Callable[[], object],
    ) -> None:
        self._features = features
        self._window = window
        self._case = case
        self._show_panels = show_panels
        self._stage = features.design.stage

    def stops(self) -> tuple[Stop, ...]:
        """Return all stops."""
        return (*self._stops_of_foot(), *self._stops_of_design(), *self._stops_of_export())

    def _stops_of_foot(self) -> tuple[Stop, ...]:
        return (
            Stop(
                tr("A scan"),
                tr(
                    "An insole begins with a scan: captured with the sensors, or imported from any "
                    "scanner. Click on “Open the example”, whose scan is done."
                ),
                self._example_button,
                lambda: self._has_foot,
                self._show_foot,
            ),
            Stop(
                tr("The foot"),
                tr(
                    "Here is the scanned foot; the landmarks on its skin were found. Choose "
                    "“Landmarks” to see and correct them."
                ),
                lambda: self._window.tool_button("tool_key_point"),
                lambda: lambda: self._stage.tool_controller.tool.key == "key_point",
            ),
            Stop(
                tr("The landmarks"),
                tr(
                    "Drag a landmark to where it belongs. The insole follows at once, and Ctrl+Z "
                    "takes it back. Skip this if all of them are right."
                ),
                lambda: self._stage.foot,
                self._until_changed,
            ),
        )

    def _stops_of_design(self) -> tuple[Stop, ...]:
        return (
            Stop(
                tr("The design"),
                tr("Now a pad behind the metatarsal heads. Choose the tool “Pelott”."),
                lambda: self._window.tool_button("tool_pelott"),
                lambda: lambda: self._stage.tool_controller.tool.key == "pelott",
            ),
            Stop(
                tr("A pelott"),
                tr(
                    "Click on the sole where it shall be. The example has one already: drag that "
                    "one to another place."
                ),
                lambda: self._stage.foot,
                self._until_changed,
            ),
            Stop(
                tr("The numbers"),
                tr(
                    "What is selected, in mm and degrees. Give the pelott another height: click "
                    "into its field and type it, or turn the wheel there."
                ),
                lambda: self._stage.parameters,
                self._until_changed,
            ),
            Stop(
                tr("The section"),
                tr("Choose “Section” to cut the insole anywhere and read its thickness."),
                lambda: self._window.tool_button("tool_section"),
                lambda: lambda: self._stage.tool_controller.tool.key == "section",
            ),
            Stop(
                tr("The cut"),
                tr("Click on the sole where the insole shall be cut, or drag the line to there."),
                lambda: self._stage.foot,
                self._until_cut,
            ),
            Stop(
                tr("The profile"),
                tr(
                    "That is the insole in the cut, the foot on it, and how thick it is where you "
                    "point. The × of the panel closes it."
                ),
                lambda: self._stage.section,
            ),
        )

    def _stops_of_export(self) -> tuple[Stop, ...]:
        return (
            Stop(
                tr("Check & export"),
                tr("The insole is designed. Click on “Check & export” to check it for the shop."),
                lambda: self._window.tool_button("export"),
                lambda: lambda: self._features.export.stage is not None,
            ),
            Stop(
                tr("The file"),
                tr(
                    "The checks stand on the right, each with its number; a click shows the place. "
                    "Click on “Export…” and say where to write the file."
                ),
                self._export_button,
                self._until_exported,
            ),
            Stop(
                tr("Done"),
                tr(
                    "The file is written: that was a whole insole. For a patient, begin with “New "
                    "patient…” on the first page (F3); F1 explains what is in front of you."
                ),
                lambda: self._stage.steps,
            ),
        )

    def _example_button(self) -> QWidget | None:
        start = self._features.records.start
        return None if start is None else start.example

    def _export_button(self) -> QWidget:
        """Give the button of the stage, or that which opens the stage, if it was closed."""
        stage = self._features.export.stage
        return self._window.tool_button("export") if stage is None else stage.view.export

    def _has_foot(self) -> bool:
        return self._window.page is None and self._case.foot is not None

    def _show_foot(self) -> None:
        """Go on with the foot of the open case, or with that of the example."""
        if self._case.foot is None:
            self._features.case_files.opener.open_example()
        else:
            self._show_panels()

    def _until_cut(self) -> IsDone:
        before = self._stage.cut.plane
        return lambda: self._stage.cut.plane not in (before, None)

    def _until_changed(self) -> IsDone:
        before = self._case.record
        return lambda: self._is_designed_further(before)

    def _is_designed_further(self, before: CaseRecord) -> bool:
        """Return whether feet or design have changed, and nothing is being dragged any more."""
        case = self._case
        return case.record.feet is not before.feet and case.shown is case.record

    def _until_exported(self) -> IsDone:
        before = self._features.export.exported
        return lambda: self._features.export.exported is not before
