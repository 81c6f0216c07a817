"""Bad input of the clinic's record: damaged and foreign databases, accounts, lists, case files,
and names of files and places.

Each is used by the commands that a user has. Beside what every trial must keep to, nothing may be
left behind by what is refused.
"""

from __future__ import annotations

import json
import os
import random
import shutil
import sqlite3
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import closing, suppress
from functools import cache, partial
from pathlib import Path
from typing import Any

from benchmarks import _fuzz_samples as samples
from benchmarks._fuzz_mutations import (
    PLACES,
    Mutation,
    byte_mutations,
    entries_of,
    json_mutations,
    zip_of,
)
from benchmarks._fuzz_pool import Expected, Trial, fingerprint, run_command

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "insole_core" / "records"))

Change = Callable[[sqlite3.Connection], Any]
FILE = "records.sqlite3"
PASSWORD = "correct horse battery"
PERSON = "26-A"
READING: tuple[tuple[str, ...], ...] = (
    ("list",),
    ("show", PERSON),
    ("verify",),
    ("list", "--orders"),
    ("list", "--visits", "2026-11-22"),
    ("export", PERSON, "--out", "exported"),
    ("list", "Zoë"),
)
_CELLS: tuple[Any, ...] = (
    None,
    "",
    "\x1b[2J\u202e",
    "9999-99-99",
    "x" * 100_000,
    b"\xff\x00\xfe",
    -(2**63),
    1e308,
    "[" * 2000,
    '{"a": NaN}',
    "../../../etc/passwd",
)


@cache
def sound_files() -> dict[str, bytes]:
    """Return the files of a small record with a row in every table but that of accounts."""
    from backed_up_record import make_record

    from insole_core.records.author import Author
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import open_records

    with tempfile.TemporaryDirectory() as name:
        empty, folder = Path(name, "empty"), Path(name, "record")
        open_records(RecordsPlace.local(empty), Author("anna", "desk")).close()
        make_record(empty / FILE, folder).database.close()
        shutil.copytree(empty / "contents", folder / "contents", dirs_exist_ok=True)  # its identity
        _in_one_file(folder / FILE)
        found = [path for path in sorted(folder.rglob("*")) if path.is_file()]
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in found}


def sound_record() -> bytes:
    """Return its database."""
    return sound_files()[FILE]


def _in_one_file(path: Path) -> None:
    with closing(sqlite3.connect(path)) as database:
        database.executescript("PRAGMA wal_checkpoint(TRUNCATE); PRAGMA journal_mode = DELETE")


@cache
def record_with_accounts() -> bytes:
    """Return such a database whose accounts are on: its administrator is ``chief``."""
    from insole_core.records.author import Author
    from insole_core.records.place import RecordsPlace
    from insole_core.records.records import open_records

    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / FILE).write_bytes(sound_record())
        with closing(open_records(RecordsPlace.local(folder), Author("anna", "desk"))) as records:
            records.accounts.switch_on("chief", "Chief", PASSWORD)
        _in_one_file(folder / FILE)
        return (folder / FILE).read_bytes()


def damaged_records(rng: random.Random) -> Iterator[Trial]:
    """Yield records whose file is damaged, or is no record."""
    sound = sound_record()
    damaged: list[Mutation] = [*byte_mutations(sound, rng, 170, 40), *_damaged_pages(sound, rng)]
    damaged += [(f"header {at} = {value}", _byte(sound, at, value), "any")
                for at in range(100) for value in (0, 255)]  # fmt: skip
    for number, (what, content, _) in enumerate(damaged):
        yield _record_trial("record file", what, partial(_put, {FILE: content}), number)
    for number, (what, files) in enumerate(_beside(sound, rng)):
        yield _record_trial("record beside", what, partial(_put, files), number)
    for number, (what, place) in enumerate(PLACES.items()):
        at = partial(_placed, place)
        expected: Expected = "refused"
        yield _record_trial("record place", what, at, number, expected=expected)


