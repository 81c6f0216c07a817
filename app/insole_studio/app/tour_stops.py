"""The five stops of the first-start tour."""

from __future__ import annotations

from PySide6.QtWidgets import QWidget

from insole_studio.features.design.stage import DesignStage
from insole_studio.texts import tr
from insole_studio.widgets.tour import Stop


def tour_stops(stage: DesignStage, section_tool: QWidget) -> tuple[Stop, ...]:
    """Return the stops in the order of the work; what is hidden is not explained.

    Parameters
    ----------
    stage
        With the panels.
    section_tool
        The button that shows the section.
    """
    stops = (
        Stop(
            stage.steps,
            tr("The path"),
            tr("From patient to insole in five steps. Click on a step to go there."),
        ),
        Stop(
            stage.foot,
            tr("The foot"),
            tr(
                "Open a scan here. Drag the landmarks to where they belong; click on the sole with"
                " the pelott tool to place a pad."
            ),
        ),
        Stop(
            stage.insole,
            tr("The insole"),
            tr("It follows at once. The same handles work here; keys 1 to 6 look from all sides."),
        ),
        Stop(
            stage.parameters,
            tr("The numbers"),
            tr("What is selected, in mm and degrees: type, scroll, or use the arrow keys."),
        ),
        Stop(
            section_tool,
            tr("The section"),
            tr("Cut the insole anywhere and read its thickness. Then export: Ctrl+E."),
        ),
    )
    return tuple(stop for stop in stops if stop.widget.isVisible())
