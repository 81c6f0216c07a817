"""``python -m insole_studio`` and the command ``insole-studio``."""

from __future__ import annotations

import sys

from insole_studio.cli import run


def main() -> int:
    """Run with the arguments of this process."""
    return run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
