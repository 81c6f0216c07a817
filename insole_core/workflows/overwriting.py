"""A result must not take the place of what it is made from."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from insole_core.errors import UsageError
from insole_core.recording.hand_edits_file import edits_path
from insole_core.recording.writer import is_input_name
from insole_core.regular_file import is_folder


def check_overwriting(outputs: Iterable[Path], inputs: Iterable[Path]) -> None:
    """Check that no output is an input, under whatever name, nor a file that an input consists of.

    Parameters
    ----------
    outputs
        Files and folders to write; they need not exist.
    inputs
        Files, and folders of recordings or pictures.

    Raises
    ------
    UsageError
        Names the first output that is an input.
    """
    read = list(inputs)
    for output in outputs:
        if any(_is_part_of(output, path) for path in read):
            raise UsageError(
                "{path} is read to make the result, which would replace it; give the result "
                "another name.",
                path=output,
            )


def _is_part_of(output: Path, source: Path) -> bool:
    if is_folder(source):
        return _is_same(output, source) or _is_in(output, source)
    others = [edits_path(source)] if source.suffix.lower() == ".zip" else []
    return any(_is_same(output, path) for path in (source, *others))


def _is_in(output: Path, folder: Path) -> bool:
    """Tell whether an output has a name that is read in a folder, or is such a file."""
    real = Path(os.path.realpath(output))
    if is_input_name(real.name) and real.is_relative_to(os.path.realpath(folder)):
        return True
    return output.is_file() and any(_is_same(output, path) for path in _read_in(folder))


def _read_in(folder: Path) -> Iterator[Path]:
    for place, _, files in os.walk(folder):
        yield from (Path(place, name) for name in files if is_input_name(name))


def _is_same(output: Path, source: Path) -> bool:
    try:
        return output.samefile(source)
    except OSError:  # one of them does not exist
        return os.path.realpath(output) == os.path.realpath(source)
