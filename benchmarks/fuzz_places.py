"""Bad input around the record: where it is, the settings, backups, and calibration folders.

Other kinds than the damaged files of ``fuzz``: addresses of a database that lead elsewhere,
settings that name no record, backups that were cut, mixed up, or forged by whoever has their key,
folders of sensors in which something else stands. Each is refused with a sentence or accepted
rightly: an address is accepted only if libpq then stays on this computer or verifies the server; a
backup that is refused leaves no file behind, hidden or not. ``FUZZ_ONLY`` and ``FUZZ_SEED`` as in
``fuzz``.
"""

from __future__ import annotations

import hashlib
import json
import os
import random
import shutil
import tempfile
import zlib
from collections.abc import Callable, Iterator
from dataclasses import asdict
from functools import cache, partial
from itertools import product
from pathlib import Path
from typing import Any

import pyrage
from psycopg.conninfo import conninfo_to_dict
from psycopg.pq import Conninfo

from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_mutations import PLACES, Mutation, byte_mutations, entries_of, json_mutations
from benchmarks._fuzz_pool import Trial
from benchmarks._fuzz_report import run_families
from insole_core.errors import InsoleError
from insole_core.records.author import Author
from insole_core.records.backup.back_up import back_up, key_of_backups, set_up_backups
from insole_core.records.backup.backup_folder import (
    LISTS,
    OBJECTS,
    SNAPSHOTS,
    BackupFolder,
    BackupReader,
    object_name,
    sealed,
)
from insole_core.records.backup.backup_key import BackupKey, open_key
from insole_core.records.backup.restore import restore
from insole_core.records.backup.snapshot import check_backup, damaged_files
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import open_records
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_studio.app.doctor import Doctor
from insole_studio.document.record_location import RecordLocation, location_of_window, settings_for
from insole_studio.settings import Settings, load_settings
from insole_studio.user_paths import UserPaths

_WHO = Author("anna", "desk")
_IDENTITY = pyrage.x25519.Identity.generate()
_HOME_HOSTS = ("localhost", "127.0.0.1", "::1")


def main() -> None:
    run_families(_FAMILIES, _prepare)


def _prepare() -> None:
    sound_backup()
    sound_sensor()


# Addresses


def _addresses(rng: random.Random) -> Iterator[Trial]:
    schemes = ("postgresql", "postgresql+psycopg", "postgres", "mysql", "postgresql+asyncpg", "")
    users = (
        "",
        "me@",
        "me:secret@",
        "localhost@",
        "me%40localhost@",
        "a@b@",
        "\x1b[2J@",
        "\ud800@",
    )
    hosts = (
        "", "localhost", "LOCALHOST", "127.0.0.1", "127.1", "[::1]", "[::1%25lo]", "localhost.",
        "0",
        "0.0.0.0", "2130706433", "0x7f.1", "server", "192.0.2.1", "localhost,server", "%2Ftmp",
        "local%68ost", "localhost:5432,server", "[::ffff:127.0.0.1]", "ſerver", "a" * 300, " ", "*",
        "localhost\\@server", "localhost;server",
    )  # fmt: skip
    ports = ("", ":5432", ":0", ":-1", ":99999", ":x", ":5432,1")
    ends = ("", "/", "/db", "/db?", "/a/b", "/%00", "/db%3Fhost=server", "/host=server")
    queries = (
        "", "host=server", "host=localhost", "host=/tmp", "host=/tmp,server",
        "host=localhost,server",
        "host=server&host=/tmp", "hostaddr=192.0.2.1", "host=localhost&hostaddr=192.0.2.1",
        "service=x", "servicefile=/x", "passfile=/x", "password=secret", "sslpassword=secret",
        "sslmode=disable", "sslmode=prefer", "sslmode=verify-ca", "sslmode=verify-full",
        "sslmode=disable&sslmode=verify-full", "SSLMODE=disable", "gssencmode=require",
        "sslrootcert=system", "sslrootcert=", "conninfo=host%3Dserver", "dbname=host%3Dserver",
        "options=-cx%3Dy", "sslkeylogfile=/x", "ssl_min_protocol_version=TLSv1",
        "require_auth=none",
        "requiressl=0", "sslnegotiation=direct", "port=1,2", "port=x", "host=%00", "host=%0aserver",
        "autocommit=1", "row_factory=x", "context=x", "=", "&&&", "%", "a=" + "b" * 9000,
    )  # fmt: skip
    environments: tuple[dict[str, str], ...] = (
        {}, {}, {}, {"PGHOSTADDR": "192.0.2.1"}, {"PGHOST": "server"}, {"PGSERVICE": "x"},
        {"PGSSLMODE": "disable"}, {"PGPORT": "x"}, {"PGHOST": "/tmp,server"},
        {"PGGSSENCMODE": "prefer"},
    )  # fmt: skip
    likely = list(product(schemes[:2], users[:2], hosts, ports[:2], ends[2:3], queries))
    odd = list(product(schemes, users, hosts, ports, ends, queries))
    for parts in [*rng.sample(likely, 400), *rng.sample(odd, 300)]:
        scheme, user, host, port, end, query = parts
        text = f"{scheme}://{user}{host}{port}{end}{'?' if query else ''}{query}"
        environment = rng.choice(environments)
        read = partial(_read_address, text, environment)
        yield Trial("address", f"{text[:120]!r} {environment}", lambda _folder: None, read)
    for text in (
        "",
        "/",
        "://",
        "x",
        "\0",
        "postgresql:",
        "[" * 5000,
        "postgresql://[",
        "é",
        "//x/y",
    ):
        read = partial(_read_address, text, {})
        yield Trial("address", repr(text[:20]), lambda _folder: None, read, "refused")


