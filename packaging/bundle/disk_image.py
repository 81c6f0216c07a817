"""The disk image for macOS, signed and notarised where a certificate is given."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from bundle import product

SCRIPT = product.PACKAGING / "macos" / "sign-and-pack.sh"


def build(version: str) -> list[Path]:
    """Write the disk image of the application."""
    image = product.DIST / f"{product.COMMAND}-{version}-macos-{os.uname().machine}.dmg"
    application = product.DIST / f"{product.NAME}.app"
    subprocess.run(["bash", str(SCRIPT), str(application), str(image)], check=True)
    return [image]
