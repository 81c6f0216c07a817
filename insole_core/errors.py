"""The errors a user can act on.

Every message is one sentence that says what is wrong, where, and what to do; the command line shows
it as it stands, the window in its language.
"""

from __future__ import annotations

from insole_core.messages import Message, Value


class InsoleError(Exception):
    """Something the user can put right; the text is written for a clinician.

    Parameters
    ----------
    template, values
        Those of the `Message`, such as ``"{path} is flat; export it again.", path=path``.
    """

    def __init__(self, template: str, /, **values: Value) -> None:
        super().__init__(Message(template, **values))

    @property
    def message(self) -> Message:
        """The sentence; ``str(error)`` is the same."""
        message: Message = self.args[0]
        return message


class UsageError(InsoleError):
    """The call itself contradicts its input (command line: exit code 2)."""


class InputError(InsoleError):
    """A file or folder that was handed in cannot be used as it is."""


class ReconstructionError(InsoleError):
    """The recording is readable, but no foot can be made from it."""


class CalibrationError(InsoleError):
    """The captures are readable, but no calibration can be made from them."""


class DesignError(InsoleError):
    """A prescription or one of its values cannot be built."""


class OutputError(InsoleError):
    """A result could not be written; what stood there before is untouched."""