def _read_address(text: str, environment: dict[str, str], _given: Path, made: Path) -> None:
    """Read an address, and ask libpq's own rules whether what is accepted is safe."""
    os.environ.update(environment)
    place = RecordsPlace.of_url(text, made)
    given = conninfo_to_dict("", **place.url.get_dialect()().create_connect_args(place.url)[1])
    usual = {o.keyword.decode(): o.val.decode() for o in Conninfo.get_defaults() if o.val}
    reached = {**usual, **{key: str(value) for key, value in given.items() if value is not None}}
    assert not reached.get("service"), reached
    assert not reached.get("hostaddr"), reached
    hosts = reached.get("host", "").split(",")
    at_home = [
        not host or host.startswith(("/", "127.0.")) or host.lower() in _HOME_HOSTS
        for host in hosts
    ]
    is_verified = (reached["sslmode"], reached["gssencmode"]) == ("verify-full", "disable")
    assert all(at_home) or (is_verified and not any(at_home)), reached
    assert "secret" not in place.name
    assert "secret" not in repr(place)


# Settings


def _settings(rng: random.Random) -> Iterator[Trial]:
    sound = asdict(Settings(record_database="", record_contents="/share", clinic="Foot"))
    for database in ("", "postgresql://me@localhost:1/db", "postgresql://me@server/db?service=x"):
        values = {**sound, "record_database": database}
        mutations = [
            *json_mutations(values),
            *byte_mutations(json.dumps(values).encode(), rng, 60, 30),
        ]
        chosen = rng.sample(mutations, min(len(mutations), 100))
        told = [m for m in mutations if m[0].startswith("record_")]
        for what, content, _ in {m[0]: m for m in (*chosen, *told)}.values():
            make = partial(_write, "settings.json", content)
            yield Trial("settings", f"{database[:12]} {what}", make, _read_settings)
    for what, place in PLACES.items():
        yield Trial("settings", what, partial(_place, "settings.json", place), _read_settings)


def _read_settings(given: Path, made: Path) -> None:
    """Ask what the settings say by all who read them; none of them may name another record."""
    paths = UserPaths(given / "settings.json", made / "data" / "autosave")
    found = Doctor(paths, None, lambda: ()).examine()
    for diagnosis in found:
        assert "report it" not in diagnosis.advice, diagnosis
    complaints: list[str] = []
    settings = load_settings(paths.settings_file, complaints.append, leave=True)
    location = location_of_window(paths)
    assert (location.url, location.contents) == (settings.record_database, settings.record_contents)
    location.place()


# Backups


@cache
def sound_backup() -> Path:
    """A folder with two backups of a small record."""
    folder = Path(tempfile.mkdtemp(prefix="fuzz-backup-"))
    records = open_records(RecordsPlace.local(folder / "record"), _WHO)
    set_up_backups(records.context, BackupKey.for_recipients([str(_IDENTITY.to_public())]))
    config = folder / "config"
    config.mkdir()
    (config / "settings.json").write_text('{"clinic": "Foot"}')
    for name in ("Anna Berg", "Ben Ek"):
        records.persons.add(Person(name))
        back_up(records.context, folder / "backups", {"settings": config})
    records.close()
    return folder


