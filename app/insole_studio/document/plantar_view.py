"""How pressure map and footprint of the active foot are shown and worked on."""

from __future__ import annotations

from enum import StrEnum

from PySide6.QtCore import QObject, Signal

from insole_core.cases.case_record import FootRecord
from insole_core.pressure.laid_map import FootprintPicture, Placement, PlantarLayers, PressureMap
from insole_core.workflows.plantar_pressure import with_picture, with_pressure


class PlantarLayer(StrEnum):
    """One of the two that can lie under a foot."""

    PRESSURE = "pressure"
    PICTURE = "picture"


class PlantarView(QObject):
    """The layer that is shown and moved, and its opacity: a preference, no part of the case."""

    changed = Signal()

    def __init__(self, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.opacity = 0.85
        self._wanted = PlantarLayer.PRESSURE

    def set_opacity(self, opacity: float) -> None:
        """Show the layer more or less opaque, 0 to 1."""
        self.opacity = opacity
        self.changed.emit()

    def want(self, layer: PlantarLayer) -> None:
        """Show and move a layer, where there are two."""
        self._wanted = layer
        self.changed.emit()

    def layer(self, plantar: PlantarLayers) -> PlantarLayer | None:
        """Return which layer is shown; None where nothing lies under the foot."""
        there = {
            PlantarLayer.PRESSURE: plantar.pressure is not None,
            PlantarLayer.PICTURE: plantar.picture is not None,
        }
        if there[self._wanted]:
            return self._wanted
        return next((layer for layer, is_there in there.items() if is_there), None)

    def shown(self, plantar: PlantarLayers) -> PressureMap | FootprintPicture | None:
        """Return what is shown of the layers."""
        layer = self.layer(plantar)
        if layer is None:
            return None
        return plantar.pressure if layer is PlantarLayer.PRESSURE else plantar.picture

    def placed(self, foot: FootRecord, placement: Placement) -> FootRecord:
        """Return a foot with the shown layer at another place."""
        shown = self.shown(foot.plantar)
        if isinstance(shown, PressureMap):
            return with_pressure(foot, shown.placed(placement))
        if isinstance(shown, FootprintPicture):
            return with_picture(foot, shown.placed(placement))
        return foot

    def without(self, foot: FootRecord) -> FootRecord:
        """Return a foot without the shown layer."""
        if self.layer(foot.plantar) is PlantarLayer.PRESSURE:
            return with_pressure(foot, None)
        return with_picture(foot, None)
