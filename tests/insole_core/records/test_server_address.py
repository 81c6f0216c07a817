"""Which server an address of the record really reaches, and whether safely."""

from __future__ import annotations

from pathlib import Path

import pytest
from psycopg.conninfo import conninfo_to_dict

from insole_core.errors import InputError
from insole_core.records.place import RecordsPlace

_ENVIRONMENT = ("PGHOST", "PGHOSTADDR", "PGSERVICE", "PGPORT", "PGSSLMODE")


@pytest.fixture(autouse=True)
def _no_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in _ENVIRONMENT:
        monkeypatch.delenv(name, raising=False)


def _reached(url: str) -> dict[str, object]:
    """What libpq is given for an address."""
    place = RecordsPlace.of_url(url, Path("/share"))
    return conninfo_to_dict("", **place.url.get_dialect()().create_connect_args(place.url)[1])


@pytest.mark.parametrize(
    "address",
    [
        "me@server/records",
        "me@server.clinic.se:5433/records",
        "me@192.0.2.7/records",
        "me@[2001:db8::7]/records",
        "me@0.0.0.0/records",
        "me@127.0.0.1.clinic.se/records",
        "localhost@server/records",
        "localhost%40server@server/records",
        "me@localhost./records",
        "me@127.1/records",
        "me@one,two/records",
        "me@/records?host=one&host=two",
        "me@/records?host=one,two&port=5432,5433",
        "me@/records?host=server",
        "me@server/records?sslmode=verify-full",
        "me@server/records?sslmode=&host=",
    ],
)
def test_another_computer_is_reached_encrypted_and_verified(address: str) -> None:
    reached = _reached(f"postgresql://{address}")
    wanted = {"sslmode": "verify-full", "gssencmode": "disable", "sslrootcert": "system"}
    assert reached.items() >= wanted.items()


@pytest.mark.parametrize(
    "address",
    [
        "me@/records",
        "me@localhost/records",
        "me@LOCALHOST/records",
        "me@127.0.0.1:5433/records",
        "me@127.8.9.10/records",
        "me@[::1]/records",
        "me@/records?host=/var/run/postgresql",
        "me@/records?host=/var/run/postgresql&port=5433",
        "me@/records?host=/one,/two",
    ],
)
def test_this_computer_may_be_reached_in_clear(address: str) -> None:
    assert "sslmode" not in _reached(f"postgresql+psycopg://{address}")


@pytest.mark.parametrize(
    ("address", "reason"),
    [
        ("me@localhost/records?host=server", "host more than once"),
        ("me@localhost/records?host=localhost", "host more than once"),
        ("me@localhost:1/records?port=2", "port more than once"),
        ("me@server/records?sslmode=disable&sslmode=verify-full", "sslmode more than once"),
        ("me@localhost/records?hostaddr=192.0.2.7", "option hostaddr"),
        ("me@server/records?hostaddr=192.0.2.7", "option hostaddr"),
        ("me@localhost/records?service=other", "option service"),
        ("me@localhost/records?servicefile=/tmp/x", "option servicefile"),
        ("me@localhost/records?conninfo=host%3Dserver", "option conninfo"),
        ("me@localhost/records?Host=server", "option Host"),
        ("me@localhost/records?%68ostaddr=192.0.2.7", "option hostaddr"),
        ("me@localhost/records?dbname=other", "option dbname"),
        ("me@localhost/records?user=other", "option user"),
        ("me@localhost/records?options=-csearch_path%3Dx", "option options"),
        ("me@server/records?sslkeylogfile=/tmp/keys", "option sslkeylogfile"),
        ("me@server/records?ssl_min_protocol_version=TLSv1", "option ssl_min_protocol_version"),
        ("me@server/records?gssencmode=require", "gssencmode=require"),
        ("me@server/records?sslmode=verify-ca", "sslmode=verify-ca"),
        ("me@server/records?sslmode=VERIFY-FULL", "sslmode=VERIFY-FULL"),
        ("me@localhost/records?password=secret", "holds a password"),
        ("me@server/records?sslpassword=secret", "holds a password"),
        ("me@localhost,server/records", "this computer and others"),
        ("me@/records?host=/tmp,server", "this computer and others"),
        ("me@/records?host=,server", "this computer and others"),
        ("me@/records?host=localhost%2Cserver", "this computer and others"),
        ("me@/records?host=localhost&host=server", "this computer and others"),
        ("me@%2Ftmp%2Fsocket/records", "cannot be one"),
        ("me@local%68ost/records", "cannot be one"),
        ("me@local host/records", "cannot be one"),
        ("me@/records?host=@socket", "cannot be one"),
        ("me@/records?host=server%20hostaddr%3D192.0.2.7", "cannot be one"),
        ("me@server:0/records", "port 0"),
        ("me@server:65536/records", "port 65536"),
        ("me@/records?port=x", "cannot be read"),
        ("me@server:x/records", "cannot be read"),
        ("me@server", "which one of the server"),
        ("me@server/", "which one of the server"),
        ("me@server/rec%0Aords", "cannot be read"),
        ("me@server/records?sslrootcert=%1b[2J", "cannot be read"),
        ("me@server/records\x00", "cannot be read"),
    ],
)
def test_an_address_that_leads_elsewhere_or_is_ambiguous_is_refused(
    address: str, reason: str
) -> None:
    with pytest.raises(InputError, match=reason) as refused:
        _reached(f"postgresql://{address}")
    assert "secret" not in str(refused.value)


@pytest.mark.parametrize(
    ("variable", "value", "address"),
    [
        ("PGHOSTADDR", "192.0.2.7", "me@localhost/records"),
        ("PGHOSTADDR", "192.0.2.7", "me@server/records"),
        ("PGSERVICE", "other", "me@localhost/records"),
        ("PGHOST", "server", "me@/records"),
        ("PGHOST", "/tmp/elsewhere", "me@/records"),
    ],
)
def test_the_environment_chooses_no_server(
    monkeypatch: pytest.MonkeyPatch, variable: str, value: str, address: str
) -> None:
    monkeypatch.setenv(variable, value)
    with pytest.raises(InputError, match=f"environment variable {variable}"):
        _reached(f"postgresql://{address}")


def test_the_environment_weakens_no_connection(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PGHOST", "other")
    monkeypatch.setenv("PGSSLMODE", "disable")
    reached = _reached("postgresql://me@server/records")
    assert (reached["host"], reached["sslmode"]) == ("server", "verify-full")


def test_a_sentence_names_the_servers_that_are_reached() -> None:
    for address, name in (
        ("me@/records?host=one&host=two", "one,two/records"),
        ("me@server:5433/records", "server/records"),
        ("me@/records?host=/tmp", "localhost/records"),
    ):
        assert RecordsPlace.of_url(f"postgresql://{address}", Path("/share")).name == name
