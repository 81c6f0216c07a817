"""``python -m insole_studio`` and the command ``insole-studio``."""

from __future__ import annotations

import os
import sys


def main() -> int:
    """Run with the command line arguments of this process."""
    # Our systems of equations are small: threads of OpenBLAS beside our own only wait for each
    # other and triple the processor time. It reads this variable when numpy is imported.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    from insole_studio.cli.main import run

    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
