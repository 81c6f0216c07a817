"""Trains the weights that the product ships with, on simulated feet; README.md says how."""
