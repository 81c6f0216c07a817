"""Show what a Linux bundle asks of the system: ``python packaging/symbols.py [FOLDER]``."""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from bundle import elf, product
from bundle.debian_packages import packages_for


def main() -> int:
    """Print it; return 1 if the oldest supported system lacks something."""
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else product.FROZEN
    files = [elf.read_elf(path) for path in elf.elf_files(folder)]
    print(f"{len(files)} programs and libraries in {folder}")
    for name, (version, path) in sorted(elf.newest_versions(files).items()):
        allowed = ".".join(map(str, elf.OLDEST_SYSTEMS[name]))
        asked = ".".join(map(str, version))
        print(f"  {name} {asked} (allowed: {allowed}), asked for by {path.relative_to(folder)}")
    asked_of_system = elf.of_the_system(files, folder)
    packages, unknown = packages_for(asked_of_system)
    print(f"{len(asked_of_system)} libraries of the system: {', '.join(sorted(asked_of_system))}")
    print(f"Debian packages: {', '.join(packages)}")
    problems = [*elf.too_new(files), *(f"no package is known for {name}" for name in unknown)]
    print("\n".join(problems) or "Debian 12 and whatever is newer has all of it.")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
