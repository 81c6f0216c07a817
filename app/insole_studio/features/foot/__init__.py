"""From a session to a foot: markers and volume corrected by hand.

``foot_window.FootWindow``.
"""
