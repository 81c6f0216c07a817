"""Pressure maps and footprints under the foot."""
