"""A PostgreSQL server of the tests' own: unprivileged, in a temporary folder, without a port."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import psycopg

from tests.patience import PATIENCE_S

_FAST = ("-c", "fsync=off", "-c", "full_page_writes=off", "-c", "synchronous_commit=off")
_SOCKETS = Path("/tmp")
_OTHER_USERS = ("postgres", "nobody")


def binaries() -> Path | None:
    """Return the folder of the server's programs; None where PostgreSQL is not installed."""
    folders = sorted(Path("/usr/lib/postgresql").glob("*/bin"), key=lambda p: p.parent.name)
    for folder in reversed(folders):
        if (folder / "initdb").exists():
            return folder
    found = shutil.which("initdb")
    return None if found is None else Path(found).resolve().parent


@dataclass(frozen=True)
class PostgresServer:
    """A running server.

    Parameters
    ----------
    folder
        Of its socket, whose path must be short.
    data
        Folder of its data.
    """

    folder: Path
    data: str
    bin: Path
    user: str
    options: tuple[str, ...]

    def url(self, database: str) -> str:
        return f"postgresql+psycopg://{self.user}@/{database}?host={self.folder}"

    def execute(self, statement: str, database: str = "postgres") -> None:
        with psycopg.connect(
            f"host={self.folder} user={self.user} dbname={database}", autocommit=True
        ) as connection:
            connection.execute(statement)

    def run(self, program: str, *arguments: str) -> None:
        command = [*_as_user(self.user), str(self.bin / program), *arguments]
        done = subprocess.run(
            command, cwd=self.folder, capture_output=True, text=True, check=False,
            timeout=PATIENCE_S,
        )  # fmt: skip
        if done.returncode:
            raise RuntimeError(f"{program}: {done.stdout}{done.stderr}")

    def start(self) -> None:
        options = " ".join(("-c", "listen_addresses=''", "-k", str(self.folder), *self.options))
        log = str(self.folder / "log")
        self.run("pg_ctl", "-D", self.data, "-l", log, "-w", "-o", options, "start")

    def stop(self, mode: str = "fast") -> None:
        self.run("pg_ctl", "-D", self.data, "-m", mode, "-w", "stop")

    def is_running(self) -> bool:
        command = [*_as_user(self.user), str(self.bin / "pg_ctl"), "-D", self.data, "status"]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, check=False)
        return done.returncode == 0


@contextmanager
def running_server(
    *, durable: bool = False, options: tuple[str, ...] = (), parent: Path = _SOCKETS
) -> Iterator[PostgresServer]:
    """Yield a server.

    Parameters
    ----------
    durable
        Keep what is written also when the server is killed.
    parent
        Of the folder of its data, which every user may enter.
    """
    folder = binaries()
    if folder is None:
        raise RuntimeError("PostgreSQL is not installed")
    user = _user()
    with (
        tempfile.TemporaryDirectory(prefix="pg-", dir=_SOCKETS) as sockets,
        tempfile.TemporaryDirectory(prefix="pg-data-", dir=parent) as data,
    ):
        if os.geteuid() == 0:
            for path in (sockets, data):
                shutil.chown(path, user)
        options = (*(() if durable else _FAST), *options)
        server = PostgresServer(Path(sockets), data, folder, user, options)
        server.run("initdb", "-D", data, "-U", user, "-A", "trust", "-E", "UTF8", "--no-sync")
        server.start()
        try:
            yield server
        finally:
            if server.is_running():
                server.stop("immediate")


def _user() -> str:
    """Return who runs the server, which refuses to be run by root."""
    import pwd

    if os.geteuid() != 0:
        return pwd.getpwuid(os.geteuid()).pw_name
    known = {entry.pw_name for entry in pwd.getpwall()}
    return next(name for name in _OTHER_USERS if name in known)


def _as_user(user: str) -> list[str]:
    if os.geteuid() != 0:
        return []
    return ["setpriv", f"--reuid={user}", f"--regid={_group(user)}", "--clear-groups", "--"]


def _group(user: str) -> int:
    import pwd

    return pwd.getpwnam(user).pw_gid
