"""``python -m benchmarks [NAME …]``: run all benchmarks or the named ones, a process each.

A benchmark is a module in this folder with a function ``main() -> None`` that prints a table; it
measures the product side by side with a peer in one run and states the limit. Separate processes
keep imports and memory of one benchmark from affecting the next.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).parent


def names() -> list[str]:
    return sorted(path.stem for path in FOLDER.glob("*.py") if not path.stem.startswith("_"))


def main(wanted: list[str]) -> int:
    unknown = set(wanted) - set(names())
    if unknown:
        print(f"There is no benchmark {', '.join(unknown)}; there are: {', '.join(names())}.")
        return 2
    # As in the product: threads of OpenBLAS beside its own would only wait for each other.
    environment = {"OPENBLAS_NUM_THREADS": "1", **os.environ}
    failed = 0
    for name in wanted or names():
        print(f"\n== {name} ==", flush=True)
        call = f"import benchmarks.{name} as b; b.main()"
        done = subprocess.run(
            [sys.executable, "-c", call], check=False, cwd=FOLDER.parent, env=environment
        )
        failed += done.returncode != 0
    return min(failed, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
