"""An open record of the clinic."""

from __future__ import annotations

from insole_core.records.author import Author
from insole_core.records.content_store import ContentStore
from insole_core.records.context import RecordsContext
from insole_core.records.database import Database
from insole_core.records.persons import Persons
from insole_core.records.place import RecordsPlace
from insole_core.records.visits import Visits


class Records:
    """The parts of an open record; all of them may be called from any thread.

    Parameters
    ----------
    database
        With the tables of this program.
    who
        Author of all changes.
    """

    def __init__(self, database: Database, contents: ContentStore, who: Author) -> None:
        self._database = database
        self.who = who
        context = RecordsContext(database, contents, who)
        self.context = context
        self.contents = contents
        self.persons = Persons(context)
        self.visits = Visits(context)

    @property
    def place(self) -> RecordsPlace:
        """Where the record is."""
        return self._database.place

    @property
    def is_read_only(self) -> bool:
        """Whether nothing can be changed."""
        return self._database.is_read_only

    def close(self) -> None:
        """Close all connections; the record cannot be used any more."""
        self._database.close()
