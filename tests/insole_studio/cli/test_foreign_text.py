"""Names of files and what stands in them: nothing in them steers a terminal or forges a line."""

import json
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.simulate import FootShape, build_foot
from insole_core.visible_text import is_control
from insole_studio.cli.main import run

SMALL_SESSION = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"
EVIL = "x\x1b[2J\x1b]0;owned\x07\u202egnp\r\n100%  forged\x9b31m\u2066y"


@pytest.fixture(scope="module")
def given(tmp_path_factory):
    folder = tmp_path_factory.mktemp("given")
    mesh = build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(1), cell_mm=6.0).mesh
    write_ply(mesh, folder / "foot.ply")
    shutil.unpack_archive(SMALL_SESSION, folder / "session")
    return folder


@pytest.fixture
def folder(given, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / EVIL).mkdir()
    shutil.copy(given / "foot.ply", tmp_path / f"{EVIL}.ply")
    shutil.copy(given / "foot.ply", tmp_path / "foot.ply")
    return tmp_path


def names(suffix, content):
    """Return what makes a file of an evil name with a content."""

    def make(_given):
        Path(f"{EVIL}{suffix}").write_bytes(content)

    return make


def manifest(**changes):
    def make(given):
        shutil.copytree(given / "session", "session")
        path = Path("session/manifest.json")
        values = json.loads(path.read_text())
        for key, value in changes.items():
            values[key] = value
        path.write_text(json.dumps(values))

    return make


def zipped(*entries):
    def make(_given):
        with zipfile.ZipFile("given.zip", "w") as archive:
            for entry in entries:
                archive.writestr(entry, "x")

    return make


def text_file(name, text):
    def make(_given):
        Path(name).write_text(text, encoding="utf-8", errors="surrogatepass", newline="")

    return make


def nothing(_given):
    """Leave the folder as it is."""


def no_folder(_given):
    """Leave nothing of the evil name: what is there, the window would open."""
    Path(EVIL).rmdir()


E = EVIL
CASES = {
    "no such scan": (nothing, ["inspect", f"{E}.stl"]),
    "no such session": (nothing, ["reconstruct", f"{E}/s", "--out", "f.ply"]),
    "not decodable": (nothing, ["inspect", "x\udcff\udc80.stl"]),
    "empty scan": (names(".stl", b""), ["inspect", f"{E}.stl"]),
    "scan of text": (names(".ply", b"ply\nformat " + E.encode()), ["inspect", f"{E}.ply"]),
    "name in an STL": (
        names(".stl", f"solid {E}\nfacet normal {E}".encode()), ["inspect", f"{E}.stl"],
    ),
    "property of a PLY": (
        text_file("a.ply", f"ply\nformat ascii 1.0\nelement {E[:6]} 3\nend_header\n"),
        ["inspect", "a.ply"],
    ),
    "good scan": (nothing, ["inspect", f"{E}.ply"]),
    "measured": (nothing, ["measure", f"{E}.ply", "--side", "right", "--report", f"{E}.json"]),
    "folder in the way": (nothing, ["measure", f"{E}.ply", "--side", "right", "--report", E]),
    "no such folder": (nothing, ["measure", "foot.ply", "--report", f"{E}{E}/m.json"]),
    "compared": (nothing, ["compare", f"{E}.ply", f"{E}.ply", "--report", f"{E}.json"]),
    "side": (nothing, ["measure", "foot.ply", "--side", E, "--report", "m.json"]),
    "option": (nothing, ["measure", f"--{E}"]),
    "command": (no_folder, [E]),
    "unknown command": (nothing, [f"no{E}"]),
    "too many words": (nothing, ["sensors", E]),
    "device": (nothing, ["design", "foot.ply", "--side", "right", "--device", E, "--out", "i.stl"]),
    "prescription": (
        names(".json", json.dumps({E: E, "format": E}).encode()),
        ["design", "foot.ply", "--side", "right", "--prescription", f"{E}.json", "--out", "i.stl"],
    ),
    "recorded at": (manifest(recorded_at=E), ["reconstruct", "session", "--out", "f.ply"]),
    "format": (manifest(format=E), ["reconstruct", "session", "--out", "f.ply"]),
    "view": (manifest(views=[E]), ["reconstruct", "session", "--out", "f.ply"]),
    "key": (manifest(**{E: E, "side": E}), ["reconstruct", "session", "--out", "f.ply"]),
    "entry of a zip": (
        zipped(E, f"{E}/manifest.json"), ["reconstruct", "given.zip", "--out", "f.ply"],
    ),
    "entries of a zip": (zipped("manifest.json", E, E + "2"), ["inspect", "given.zip"]),
    "order": (text_file("order.json", json.dumps({"format": E, E: 1})), ["order", "verify", "."]),
    "pressure": (
        names(".csv", f"{E};{E}\n1;2\n".encode()),
        ["pressure", f"{E}.csv", "--foot", "foot.ply", "--side", "right", "--report", "r.json"],
    ),
    "table": (
        text_file("persons.csv", f'Name,Born\n"{E}",1980-01-01\nX,"{E}"\n'),
        ["records", "import", "persons.csv", "--record", "record", "--report", "r.csv"],
    ),
    "heading": (
        text_file("persons.csv", f'Name,"{E}"\nEk,1980-01-01\n'),
        ["records", "import", "persons.csv", "--record", "record", "--dry-run"],
    ),
    "column": (
        text_file("persons.csv", "Name,Born\nEk,1980-01-01\n"),
        ["records", "import", "persons.csv", "--record", "record", "--column", f"{E}=name"],
    ),
    "record": (nothing, ["records", "list", "--record", E]),
    "database": (nothing, ["records", "list", "--database", E, "--contents", E]),
    "words": (nothing, ["records", "list", E, "--record", "record"]),
    "day": (nothing, ["records", "list", "--visits", E]),
    "session to": (nothing, ["calibrate", "session", "foot.ply", "--out", E]),
    "system": (
        text_file("s.json", json.dumps({"format": E})), ["calibrate", "reference", "s.json"],
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_nothing_in_it_reaches_the_terminal(case, given, folder, capsys):
    make, words = CASES[case]
    make(given)
    try:
        run(words)
    except SystemExit as ended:
        assert ended.code in (0, 2)  # noqa: PT017 - how argparse ends
    captured = capsys.readouterr()
    said = captured.out + captured.err
    assert [c for c in said if is_control(c) and c not in "\n\t"] == []
    assert not any(line.startswith("100%  forged") for line in said.splitlines())
    assert "Traceback" not in said
    assert said
