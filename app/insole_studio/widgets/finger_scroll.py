"""Kinetic scrolling by touch."""

from __future__ import annotations

from PySide6.QtWidgets import QAbstractScrollArea, QScroller, QScrollerProperties

_OVERSHOOT = QScrollerProperties.ScrollMetric.VerticalOvershootPolicy
_NEVER = QScrollerProperties.OvershootPolicy.OvershootAlwaysOff


def scroll_by_finger(area: QAbstractScrollArea) -> None:
    """Enable kinetic scrolling by touch; the mouse works as before."""
    viewport = area.viewport()
    QScroller.grabGesture(viewport, QScroller.ScrollerGestureType.TouchGesture)
    scroller = QScroller.scroller(viewport)
    properties = scroller.scrollerProperties()
    properties.setScrollMetric(_OVERSHOOT, _NEVER)
    scroller.setScrollerProperties(properties)
