"""Where a record is: a folder of this computer, or a database server and a shared folder."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError

from insole_core.errors import InputError

DATABASE_FILE = "records.sqlite3"
CONTENTS_FOLDER = "contents"
_LOCAL_HOSTS = ("", "localhost", "127.0.0.1", "::1")
_VERIFIED = "verify-full"


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
            When it is no such address, or asks for a connection that is not verified.
        """
        try:
            parsed = make_url(url)
        except ArgumentError:
            raise InputError(
                "The address of the database cannot be read; write it as "
                "postgresql+psycopg://user@server/database."
            ) from None
        if parsed.drivername not in ("postgresql", "postgresql+psycopg"):
            raise InputError(
                "The record cannot use a database of the kind {kind}; give the address of a "
                "PostgreSQL server: postgresql+psycopg://user@server/database.",
                kind=parsed.drivername,
            )
        parsed = parsed.set(drivername="postgresql+psycopg")
        return cls(_with_verified_tls(parsed), contents)

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
        return f"{self.url.host or 'localhost'}/{self.url.database or ''}"


def _with_verified_tls(url: URL) -> URL:
    host = url.host or str(url.query.get("host", ""))
    if host in _LOCAL_HOSTS or host.startswith("/"):  # a socket of this computer
        return url
    mode = url.query.get("sslmode", _VERIFIED)
    if mode != _VERIFIED:
        raise InputError(
            "The address of the database asks for sslmode={mode}, with which patients' data could "
            "be read on the way; remove it, or write sslmode=verify-full.",
            mode=str(mode),
        )
    added = {"sslmode": _VERIFIED}
    if "sslrootcert" not in url.query:
        added["sslrootcert"] = "system"
    return url.update_query_dict(added)
