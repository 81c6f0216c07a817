"""Build what users install: ``python packaging/build.py``; see packaging/README.md.

Each system builds its own. Everything is written to ``dist/``.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

from bundle import archive, checksums, deb, disk_image, freeze, installer, product

FORMATS: dict[str, dict[str, Callable[[str], list[Path]]]] = {
    "linux": {"deb": deb.build, "tar": archive.build},
    "win32": {"installer": installer.build},
    "darwin": {"dmg": disk_image.build},
}
"""By system: names of what it can build, and how."""


def main() -> int:
    """Build; return the exit code."""
    formats = FORMATS[sys.platform]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--formats", nargs="*", choices=list(formats), default=list(formats),
        help="what to build from the frozen program; without names only that",
    )  # fmt: skip
    parser.add_argument(
        "--sign", metavar="KEY",
        help="sign the checksums: a key of GnuPG, or a key file of minisign",
    )  # fmt: skip
    chosen = parser.parse_args()
    try:
        version = freeze.freeze()
    except freeze.UnfitError as reason:
        print(reason, file=sys.stderr)
        return 1
    built = [path for name in chosen.formats for path in formats[name](version)]
    built.append(_published_bill(version))
    listed = checksums.write_checksums(built, product.DIST)
    if chosen.sign:
        checksums.sign(listed, chosen.sign)
    for path in [*built, listed]:
        print(f"{path}  {path.stat().st_size / 1e6:.1f} MB")
    return 0


def _published_bill(version: str) -> Path:
    bill = product.DIST / f"{product.COMMAND}-{version}.cdx.json"
    bill.write_bytes((product.BUILD / "licences" / "sbom.cdx.json").read_bytes())
    return bill


if __name__ == "__main__":
    sys.exit(main())