def _backups(rng: random.Random) -> Iterator[Trial]:
    root = sound_backup() / "backups"
    files = [path.relative_to(root) for path in sorted(root.rglob("*")) if path.is_file()]
    head = json.loads((root / "insole-studio-backup.json").read_text())
    damaged: list[tuple[Path, Mutation]] = [
        (Path("insole-studio-backup.json"), m)
        for m in (*json_mutations(head), *byte_mutations(json.dumps(head).encode(), rng, 20, 10))
    ]
    for file in files:
        content = (root / file).read_bytes()
        if file.suffix in {".age", ".objects"}:
            damaged += [(file, m) for m in byte_mutations(content, rng, 12, 6)]
    for file, (what, content, _) in rng.sample(damaged, min(len(damaged), 420)):
        make = partial(_changed_backup, partial(_overwrite, file, content))
        yield Trial("backup", f"{file}: {what}", make, _look_at_backup)
    for file, (what, place) in product(rng.sample(files, 8), PLACES.items()):
        make = partial(_changed_backup, partial(_replace, file, place))
        yield Trial("backup", f"{file}: {what}", make, _look_at_backup)
    for name in (SNAPSHOTS, LISTS, OBJECTS):
        for what, place in PLACES.items():
            make = partial(_changed_backup, partial(_replace, Path(name), place))
            yield Trial("backup", f"{name}: {what}", make, _look_at_backup)
    for name in (
        "000009-2026-13-45T99-99-99Z.age", "000009-0000-01-01T00-00-00Z.age", "x.age",
        "\x1b[2J.age",
        "000000-2026-01-01T00-00-00Z.age", "000001-2026-01-01T00-00-00Z.age", ".age", "é" * 60,
        "999999-9999-12-31T23-59-59Z.age", "٠٠٠٠٠٩-2026-01-01T00-00-00Z.age",
    ):  # fmt: skip
        for part in (SNAPSHOTS, LISTS):
            make = partial(_changed_backup, partial(_overwrite, Path(part) / name, b"x"))
            yield Trial("backup", f"{part}/{name!r}", make, _look_at_backup)


def _forged_backups(rng: random.Random) -> Iterator[Trial]:
    """Yield backups of somebody who has the key: a program with a mistake, or a newer one."""
    root = sound_backup() / "backups"
    _key, reader, newest = _opened(root)
    manifest = json.loads(reader.manifest(newest))
    told = list(json_mutations(manifest))
    for what, content, _ in told:
        make = partial(_changed_backup, partial(_forge_manifest, zlib.compress(content)))
        yield Trial("forged", f"manifest: {what}", make, _restore_backup)
    for what, raw in (("no zlib", b"x" * 99), ("a bomb", zlib.compress(bytes(2**29), 9))):
        make = partial(_changed_backup, partial(_forge_manifest, raw))
        yield Trial("forged", what, make, _restore_backup, "refused")
    listed = {"format": 1, "damaged": 0, "objects": ["a" * 64, "b"]}
    for what, content, _ in [*json_mutations(listed), *byte_mutations(b"{}" * 20, rng, 10, 10)]:
        make = partial(_changed_backup, partial(_forge_list, content))
        yield Trial("forged", f"list: {what}", make, _look_at_backup)
    persons = next(table for table in manifest["tables"] if table["name"] == "persons")
    rows = [json.loads(line) for line in reader.read_rows(persons["pieces"][0]).splitlines()]
    row_mutations = [m for m in json_mutations(rows[0]) if not m[0].endswith(("twice", "missing"))]
    for what, content, _ in rng.sample(row_mutations, min(len(row_mutations), 90)):
        make = partial(_changed_backup, partial(_forge_rows, manifest, content + b"\n"))
        yield Trial("forged", f"row: {what}", make, _restore_backup)
    for name in (
        "../x",
        "/x",
        "..",
        "",
        ".",
        "a/../../x",
        "C:\\x",
        "\0",
        "x" * 300,
        "settings.json/x",
    ):
        changed = json.loads(json.dumps(manifest))
        changed["files"][0]["name"] = name
        content = zlib.compress(json.dumps(changed).encode())
        make = partial(_changed_backup, partial(_forge_manifest, content))
        yield Trial("forged", f"file {name[:20]!r}", make, _restore_backup, "any")


