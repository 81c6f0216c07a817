"""Areas that are scrolled by a finger, and go on by themselves when it lets go."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractScrollArea, QScroller, QScrollerProperties

_OVERSHOOT = QScrollerProperties.ScrollMetric.VerticalOvershootPolicy
_NEVER = QScrollerProperties.OvershootPolicy.OvershootAlwaysOff


def scroll_by_finger(area: QAbstractScrollArea) -> None:
    """Let touches scroll an area; the mouse keeps what it does, so this is no mode."""
    viewport = area.viewport()
    QScroller.grabGesture(viewport, QScroller.ScrollerGestureType.TouchGesture)
    scroller = QScroller.scroller(viewport)
    properties = scroller.scrollerProperties()
    properties.setScrollMetric(_OVERSHOOT, _NEVER)
    scroller.setScrollerProperties(properties)
