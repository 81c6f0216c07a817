"""The package for Debian and Ubuntu."""

from __future__ import annotations

import gzip
import json
import os
import shutil
import subprocess
from pathlib import Path

from bundle import product, shrink

LINUX = product.PACKAGING / "linux"
SCRIPTS = ("postinst", "postrm")
CONTROL = """\
Package: {command}
Version: {version}
Architecture: {architecture}
Maintainer: Insole Studio maintainers <maintainers@insole-studio.org>
Installed-Size: {kilobytes}
Section: science
Priority: optional
Homepage: https://insole-studio.org
Depends: {depends}
Recommends: fonts-dejavu-core, xdg-desktop-portal
Description: {summary}
 Scan feet with low-cost 3-D sensors or open scans of other programs,
 design insoles by device and finding, check them, and hand them to the shop
 as closed solids. Keeps the clinic's record of patients and orders.
 .
 Removing the package leaves patients, settings and backups where they are.
"""


def build(version: str) -> list[Path]:
    """Write the package of the frozen program."""
    tree = product.BUILD / "deb"
    shutil.rmtree(tree, ignore_errors=True)
    _install(tree)
    architecture = _output("dpkg", "--print-architecture")
    control = tree / "DEBIAN"
    control.mkdir()
    (control / "control").write_text(
        CONTROL.format(
            command=product.COMMAND,
            version=version,
            architecture=architecture,
            kilobytes=shrink.size_of(tree) // 1024,
            depends=", ".join(json.loads((product.BUILD / "depends.json").read_text())),
            summary=product.SUMMARY,
        ),
        encoding="utf-8",
    )
    for name in SCRIPTS:
        _copy(LINUX / name, control / name, 0o755)
    package = product.DIST / f"{product.COMMAND}_{version}_{architecture}.deb"
    call = ["dpkg-deb", "--root-owner-group", "-Zxz", "-z6", "--build", str(tree), str(package)]
    subprocess.run(call, check=True, stdout=subprocess.DEVNULL)
    shutil.rmtree(tree)
    return [package]


def _install(tree: Path) -> None:
    """Put the files where the system looks for them."""
    program = tree / "usr/lib" / product.COMMAND
    shutil.copytree(product.FROZEN, program, symlinks=True, copy_function=_link_or_copy)
    command = tree / "usr/bin" / product.COMMAND
    command.parent.mkdir(parents=True)
    command.symlink_to(f"../lib/{product.COMMAND}/{product.COMMAND}")
    share = tree / "usr/share"
    name = product.COMMAND
    icons = share / "icons/hicolor/scalable"
    _copy(LINUX / f"{name}.desktop", share / "applications" / f"{name}.desktop")
    _copy(LINUX / f"{name}.mime.xml", share / "mime/packages" / f"{name}.xml")
    _copy(product.ROOT / "resources/icons" / f"{name}.svg", icons / "apps" / f"{name}.svg")
    mime_icon = f"{product.CASE_MIME_TYPE.replace('/', '-')}.svg"
    _copy(product.ROOT / "resources/icons" / f"{name}.svg", icons / "mimetypes" / mime_icon)
    for rule in product.UDEV_RULES:
        _copy(rule, tree / "usr/lib/udev/rules.d" / rule.name)
    documents = share / "doc" / name
    _copy(product.ROOT / "LICENSE", documents / "copyright")
    changes = (product.ROOT / "CHANGELOG.md").read_bytes()
    (documents / "changelog.gz").write_bytes(gzip.compress(changes, mtime=0))
    put_manual(program, documents / "manual")


def put_manual(program: Path, site: Path) -> None:
    """Put the manual where browsers in a sandbox may read, as Ubuntu's is (decision 0025)."""
    bundled = next(program.glob("**/_resources/manual"))
    bundled.rename(site)
    bundled.symlink_to(os.path.relpath(site, bundled.parent))


def _link_or_copy(source: str, target: str) -> None:
    """Take no room for a second copy of the program while the package is made."""
    try:
        Path(target).hardlink_to(source)
    except OSError:
        shutil.copy2(source, target)


def _copy(source: Path, target: Path, mode: int = 0o644) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, target)
    target.chmod(mode)


def _output(*call: str) -> str:
    return subprocess.run(call, capture_output=True, text=True, check=True).stdout.strip()
