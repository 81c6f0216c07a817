"""What is seen of an insole beside what is exported, after random edits, drags, undos and redos.

    python -m benchmarks seen_and_exported

Limits: every drawn vertex, of faces, edges and walls, lies within 0.001 mm of one of the export,
and every drawn normal within 1 degree of that of the surface. A test does the same with a few
sequences.
"""

from __future__ import annotations

import os

import numpy as np

from benchmarks._measure import print_table
from benchmarks._random_designs import random_foot

SEQUENCES, PER_FOOT = 300, 50
LIMITS = 0.001, 1.0
"""mm and degrees."""


def main() -> None:
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from PySide6.QtWidgets import QApplication

    from benchmarks._random_edits import EDITS, random_sequence

    _application = QApplication.instance() or QApplication([])
    feet = [random_foot(seed) for seed in range(SEQUENCES // PER_FOOT)]
    found = [random_sequence(feet[n // PER_FOOT], n) for n in range(SEQUENCES)]
    made = [seen for seen in found if seen is not None]
    apart, turned = np.array([(s.apart_mm, s.turned_deg) for s in made]).T
    beyond = int(((apart > LIMITS[0]) | (turned > LIMITS[1])).sum())
    print_table(
        (
            "sequences", "edits each", "that can be made", "worst, mm (<= 0.001)",
            "worst normal, degrees (<= 1)", "beyond (0)",
        ),
        [
            (
                SEQUENCES, EDITS, len(made), f"{apart.max():.6f}", f"{turned.max():.3f}", beyond,
            )
        ],
    )  # fmt: skip
