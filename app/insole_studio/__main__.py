"""``python -m insole_studio`` and the command ``insole-studio``."""

from __future__ import annotations

import os
import sys

LINEAR_ALGEBRA_THREADS = (
    "OPENBLAS_NUM_THREADS",
    "OPENBLAS_DEFAULT_NUM_THREADS",
    "GOTO_NUM_THREADS",
    "OMP_NUM_THREADS",
    "MKL_NUM_THREADS",
    "BLIS_NUM_THREADS",
    "VECLIB_MAXIMUM_THREADS",
)
"""What the libraries behind numpy, SciPy and OpenCV read when they are loaded."""


def main() -> int:
    """Run with the command line arguments of this process."""
    if getattr(sys, "frozen", False):  # the process of the sensors starts the same program
        from multiprocessing import freeze_support

        freeze_support()
    # Whatever the user has set: with other threads the sums of a matrix product are taken in
    # another order, and the same session gives another mesh (docs/decisions/0024).
    os.environ.update(dict.fromkeys(LINEAR_ALGEBRA_THREADS, "1"))
    from insole_studio.cli.main import run

    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
