"""What each package says of itself: the names that a reader begins with are there."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGES = sorted(
    init.parent
    for source in ("app/insole_studio", "insole_core", "drivers/kinect/kinect_v1")
    for init in (ROOT / source).rglob("__init__.py")
)
NAME = re.compile(r"``([A-Za-z_][\w.]*)``")


def defined(module: Path) -> Iterator[str]:
    """What a module defines, or takes from the modules below its package."""
    for node in ast.parse(module.read_text("utf-8")).body:
        match node:
            case ast.FunctionDef() | ast.ClassDef():
                yield node.name
            case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
                yield name
            case ast.ImportFrom():
                yield from (alias.asname or alias.name for alias in node.names)


def is_there(name: str, package: Path) -> bool:
    """Whether a name is one of the package, a module in it, or one of such a module."""
    first, *rest = name.split(".")
    below = package / first
    module = below / "__init__.py" if below.is_dir() else below.with_suffix(".py")
    if not module.exists():
        return not rest and first in defined(package / "__init__.py")
    return not rest or rest[0] in defined(module)


@pytest.mark.parametrize("package", PACKAGES, ids=lambda package: package.name)
def test_a_package_says_where_to_begin(package: Path) -> None:
    said = ast.get_docstring(ast.parse((package / "__init__.py").read_text("utf-8")))
    assert said, "a package's docstring says what it holds"
    assert [name for name in NAME.findall(said) if not is_there(name, package)] == []
