"""The installer for Windows; Inno Setup 6 has to be installed."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

from bundle import product

SCRIPT = product.PACKAGING / "windows" / "insole-studio.iss"
USUAL_COMPILER = Path("C:/Program Files (x86)/Inno Setup 6/ISCC.exe")


def build(version: str) -> list[Path]:
    """Write the installer of the frozen program."""
    compiler = shutil.which("iscc") or str(USUAL_COMPILER)
    call = [compiler, "/Q", f"/DAppVersion={version}", f"/O{product.DIST}", str(SCRIPT)]
    subprocess.run(call, check=True)
    return [product.DIST / f"{product.COMMAND}-{version}-setup.exe"]
