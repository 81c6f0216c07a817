"""The streams of the command line: no control character of a file gets to a terminal."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any, TextIO

from insole_core.visible_text import visible


class _VisibleStream:
    """A text stream that writes `visible` text; all else is that of the stream itself."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        """Write a text; return its length."""
        self._stream.write(visible(text))
        return len(text)

    def writelines(self, lines: Iterable[str]) -> None:
        """Write each of some texts."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def visible_streams() -> Iterator[None]:
    """Let all that is printed meanwhile, tracebacks and warnings included, be visible text."""
    streams: tuple[Any, Any] = sys.stdout, sys.stderr
    # A program without a console has none.
    sys.stdout, sys.stderr = (stream and _VisibleStream(stream) for stream in streams)
    try:
        yield
    finally:
        sys.stdout, sys.stderr = streams