def _opened(root: Path) -> tuple[Any, BackupReader, Any]:
    folder = BackupFolder(root)
    key = open_key(folder.head().locked, str(_IDENTITY))
    return key, BackupReader(folder, key), folder.snapshots()[-1]


def _changed_backup(change: Callable[[Path], object], given: Path) -> None:
    shutil.copytree(sound_backup() / "backups", given / "backups")
    change(given / "backups")


def _overwrite(file: Path, content: bytes, root: Path) -> None:
    (root / file).write_bytes(content)


def _replace(file: Path, place: Callable[[Path], object], root: Path) -> None:
    path = root / file
    if path.is_dir():
        shutil.rmtree(path)
    else:
        path.unlink()
    place(path)


def _forge_manifest(compressed: bytes, root: Path) -> None:
    key, _reader, newest = _opened(root)
    path = root / SNAPSHOTS / newest.file_name
    path.write_bytes(_encrypted(root, _authenticated(key.mac_key, compressed)))


def _forge_list(content: bytes, root: Path) -> None:
    key, _reader, newest = _opened(root)
    (root / LISTS / newest.list_name).write_bytes(sealed(content, key.mac_key))


def _forge_rows(manifest: dict[str, Any], content: bytes, root: Path) -> None:
    key, _reader, _newest = _opened(root)
    sha256 = hashlib.sha256(content).hexdigest()
    encrypted = _encrypted(root, zlib.compress(content))
    name = object_name(key.mac_key, sha256)
    digest = hashlib.sha256(encrypted).hexdigest()[:32]
    folder = root / OBJECTS / name[:2]
    folder.mkdir(exist_ok=True)
    (folder / f"{name}-{len(encrypted)}-{digest}.age").write_bytes(encrypted)
    changed = json.loads(json.dumps(manifest))
    for table in changed["tables"]:
        if table["name"] == "persons":
            table["pieces"], table["rows"] = [sha256], 1
    _forge_manifest(zlib.compress(json.dumps(changed).encode()), root)


def _authenticated(mac_key: str, compressed: bytes) -> bytes:
    from insole_core.records.backup.backup_key import authenticate

    return authenticate(mac_key, compressed).encode("ascii") + compressed


def _encrypted(root: Path, content: bytes) -> bytes:
    recipient = pyrage.x25519.Recipient.from_str(BackupFolder(root).head().recipient)
    encrypted: bytes = pyrage.encrypt(content, [recipient])
    return encrypted


def _look_at_backup(given: Path, _made: Path) -> None:
    """Do all that needs no new record: list, judge, check and decrypt."""
    root, refusals = given / "backups", []
    records = open_records(RecordsPlace.local(sound_backup() / "record"), _WHO)
    key = key_of_backups(records.context)
    records.close()
    assert key is not None
    for look in (
        lambda: BackupFolder(root).known_snapshots(key),
        lambda: damaged_files(root),
        lambda: check_backup(root, str(_IDENTITY)),
        lambda: check_backup(root, str(_IDENTITY), 1),
    ):
        try:
            look()
        except InsoleError as error:
            refusals.append(error)
    if refusals:
        raise refusals[0]


def _restore_backup(given: Path, made: Path) -> None:
    """Restore; what is refused leaves nothing that a record could be taken for."""
    paths = UserPaths(made / "config" / "settings.json", made / "data" / "autosave")
    place = RecordsPlace.local(made / "record")
    location = RecordLocation(paths.records_folder)
    try:
        restore(
            given / "backups", str(_IDENTITY), place, _WHO,
            settings=paths.backed_up_folders, revise=settings_for(location, paths),
        )  # fmt: skip
    except InsoleError:
        left = [path.name for path in made.rglob("*") if path.is_file()]
        hidden = [name for name in left if name.startswith(".") or "sqlite3" in name]
        assert not hidden or place.database_file.exists(), left
        assert not [name for name in left if name.startswith(".insole-studio")], left
        raise
    open_records(place, _WHO).close()
    assert not [p for p in made.parent.iterdir() if p.name not in ("in", "out")]


