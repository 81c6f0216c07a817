"""The archive for Linux systems without Debian's packages: unpack it anywhere."""

from __future__ import annotations

import platform
import shutil
import subprocess
from pathlib import Path

from bundle import product

LINUX = product.PACKAGING / "linux"


def build(version: str) -> list[Path]:
    """Write the archive of the frozen program, with what a user can install by hand."""
    name = f"{product.COMMAND}-{version}-{platform.system().lower()}-{platform.machine()}"
    tree = product.BUILD / "archive" / name
    shutil.rmtree(tree.parent, ignore_errors=True)
    shutil.copytree(product.FROZEN, tree, symlinks=True)
    for source in (
        LINUX / "README.txt",
        *product.UDEV_RULES,
        LINUX / f"{product.COMMAND}.desktop",
        LINUX / f"{product.COMMAND}.mime.xml",
        product.ROOT / "resources/icons" / f"{product.COMMAND}.svg",
        product.ROOT / "LICENSE",
    ):
        shutil.copyfile(source, tree / source.name)
    target = product.DIST / f"{name}.tar.xz"
    call = [
        "tar", "--create", "--sort=name", "--owner=0", "--group=0", "--numeric-owner",
        "--use-compress-program=xz -6 -T2", "--file", str(target), "--directory", str(tree.parent),
        name,
    ]  # fmt: skip
    subprocess.run(call, check=True)
    shutil.rmtree(tree.parent)
    return [target]