def _damaged_pages(sound: bytes, rng: random.Random) -> Iterator[Mutation]:
    size = 4096
    pages = len(sound) // size
    for page in range(pages):
        start, end = page * size, (page + 1) * size
        if rng.random() < 120 / pages:
            yield f"page {page} empty", sound[:start] + bytes(size) + sound[end:], "any"
            yield f"page {page} random", sound[:start] + rng.randbytes(size) + sound[end:], "any"
        if rng.random() < 60 / pages:
            other = rng.randrange(pages) * size
            swapped = sound[:start] + sound[other : other + size] + sound[end:]
            yield f"page {page} is another", swapped, "any"
    yield "longer", sound + bytes(10_000), "any"
    yield "twice", sound + sound, "any"


def _beside(sound: bytes, rng: random.Random) -> Iterator[tuple[str, dict[str, bytes]]]:
    """Yield files of SQLite beside a record that do not belong to it."""
    for suffix in ("-journal", "-wal", "-shm"):
        for what, content in (
            ("empty", b""),
            ("zeros", bytes(40_000)),
            ("random", rng.randbytes(40_000)),
            ("the record", sound),
            ("journal", b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7" + rng.randbytes(4088)),
            ("WAL", b"\x37\x7f\x06\x82\x00\x2d\xe2\x18" + rng.randbytes(8000)),
        ):
            yield f"{suffix} {what}", {FILE: sound, f"{FILE}{suffix}": content}


def changed_schemas(rng: random.Random) -> Iterator[Trial]:
    """Yield records whose tables are others, and databases of other programs."""
    number = 0
    for what, change in [*_schema_changes(), *_foreign()]:
        for _ in range(2):  # by two of the commands
            yield _record_trial("record tables", what, partial(_changed, [change]), number)
            number += 3
    cells = [(table, column, cell) for table, column in _columns() for cell in _CELLS]
    for table, column, cell in rng.sample(cells, min(700, len(cells))):
        change = partial(_set_cells, table, column, cell)
        what = f"{table}.{column} = {str(cell)[:12]!a}"
        yield _record_trial("record cells", what, partial(_changed, [change]), number)
        number += 1


def _columns() -> list[tuple[str, str]]:
    from insole_core.records.schema import metadata

    tables = [table for table in metadata.sorted_tables if table.name != "accounts"]
    return [(table.name, column.name) for table in tables for column in table.columns]


def _schema_changes() -> Iterator[tuple[str, Change]]:
    from insole_core.records.schema import metadata

    for version in ("9999", "0000", "", "x", "0002", 7, b"\xff", "0003\x00", "x" * 10_000):
        yield f"schema {version!a:.20}", partial(_set_version, version)
    statements = [
        "DELETE FROM alembic_version",
        "DROP TABLE alembic_version",
        "INSERT INTO alembic_version VALUES ('0001')",
        "PRAGMA user_version = 2000000000",
        "PRAGMA application_id = 1",
        "CREATE TABLE extra (a)",
        "CREATE TRIGGER t AFTER INSERT ON audit BEGIN SELECT RAISE(ABORT, 'no'); END",
        "CREATE TRIGGER t AFTER UPDATE ON persons BEGIN DELETE FROM visits; END",
    ]
    for table in metadata.sorted_tables:
        name = table.name
        statements += [f"DROP TABLE {name}", f"DELETE FROM {name}"]
        statements += [f"ALTER TABLE {name} RENAME TO other; CREATE VIEW {name} AS SELECT 1 AS id"]
        statements += [f"ALTER TABLE {name} RENAME TO other; CREATE TABLE {name} (id)"]
        statements += [
            f"ALTER TABLE {name} RENAME COLUMN {column.name} TO other" for column in table.columns
        ]
    for statement in statements:
        yield statement[:60], partial(_run_script, statement)
    yield "no triggers", _drop_triggers


def _set_version(version: Any, database: sqlite3.Connection) -> None:
    database.execute("UPDATE alembic_version SET version_num = ?", [version])


def _run_script(script: str, database: sqlite3.Connection) -> None:
    _drop_triggers(database)
    database.executescript(script)


def _foreign() -> Iterator[tuple[str, Change]]:
    def other(script: str) -> Change:
        def change(database: sqlite3.Connection) -> None:
            _empty(database)
            database.executescript(script)

        return change

    yield "no tables", other("")
    yield "browser", other("CREATE TABLE urls (id INTEGER PRIMARY KEY, url TEXT)")
    yield (
        "another persons",
        other("CREATE TABLE persons (id, name)"),
    )
    versions = "CREATE TABLE alembic_version (version_num)"
    yield "another alembic", other(f"{versions}; INSERT INTO alembic_version VALUES ('ab')")
    yield "full text", other("CREATE VIRTUAL TABLE f USING fts5(a)")


def _empty(database: sqlite3.Connection) -> None:
    _drop_triggers(database)
    names = database.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
    for (name,) in names:
        database.execute(f'DROP TABLE "{name}"')


def _drop_triggers(database: sqlite3.Connection) -> None:
    found = database.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall()
    for (name,) in found:
        database.execute(f'DROP TRIGGER "{name}"')


def _set_cells(table: str, column: str, cell: Any, database: sqlite3.Connection) -> None:
    _drop_triggers(database)
    database.execute("PRAGMA foreign_keys = OFF")
    database.execute("PRAGMA ignore_check_constraints = ON")
    (kept,) = database.execute(
        "SELECT sql FROM sqlite_master WHERE type = 'table' AND name = ?", [table]
    ).fetchone()
    database.execute("PRAGMA writable_schema = ON")
    database.execute(
        "UPDATE sqlite_master SET sql = ? WHERE type = 'table' AND name = ?",
        [kept.replace("NOT NULL", ""), table],
    )
    database.execute("PRAGMA writable_schema = RESET")
    with suppress(sqlite3.IntegrityError):  # a number that is the key of its table
        database.execute(f"UPDATE OR REPLACE {table} SET {column} = ?", [cell])


def damaged_accounts(rng: random.Random) -> Iterator[Trial]:
    """Yield accounts whose rows are others, and ways to sign in that must not let anybody in."""
    good = ("--account", "chief")
    changes: list[tuple[str, Change]] = []
    for column in (
        "id", "name", "full_name", "role", "password_hash", "failures", "locked_until",
        "is_disabled", "changed_at", "must_change_password", "system_user",
    ):  # fmt: skip
        changes += [
            (f"{column} = {str(cell)[:12]!a}", partial(_set_cells, "accounts", column, cell))
            for cell in _CELLS
        ]
    changes += [
        (
            f"password_hash {number}",
            partial(_change_hash, random.Random(f"{number} {rng.random()}")),
        )
        for number in range(60)
    ]
    for what, change in changes:
        make = partial(_changed, [change], accounts=True)
        yield _record_trial("accounts", what, make, 0, options=good, stdin=PASSWORD)
    wrong = [
        (), ("--account", ""), ("--account", "x" * 5000), ("--account", "chief\x00"),
        ("--account", "' OR 1=1 --"), ("--account", "nobody"), ("--account", "CHIEF "),
        ("--account", "chief", "--password-file", "nothing"),
        ("--account", "chief", "--password-fd", "77"),
        ("--account", "chief", "--password-fd", "-1"),
        ("--account", "chief", "--password-file", "/dev/zero"),
        ("--account", "chief", "--password-file", "."),
    ]  # fmt: skip
    passwords = ["", "x", "\x00", PASSWORD.upper(), PASSWORD + "\u202e", "p" * 100_000, "\udcff"]
    make = partial(_changed, [], accounts=True)
    for options in wrong:
        for password in passwords:
            what = f"{' '.join(options)[:40]!a} {password[:9]!a}"
            yield _record_trial(
                "signing in", what, make, 0, options=options, stdin=password, expected="refused"
            )
    for password in passwords:
        yield _record_trial(
            "signing in", f"chief {password[:9]!a}", make, 0,
            options=good, stdin=password, expected="refused",
        )  # fmt: skip


def _change_hash(rng: random.Random, database: sqlite3.Connection) -> None:
    (text,) = database.execute("SELECT password_hash FROM accounts").fetchone()
    at = rng.randrange(len(text))
    choices: list[str] = [
        text[:at],
        text[:at] + rng.choice("$,=0aZ+/") + text[at + 1 :],
        text.replace("m=", "m=9999999"),
        text.replace("t=", "t=99999999"),
        text.replace("v=19", "v=99"),
        text.replace("argon2id", rng.choice(["argon2i", "md5", "bcrypt", ""])),
    ]
    database.execute("UPDATE accounts SET password_hash = ?", [rng.choice(choices)])


LIST = (
    "Name;Born;Personal number;Phone\nÅsa Öberg;1970-03-02;700302-2380;070 1\nPer Ek;1980-01-01;;\n"
)


def bad_lists(rng: random.Random) -> Iterator[Trial]:
    """Yield lists of persons to import that are damaged, or are none."""
    sound = LIST.encode()
    lists: list[tuple[str, bytes]] = [
        (what, content) for what, content, _ in byte_mutations(sound, rng, 120, 30)
    ]
    codecs = ("utf-16", "utf-16-be", "utf-32", "utf-8-sig", "cp1252", "mac-roman", "cp437", "utf-7")
    lists += [(codec, LIST.encode(codec, "replace")) for codec in codecs]
    cells = [
        "", " ", "\x00", "\x1b[2J", "\u202e", "\u2028", '"', '""', "'", "=cmd|'/C calc'!A0",
        "x" * 200_000, "1970-02-30", "0000-00-00", "30/02/1970", "02/03/70", "9" * 20, "-1", "NaN",
        "ﷺ" * 300, "700302-2381", "\ud800", "{0}{name}", "<b>x</b>", "%s%n", "a\nb", ";", "\t",
    ]  # fmt: skip
    for column in range(4):
        for cell in cells:
            row = ["Åsa Öberg", "1970-03-02", "700302-2380", "070 1"]
            row[column] = cell
            quoted = ";".join('"' + each.replace('"', '""') + '"' for each in row)
            for number, line in enumerate((";".join(row), quoted)):
                text = f"Name;Born;Personal number;Phone\n{line}\n"
                written = text.encode("utf-8", "surrogatepass")
                lists.append((f"{column} = {cell[:9]!a} {number}", written))
    for delimiter in (",", "\t", "|", ":", ";;", " ", "\x1f", "a", "\x00"):
        lists.append((f"delimiter {delimiter!a}", LIST.replace(";", delimiter).encode()))
    lists += [
        ("no rows", b"Name;Born\n"),
        ("only rows", b"A;1970-01-01\n" * 3),
        ("ragged", b"Name;Born\nA\nB;1970-01-01;x;y\n"),
        ("headings twice", b"Name;Name;Born;Born\nA;B;1970-01-01;1970-01-02\n"),
        ("many columns", b";".join(b"c%d" % n for n in range(20_000)) + b"\nA\n"),
        ("one long line", b"Name;" + b"x" * 3_000_000),
        ("open quote", b'Name;Born\n"A;1970-01-01\n' * 500),
        ("many lines", b"Name;Born\n" + b"A;1970-01-01\n" * 5000),
        ("returns", LIST.replace("\n", "\r").encode()),
        ("xlsx", zip_of([("xl/workbook.xml", b"<x/>"), ("[Content_Types].xml", b"<x/>")])),
        ("case file", samples.CASES[2]),
        ("record", sound_record()),
    ]
    for number, (what, content) in enumerate(lists):
        make = partial(_put, {FILE: sound_record(), "list.csv": content})
        yield Trial("list", what, make, partial(_import, ["list.csv", *_ORDERS[number % 3]]))
    for what, place in PLACES.items():
        make = partial(_with_place, "list.csv", place)
        yield Trial("list", what, make, partial(_import, ["list.csv"]), "refused")


_ORDERS: tuple[tuple[str, ...], ...] = (
    ("--day-first", "--report", "report.csv"),
    ("--dry-run",),
    ("--month-first", "--doubtful"),
)


def bad_cases(rng: random.Random) -> Iterator[Trial]:
    """Yield case files that are damaged, to import into a record."""
    with tempfile.TemporaryDirectory() as name:
        sound = samples.case_bytes(Path(name))
    entries = dict(entries_of(sound))
    others = [entry for entry in entries.items() if entry[0] != "case.json"]
    values = json.loads(entries["case.json"])
    people = {key: value for key, value in values.items() if key != "feet"}
    mutated = list(json_mutations(people))
    changed = [
        (what, zip_of([*others, ("case.json", _with_feet(content, values["feet"]))]))
        for what, content, _ in rng.sample(mutated, min(130, len(mutated)))
    ]
    changed += [(what, content) for what, content, _ in byte_mutations(sound, rng, 50, 20)]
    for what, content in changed:
        files = {
            **sound_files(),
            "cases/a.insole": content,
            "cases/b.insole": samples.CASES[2],
        }
        yield Trial("case to import", what, partial(_put, files), partial(_import, ["cases"]))


def _with_feet(content: bytes, feet: Any) -> bytes:
    text = content.decode("utf-8", "surrogatepass").rstrip()
    return f'{text[:-1]}, "feet": {json.dumps(feet)}}}'.encode("utf-8", "surrogatepass")


NAMES = {
    "empty": "",
    "dot": ".",
    "dots": "..",
    "root": "/",
    "folder": "folder",
    "in a file": "file/x",
    "slash": "x/",
    "no folder": "a/b/c",
    "255 bytes": "n" * 255,
    "256 bytes": "n" * 256,
    "255 of four bytes": "𝒏" * 63,
    "path of 5000": "/".join(["n" * 90] * 55),
    "control": "x\x1b[2J\x07",
    "line": "x\n100%  Done",
    "override": "x\u202egnp",
    "undecodable": "x\udcff\udcfe",
    "spaces": "  x  ",
    "dash": "-",
    "option": "--out",
    "device": "con",
    "stars": "*?[a]",
    "quotes": "\"'`$(x)",
    "braces": "{path}{0}%s%n",
    "backslash": "..\\x",
    "tilde": "~nobody/x",
    "full": "/dev/full",
    "null": "/dev/null",
    "standard output": "/dev/stdout",
    "kernel": "/proc/self/mem",
    "no place": "/proc/nothing",
    "link": "link",
    "dangling link": "dangling",
    "link to itself": "loop",
    "link to a folder": "linked",
    "in a linked folder": "linked/x",
    "pipe": "pipe",
    "hard link": "hard",
    "its own input": "file",
    "the record": FILE,
}
_WITH_NAMES: dict[str, list[str]] = {
    "scan": ["inspect", "{}"],
    "scan to": ["inspect", "foot.ply", "--side", "left", "--report", "{}.json"],
    "measures to": ["measure", "foot.ply", "--side", "left", "--report", "m", "--csv", "{}.csv"],
    "page to": ["calibrate", "reference", "--report", "{}.html"],
    "any page to": ["calibrate", "reference", "--report", "{}"],
    "session to": ["simulate", "{}", "--seed", "1", "--side", "x"],
    "session": ["reconstruct", "{}", "--out", "f.ply"],
    "order": ["order", "verify", "{}"],
    "record": ["records", "list", "--record", "{}"],
    "list": ["records", "import", "{}", "--record", "."],
    "list to": ["records", "import", "list.csv", "--record", ".", "--dry-run", "--report", "{}"],
    "person to": ["records", "export", PERSON, "--out", "{}", "--record", "."],
    "words": ["records", "list", "{}", "--record", "."],
    "person": ["records", "show", "{}", "--record", "."],
    "database": ["records", "list", "--database", "{}", "--contents", "x"],
    "device": ["design", "foot.ply", "--side", "left", "--device", "{}", "--out", "i.stl"],
    "rules": ["design", "foot.ply", "--side", "left", "--rules", "{}", "--out", "i.stl"],
    "steps": ["doctor", "--report", "{}"],
}  # fmt: skip


def odd_names(_rng: random.Random) -> Iterator[Trial]:
    """Yield names that no file can have, or that somebody has chosen to mislead."""
    sound_record()  # once for all of them
    for command, words in _WITH_NAMES.items():
        for what, name in NAMES.items():
            filled = [word.replace("{}", name) for word in words]
            yield Trial("name", f"{command}: {what}", _names, partial(_in_folder, filled))


def _names(folder: Path) -> None:
    from insole_core.formats.ply import write_ply

    (folder / FILE).write_bytes(sound_record())
    (folder / "list.csv").write_text(LIST, encoding="utf-8")
    write_ply(samples.foot_mesh(), folder / "foot.ply")
    (folder / "file").write_text("mine")
    (folder / "folder").mkdir()
    (folder / "folder" / "thesis.txt").write_text("mine")
    (folder / "link").symlink_to("file")
    (folder / "dangling").symlink_to("nothing")
    (folder / "loop").symlink_to("loop")
    (folder / "linked").symlink_to("folder")
    os.link(folder / "file", folder / "hard")
    os.mkfifo(folder / "pipe")


def _in_folder(words: list[str], given: Path, made: Path) -> None:
    """Run a command in a copy of the folder; what was there stays, unless a result is named so."""
    os.environ["XDG_DATA_HOME"] = str(made / "data")
    work = made / "work"
    shutil.copytree(given, work, symlinks=True, copy_function=_copy)
    (work / "hard").unlink()
    os.link(work / "file", work / "hard")
    _run_in(work, words)


def _copy(source: str, target: str) -> None:
    if Path(source).is_fifo():
        os.mkfifo(target)
    else:
        shutil.copy2(source, target, follow_symlinks=False)


# What all of them share


def _record_trial(
    family: str,
    what: str,
    make: Callable[[Path], None],
    number: int,
    *,
    options: tuple[str, ...] = (),
    stdin: str = "",
    expected: Expected = "any",
) -> Trial:
    words = READING[number % len(READING)]
    read = partial(_read_record, [*words, *options], stdin)
    return Trial(family, f"{what}: {words[0]}", make, read, expected)


def _read_record(words: list[str], stdin: str, given: Path, made: Path) -> None:
    work = made / "work"
    shutil.copytree(given, work, symlinks=True, copy_function=_copy)
    typed = made / "typed"
    typed.write_text(stdin, encoding="utf-8", errors="surrogateescape")
    if stdin and "--password-file" not in words and "--password-fd" not in words:
        typed.chmod(0o600)
        words = [*words, "--password-file", str(typed)]
    os.environ["XDG_DATA_HOME"] = str(made / "data")
    _run_in(work, ["records", *words, "--record", "."])


def _import(words: list[str], given: Path, made: Path) -> None:
    work = made / "work"
    shutil.copytree(given, work, symlinks=True, copy_function=_copy)
    _run_in(work, ["records", "import", *words, "--record", "."])


def _run_in(work: Path, words: list[str]) -> None:
    """Run a command in a folder; raise an error if what it refuses leaves something there."""
    os.chdir(work)
    before = fingerprint(work)
    try:
        run_command(words)
    except Exception:
        left = {name for name in fingerprint(work) if name not in before and not _is_database(name)}
        if left:
            raise RuntimeError(f"left behind: {sorted(left)}") from None
        raise
    kept = fingerprint(work)
    lost = {name for name in before if kept.get(name) != before[name] and not _is_own(name, words)}
    if lost:
        raise RuntimeError(f"changed: {sorted(lost)}")


def _is_database(name: str) -> bool:
    """Return whether a file is part of a record, which opening one makes or writes."""
    return name.startswith((FILE, "contents"))


def _is_own(name: str, words: list[str]) -> bool:
    return _is_database(name) or any(name in word or word in name for word in words)


def _put(files: dict[str, bytes], folder: Path) -> None:
    for name, content in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)


def _placed(place: Callable[[Path], None], folder: Path) -> None:
    place(folder / FILE)


def _with_place(name: str, place: Callable[[Path], None], folder: Path) -> None:
    (folder / FILE).write_bytes(sound_record())
    place(folder / name)


def _changed(changes: list[Change], folder: Path, *, accounts: bool = False) -> None:
    _put(sound_files(), folder)
    path = folder / FILE
    if accounts:
        path.write_bytes(record_with_accounts())
    with closing(sqlite3.connect(path)) as database:
        for change in changes:
            change(database)
        database.commit()


def _byte(content: bytes, at: int, value: int) -> bytes:
    return content[:at] + bytes([value]) + content[at + 1 :]


FAMILIES = {
    "record": damaged_records,
    "schema": changed_schemas,
    "accounts": damaged_accounts,
    "lists": bad_lists,
    "case import": bad_cases,
    "names": odd_names,
}
