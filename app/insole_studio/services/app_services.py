"""What the rooms of the window have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from insole_studio.document.case import Case
from insole_studio.jobs import Jobs, Result, Task
from insole_studio.services.notices import Notices
from insole_studio.services.user_messages import UserMessages


@dataclass(frozen=True, eq=False)
class AppServices:
    """The open case, the work beside the window, and what is said to the user."""

    case: Case
    jobs: Jobs
    messages: UserMessages
    notices: Notices

    def run(self, channel: str, task: Task[Result], done: Callable[[Result], None]) -> None:
        """Do long work, then `done` with its result; what goes wrong is said."""
        self.jobs.start(channel, task, done, self.messages.show_error)
