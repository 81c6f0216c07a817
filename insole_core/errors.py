"""Errors that the user can act on.

Every message is one sentence that says what is wrong, where, and what to do. The command line shows
it as it is, the window translates it.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from insole_core.messages import Message, Value


class InsoleError(Exception):
    """An error that the user can correct; its text is written for a clinician.

    Parameters
    ----------
    template, values
        As for `Message`, such as ``"{path} is flat; export it again.", path=path``.
    """

    def __init__(self, template: str, /, **values: Value) -> None:
        super().__init__(Message(template, **values))

    @property
    def message(self) -> Message:
        """The sentence; the same as ``str(error)``."""
        message: Message = self.args[0]
        return message


class UsageError(InsoleError):
    """The call contradicts its input (command line: exit code 2)."""


class InputError(InsoleError):
    """A given file or folder cannot be used as it is."""


class ReconstructionError(InsoleError):
    """The recording is readable, but no foot can be made from it."""


class CalibrationError(InsoleError):
    """The captures are readable, but no calibration can be made from them."""


class DesignError(InsoleError):
    """A prescription or one of its values cannot be built."""


class OutputError(InsoleError):
    """A result could not be written; what stood there before is untouched."""


class RecordsError(InsoleError):
    """The clinic's record cannot do what was asked."""


class NotAllowed(RecordsError):  # noqa: N818 - says what happened, as the other errors of the record
    """The account that is signed in may not do this."""


class FirstPassword(NotAllowed):
    """The password is right, and its owner has to choose another one first."""


class Unreachable(RecordsError):  # noqa: N818
    """The database or the folder of the record does not answer at present."""


class PersonErased(RecordsError):  # noqa: N818 - as the other errors of the record
    """The person was erased: nothing can be added to them, and nothing may be kept of them."""


class Conflict(RecordsError):  # noqa: N818
    """Somebody else has changed the same thing meanwhile; nothing was overwritten.

    Parameters
    ----------
    mine
        What was to be stored.
    theirs
        What is stored by now: of the same type, or the summary of it.
    """

    def __init__(self, mine: Any, theirs: Any, template: str, /, **values: Value) -> None:
        super().__init__(template, **values)
        self.mine = mine
        self.theirs = theirs


def unreadable(path: Path | str, error: OSError | ValueError) -> InputError:
    """Return the error of a file that cannot be opened or read."""
    return InputError(
        "{path} cannot be read: {reason}; check the name of the file.",
        path=path,
        reason=str(getattr(error, "strerror", error)),
    )
