"""The command lines that README, manual and documentation print."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[1]
_BLOCK = re.compile(r"^ *```[^\n]*\n(.*?)^ *```", re.DOTALL | re.MULTILINE)
_INLINE = re.compile(r"`(insole-studio [^`]*)`")
_REMARK = re.compile(r"\s+#.*$|\s{3,}\(.*$")
_SYNOPSIS = re.compile(r"[\[|…]")
"""Brackets, alternatives and dots say what may be given, and cannot be run."""


@dataclass(frozen=True)
class Printed:
    """One command line.

    Parameters
    ----------
    page
        The file, from the root of the project.
    text
        Without the remark behind it.
    in_block
        Whether it stands alone, to be copied, rather than in a sentence.
    """

    page: str
    text: str
    in_block: bool

    @property
    def is_synopsis(self) -> bool:
        return _SYNOPSIS.search(self.text) is not None

    @property
    def words(self) -> list[str]:
        """The arguments of ``insole-studio``."""
        return shlex.split(self.text)[1:]

    @property
    def options(self) -> set[str]:
        return set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]*", self.text))


def printed_commands() -> list[Printed]:
    """Return every command line, in the order of the pages."""
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    return [one for page in pages if "decisions" not in page.parts for one in _of_page(page)]


def _of_page(page: Path) -> Iterator[Printed]:
    text, name = page.read_text("utf-8"), str(page.relative_to(ROOT))
    for block in _BLOCK.finditer(text):
        for line in block[1].replace("\\\n", " ").splitlines():
            command = _REMARK.sub("", line.strip())
            if command.startswith("insole-studio "):
                yield Printed(name, command, in_block=True)
    for inline in _INLINE.finditer(_BLOCK.sub("", text)):
        yield Printed(name, " ".join(inline[1].split()), in_block=False)
