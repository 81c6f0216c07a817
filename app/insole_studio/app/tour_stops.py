"""The five stops of the first-start tour."""

from __future__ import annotations

from insole_studio.features.design.stage import DesignStage
from insole_studio.texts import tr
from insole_studio.widgets.tour import Stop


def tour_stops(stage: DesignStage) -> tuple[Stop, ...]:
    """Return the stops in the order of the work."""
    return (
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
            stage.section,
            tr("The section"),
            tr("Cut the insole anywhere and read its thickness. Then export: Ctrl+E."),
        ),
    )
