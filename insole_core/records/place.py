"""Where a record is: a folder of this computer, or a database server and a shared folder."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from sqlalchemy.engine import URL

from insole_core.records.server_address import read_address

DATABASE_FILE = "records.sqlite3"
CONTENTS_FOLDER = "contents"


@dataclass(frozen=True)
class RecordsPlace:
    """A database and the folder of its large files.

    Parameters
    ----------
    url
        Of the database; its password appears neither in messages nor in logs.
    contents
        Folder of the content store.
    """

    url: URL
    contents: Path

    @classmethod
    def local(cls, folder: Path) -> RecordsPlace:
        """Return the place of a record of one computer: an SQLite database in a folder."""
        url = URL.create("sqlite+pysqlite", database=str(folder / DATABASE_FILE))
        return cls(url, folder / CONTENTS_FOLDER)

    @classmethod
    def of_url(cls, url: str, contents: Path) -> RecordsPlace:
        """Return the place of a record that stations share on a PostgreSQL server.

        Parameters
        ----------
        url
            Such as ``postgresql+psycopg://clinic@server/records``. The connection to another
            computer is encrypted, and its certificate verified.

        Raises
        ------
        InputError
            When it is no such address, asks for a connection that is not verified, or leaves open
            which server it reaches.
        """
        return cls(read_address(url), contents)

    @property
    def has_password(self) -> bool:
        """Whether the address of the database holds a password."""
        return self.url.password is not None

    def with_password(self, password: str) -> RecordsPlace:
        """Return the place of a database that asks for a password; an empty one changes nothing."""
        return replace(self, url=self.url.set(password=password)) if password else self

    @property
    def is_local(self) -> bool:
        """Whether the database is a file."""
        return self.url.get_backend_name() == "sqlite"

    @property
    def database_file(self) -> Path:
        """The file of a local database."""
        return Path(self.url.database or "")

    @property
    def name(self) -> str:
        """What to call the database in a sentence; without user and password."""
        if self.is_local:
            return str(self.database_file)
        hosts = (self.url.host,) if self.url.host else self.url.normalized_query.get("host", ())
        named = [host for host in hosts if host and not host.startswith("/")]
        return f"{','.join(named) or 'localhost'}/{self.url.database or ''}"
