"""Where a record is: a folder of this computer, or a database server and a shared folder."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from ipaddress import ip_address
from pathlib import Path
from typing import Final

from sqlalchemy.engine import URL, make_url
from sqlalchemy.exc import ArgumentError

from insole_core.errors import InputError

_DRIVER: Final = "postgresql+psycopg"
_KINDS: Final = ("postgresql", _DRIVER)
_VERIFIED: Final = "verify-full"
_OPTIONS: Final = frozenset(
    {
        "host", "port", "sslmode", "sslrootcert", "sslcert", "sslkey", "sslcrl", "sslcrldir",
        "gssencmode", "channel_binding", "krbsrvname", "passfile", "target_session_attrs",
        "connect_timeout", "application_name",
    }
)  # fmt: skip
"""What an address may say after its question mark: nothing that leads elsewhere or holds a
secret."""
_SECRETS: Final = ("password", "sslpassword", "passwd", "pwd")
_REDIRECTIONS: Final = {"service": "PGSERVICE", "hostaddr": "PGHOSTADDR"}
"""What sends libpq to another server than the one that is named."""
_SERVER: Final = re.compile(r"[A-Za-z0-9_]([A-Za-z0-9_.-]*[A-Za-z0-9_])?\.?|[0-9A-Fa-f:.]+")
_MOST_PORT: Final = 65535


DATABASE_FILE = "records.sqlite3"
_CONTENTS_FOLDER = "contents"


def read_address(text: str) -> URL:
    """Return the address of a database whose connection is safe.

    One that stays on this computer may be in clear; to any other, it is encrypted and the server's
    certificate is verified.

    Raises
    ------
    InputError
        When it is no address of a PostgreSQL server, asks for less, or leaves open which server
        is reached.
    """
    url = _parsed(text)
    _check_options(url)
    reached = _reached(url)
    servers = _servers(reached)
    _check_ports(reached["port"] if url.port is None else str(url.port))
    at_home = [_is_this_computer(server) for server in servers]
    if all(at_home):
        return url
    if any(at_home):
        raise InputError(
            "The address of the database names this computer and others; name one or the other."
        )
    return _with_verified_tls(url)


def _parsed(text: str) -> URL:
    try:
        url = make_url(text.strip())
    except (ArgumentError, ValueError):
        raise _unreadable() from None
    if url.drivername not in _KINDS:
        raise InputError(
            "The record cannot use a database of the kind {kind}; give the address of a "
            "PostgreSQL server: postgresql+psycopg://user@server/database.",
            kind=url.drivername,
        )
    parts = (url.username, url.password, url.host, url.database, *url.query, *_values(url))
    if any(part is not None and not part.isprintable() for part in parts):
        raise _unreadable()
    if not url.database:
        raise InputError(
            "The address of the database does not say which one of the server; write it as "
            "postgresql+psycopg://user@server/database."
        )
    return url.set(drivername=_DRIVER)


def _unreadable() -> InputError:
    return InputError(
        "The address of the database cannot be read; write it as "
        "postgresql+psycopg://user@server/database."
    )


def _values(url: URL) -> tuple[str, ...]:
    return tuple(one for values in url.normalized_query.values() for one in values)


def _check_options(url: URL) -> None:
    """Refuse what leads elsewhere, is a secret, or is said twice."""
    for name, values in url.normalized_query.items():
        if name in _SECRETS:
            raise InputError(
                "The address of the database holds a password as {option}; remove it: the password "
                "is asked, or taken from PostgreSQL's own password file.",
                option=name,
            )
        if name not in _OPTIONS:
            raise InputError(
                "The address of the database has the option {option}, which is not allowed, since "
                "it could lead to another server or weaken the connection; remove it.",
                option=name,
            )
        if len(values) > 1 and name != "host":
            raise _said_twice(name)
    for name, value in (("host", url.host), ("port", url.port)):
        if value and name in url.query:
            raise _said_twice(name)


def _said_twice(option: str) -> InputError:
    return InputError(
        "The address of the database says {option} more than once; say it once.", option=option
    )


def _reached(url: URL) -> dict[str, str]:
    """Return the options that libpq connects with, of the address and of the environment."""
    dialect = url.get_dialect()
    psycopg = dialect.import_dbapi()  # only here: a local record needs no library of a server
    try:
        given = psycopg.conninfo.conninfo_to_dict("", **dialect().create_connect_args(url)[1])
    except (ArgumentError, psycopg.Error, ValueError):
        raise _unreadable() from None
    usual = {
        option.keyword.decode(): option.val.decode("utf-8", "replace")
        for option in psycopg.pq.Conninfo.get_defaults()
        if option.val
    }
    reached = usual | {name: str(value) for name, value in given.items() if value is not None}
    for name, variable in _REDIRECTIONS.items():
        if reached.get(name):
            raise InputError(
                "The environment variable {variable} sends connections to another server than the "
                "address of the database names; remove it, and name the server in the address.",
                variable=variable,
            )
    if reached.get("host") and not given.get("host"):
        raise InputError(
            "The address of the database names no server, and the environment variable {variable} "
            "would choose one; name the server in the address.",
            variable="PGHOST",
        )
    return reached


def _servers(reached: dict[str, str]) -> list[str]:
    """Return the names, addresses or sockets that are tried; an empty one is the usual socket."""
    servers = reached.get("host", "").split(",")
    for server in servers:
        if server and not server.startswith("/") and not _SERVER.fullmatch(server):
            raise InputError(
                "The address of the database names a server that cannot be one, {server}; write "
                "its name, or for a socket of this computer: "
                "postgresql+psycopg://user@/database?host=/folder.",
                server=server,
            )
    return servers


def _check_ports(ports: str) -> None:
    for port in ports.split(","):
        if port and not (port.isdecimal() and 0 < int(port) <= _MOST_PORT):
            raise InputError(
                "The address of the database has the port {port}; give one from 1 to 65535.",
                port=port,
            )


def _is_this_computer(server: str) -> bool:
    if not server or server.startswith("/"):  # a socket
        return True
    if server.casefold() == "localhost":
        return True
    try:
        return ip_address(server).is_loopback
    except ValueError:
        return False


def _with_verified_tls(url: URL) -> URL:
    wanted = {"sslmode": _VERIFIED, "gssencmode": "disable"}  # GSS would take the place of TLS
    for option, value in wanted.items():
        found = url.query.get(option, value)
        if found != value:
            raise InputError(
                "The address of the database asks for {option}={found}, with which patients' data "
                "could be read on the way; remove it, or write {option}={value}.",
                option=option,
                found=str(found),
                value=value,
            )
    if "sslrootcert" not in url.query:
        wanted["sslrootcert"] = "system"
    return url.update_query_dict(wanted)


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
        return cls(url, folder / _CONTENTS_FOLDER)

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