# Calibrations


@cache
def sound_sensor() -> dict[str, bytes]:
    entries = dict(entries_of(samples.SESSION))
    prefix = "views/left/"
    return {
        name: entries[prefix + name]
        for name in ("sensor.json", "correction.npz")
        if prefix + name in entries
    }


def _calibrations(rng: random.Random) -> Iterator[Trial]:
    sound = json.loads(sound_sensor()["sensor.json"])
    for folder in ("A1", "A1/before"):
        json_ones = [*json_mutations(sound)]
        for what, content, _ in rng.sample(json_ones, min(len(json_ones), 120)):
            make = partial(_sensor_with, folder, "sensor.json", content)
            yield Trial("calibration folder", f"{folder}/sensor.json: {what}", make, _use_sensors)
        for file, content in sound_sensor().items():
            for what, changed, _ in byte_mutations(content, rng, 30, 15):
                make = partial(_sensor_with, folder, file, changed)
                yield Trial("calibration folder", f"{folder}/{file}: {what}", make, _use_sensors)
            for what, place in PLACES.items():
                make = partial(_sensor_place, f"{folder}/{file}", place)
                yield Trial("calibration folder", f"{folder}/{file}: {what}", make, _use_sensors)
    for what, place in PLACES.items():
        for where in ("A1", "A1/before"):
            make = partial(_sensor_place, where, place)
            yield Trial("calibration folder", f"{where}: {what}", make, _use_sensors)
    for name in (
        "..x",
        " ",
        "\x1b[2J",
        "é",
        "a" * 200,
        "A 1",
        ".hidden",
        "-x",
        "A1 ",
        "con",
        "\udcff",
    ):
        make = partial(_sensor_named, name)
        yield Trial("calibration folder", f"named {name[:20]!r}", make, _use_sensors)


def _sensor_with(folder: str, file: str, content: bytes, given: Path) -> None:
    _sound_sensors(given)
    (given / "sensors" / folder / file).write_bytes(content)


def _sensor_place(path: str, place: Callable[[Path], object], given: Path) -> None:
    _sound_sensors(given)
    _replace(Path("sensors") / path, place, given)


def _sensor_named(name: str, given: Path) -> None:
    _sound_sensors(given)
    (given / "sensors" / "A1").rename(given / "sensors" / os.fsdecode(os.fsencode(name)))


def _sound_sensors(given: Path) -> None:
    """Two states of sensor A1, the earlier one in ``before``."""
    for folder in (given / "sensors" / "A1", given / "sensors" / "A1" / "before"):
        folder.mkdir(parents=True)
        for name, content in sound_sensor().items():
            (folder / name).write_bytes(content)
        values = json.loads(sound_sensor()["sensor.json"])
        (folder / "sensor.json").write_text(json.dumps({**values, "serial": "A1"}))


def _use_sensors(given: Path, made: Path) -> None:
    """List, examine and read the sensors, and undo the last step of a copy."""
    store = SensorStore(given / "sensors")
    paths = UserPaths(made / "settings.json", given / "autosave")
    for diagnosis in Doctor(paths, None, lambda: ()).examine():
        assert "report it" not in diagnosis.advice, diagnosis
    refusals: list[InsoleError] = []
    copy = made / "sensors"
    shutil.copytree(given / "sensors", copy, symlinks=True, ignore=_specials)
    for serial in ["A1", *store.serials()]:
        for use in (store.load, store.can_undo, SensorStore(copy).undo):
            try:
                use(serial)
            except InsoleError as error:
                refusals.append(error)
    assert not list(copy.rglob(".insole-studio*"))
    if refusals:
        raise refusals[0]


def _specials(folder: str, names: list[str]) -> list[str]:
    """Leave pipes out of a copy, which waits for them."""
    return [name for name in names if (Path(folder) / name).is_fifo()]


def _write(name: str, content: bytes, folder: Path) -> None:
    (folder / name).write_bytes(content)


def _place(name: str, place: Callable[[Path], object], folder: Path) -> None:
    place(folder / name)


_FAMILIES: dict[str, Callable[[random.Random], Iterator[Trial]]] = {
    "address": _addresses,
    "settings": _settings,
    "backup": _backups,
    "forged": _forged_backups,
    "calibration": _calibrations,
}
