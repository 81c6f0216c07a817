"""Put the catalogues into order and compile them: `python resources/translations/make.py`.

A language is a folder; a catalogue in it holds the texts of one part of the window. They are sorted
by the English text, so that two hands that add texts rarely touch the same line.
"""

from __future__ import annotations

import subprocess
from pathlib import Path
from xml.etree import ElementTree

import PySide6

RELEASE = Path(PySide6.__file__).parent / "lrelease"
HEADER = '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'


def sort_texts(path: Path) -> None:
    """Write the catalogue again, its texts in order."""
    root = ElementTree.parse(path).getroot()
    for context in root.iter("context"):
        context[1:] = sorted(context[1:], key=lambda message: message.findtext("source", ""))
    ElementTree.indent(root, "    ")
    path.write_text(HEADER + ElementTree.tostring(root, encoding="unicode") + "\n", "utf-8")


def main() -> None:
    """Sort and compile every catalogue."""
    for path in sorted(Path(__file__).parent.glob("*/*.ts")):
        sort_texts(path)
        command = [RELEASE, "-silent", path, "-qm", path.with_suffix(".qm")]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
