"""What `design` hands to the shop beside the solid."""

from __future__ import annotations

import hashlib
import json
import re
import zipfile
from pathlib import Path

import numpy as np
import pytest
import trimesh
from read_pdf import text_of_pdf

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.simulate import FootShape, build_foot
from insole_studio.cli.main import run
from insole_studio.settings import Settings, save_settings
from insole_studio.user_paths import UserPaths

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def call(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    write_ply(build_foot(FootShape(), np.random.default_rng(1), cell_mm=4.0).mesh, path)
    return ["design", str(path), "--side", str(Side.LEFT)]


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


def test_everything_at_once(call: list[str], tmp_path: Path) -> None:
    out, checks, sheet = (tmp_path / name for name in ("i.stl", "checks.json", "sheet.pdf"))
    options = ["--mark", "Ł 7 足", "--triangles", "30000", "--chamfer", "1", "--draft", "5"]
    papers = ["--checks", str(checks), "--job-sheet", str(sheet)]
    assert run([*call, "--out", str(out), *options, *papers]) == 0
    solid = trimesh.load_mesh(out)
    assert solid.is_watertight
    assert len(solid.faces) <= 30_000
    record = json.loads(checks.read_text())
    assert {finding["name"] for finding in record["findings"]} >= {"watertight", "thickness"}
    assert sheet.read_bytes().startswith(b"%PDF")
    assert len(hashlib.sha256(out.read_bytes()).hexdigest()) == 64


def test_pair_in_one_block_with_prescription_paper(call: list[str], tmp_path: Path) -> None:
    other = tmp_path / "right.ply"
    shape = FootShape(side=Side.RIGHT)
    write_ply(build_foot(shape, np.random.default_rng(2), cell_mm=4.0).mesh, other)
    out, paper = tmp_path / "pair.3mf", tmp_path / "prescription.pdf"
    options = ["--pair", str(other), "--block", "EVA pair", "--relief", "raised", "--mark", "7"]
    papers = ["--prescription-paper", str(paper), "--pseudonym", "P-7", "--layers"]
    papers += ["--prescriber", "A. Ek", "--maker", "Sula AB", "--maker-address", "Gatan 1, Lund"]
    assert run([*call, "--out", str(out), *options, *papers]) == 0
    scene = trimesh.load_scene(out)
    assert sorted(scene.geometry) == ["left insole, base", "right insole, base"]
    assert paper.read_bytes().startswith(b"%PDF")


def test_ascii(call: list[str], tmp_path: Path) -> None:
    out = tmp_path / "i.stl"
    assert run([*call, "--out", str(out), "--ascii"]) == 0
    assert out.read_text().startswith("solid ")


def test_blocking_rule_and_its_override(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rules = tmp_path / "rules.json"
    rule = {"shoe_height": {"policy": "blocking", "limit": 5}}
    rules.write_text(json.dumps({"format": "insole-export-rules", "version": 1, "rules": rule}))
    out, checks = tmp_path / "i.stl", tmp_path / "checks.json"
    options = [*call, "--out", str(out), "--rules", str(rules), "--checks", str(checks)]
    assert run(options) == 1
    assert "mm high" in last_line(capsys)
    assert not out.exists()
    assert not checks.exists()
    assert run([*options, "--override", "agreed with the patient"]) == 0
    override = json.loads(checks.read_text())["override"]
    assert override["reason"] == "agreed with the patient"
    assert override["author"]


@pytest.mark.parametrize(
    ("options", "code", "sentence"),
    [
        (["--job-sheet", "{tmp}/sheet.txt"], 2, "written as .pdf"),
        (["--triangles", "50"], 1, "too few"),
        (["--mark", " "], 1, "identification is empty"),
        (["--lot", "7" * 300], 2, "The lot of the material of the order has 300"),
        (["--draft", "80"], 2, "--draft is 80, and must be -15 to 30 degrees."),
        (["--chamfer", "-1"], 2, "--chamfer is -1, and must be 0 to 10 mm."),
        (["--rules", "{tmp}/none.json"], 1, "cannot be read"),
        (["--cutter", "0"], 2, "--cutter is 0, and must be 1 to 40 mm."),
        (["--pair", "{tmp}/none.ply"], 2, "name it with --block"),
        (["--block", "marble"], 2, 'the shop has "EVA single"'),
        (["--layers"], 2, "needs a .3mf file"),
        (["--zones", "z.json"], 2, "name the program with --printer"),
        (["--printer", "orca", "--zones", "z.json"], 2, "Only a .3mf file holds zones"),
        (["--out", "{tmp}/i.3mf", "--printer", "orca"], 2, "needs either --zones or"),
        (["--out", "{tmp}/i.3mf", "--printer", "cura", "--print-preset", "PLA"], 2, "choose one"),
        (["--out", "{tmp}/i.3mf", "--printer", "cura", "--zones", "no.json"], 1, "cannot be"),
        (["--checks", "{tmp}/no/c.json"], 1, "its folder does not exist"),
    ],
)
def test_failures_leave_nothing_behind(
    call: list[str],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    options: list[str],
    code: int,
    sentence: str,
) -> None:
    words = [word.format(tmp=tmp_path) for word in options]
    assert run([*call, "--out", str(tmp_path / "i.stl"), *words]) == code
    assert sentence in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


def test_zones_for_a_printer(call: list[str], tmp_path: Path) -> None:
    out, zones = tmp_path / "i.3mf", tmp_path / "zones.json"
    content = {"format": "insole-zones", "version": 1, "preset": "PETG", "weight_kg": 120}
    content["zones"] = [{"zone": "heel", "density_percent": 33}]
    zones.write_text(json.dumps(content))
    options = ["--printer", "prusaslicer", "--zones", str(zones)]
    sheet = tmp_path / "sheet.pdf"
    assert run([*call, "--out", str(out), *options, "--job-sheet", str(sheet)]) == 0
    printed = " ".join(text_of_pdf(sheet).split())
    assert re.search(r"layers of 0.2 mm \d+ %, [\d.]+ g", printed)
    assert re.search(r"heel 33 % \d+ %, [\d.]+ g", printed)
    assert "make the print denser than its infill" in printed
    with zipfile.ZipFile(out) as archive:
        config = archive.read("Metadata/Slic3r_PE_model.config").decode()
    assert re.findall(r'"name" value="(.+? %)"', config) == [
        "arch 100 %", "forefoot 60 %", "heel 33 %",
    ]  # fmt: skip


def test_an_order_number_is_made_where_there_is_no_pseudonym(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out, sheet = tmp_path / "i.stl", tmp_path / "sheet.pdf"
    assert run([*call, "--out", str(out), "--job-sheet", str(sheet)]) == 0
    said = re.search(r"Order number: (\d\d-\w{5})", capsys.readouterr().err)
    assert said is not None
    assert said[1].encode() in out.read_bytes()[:80]
    assert said[1] in text_of_pdf(sheet)
    assert "the block has" not in text_of_pdf(sheet)  # none was named


def test_a_prescription_without_a_maker_is_a_wrong_call(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    paper = ["--prescription-paper", str(tmp_path / "p.pdf"), "--prescriber", "A. Ek"]
    assert run([*call, "--out", str(tmp_path / "i.stl"), *paper]) == 2
    assert "has to state the maker, the maker's address; give --prescriber" in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


def test_who_prescribes_and_makes_is_taken_from_the_settings(
    call: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        UserPaths, "of_user", lambda: UserPaths(tmp_path / "settings.json", tmp_path / "autosave")
    )
    kept = Settings(author="A. Ek", clinic="Foot Clinic", maker="Sula AB", maker_address="Lund")
    save_settings(kept, tmp_path / "settings.json")
    paper = tmp_path / "p.pdf"
    assert run([*call, "--out", str(tmp_path / "i.stl"), "--prescription-paper", str(paper)]) == 0
    for words in ("A. Ek", "Foot Clinic", "Sula AB", "Lund"):
        assert words in text_of_pdf(paper)


def test_a_coarse_grid_is_told_before_the_file_is_used(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    prescription, checks = tmp_path / "design.json", tmp_path / "checks.json"
    design = {"format": "insole-design", "version": 1, "side": "left", "corrections": []}
    prescription.write_text(json.dumps({**design, "grid_mm": 4.5}))
    papers = ["--prescription", str(prescription), "--checks", str(checks)]
    assert run([*call, "--out", str(tmp_path / "i.stl"), *papers]) == 0
    told = capsys.readouterr().err
    assert "computed on a grid of 4.5 mm; 2 is the most allowed" in told
    findings = json.loads(checks.read_text())["findings"]
    assert [f["passed"] for f in findings if f["name"] == "grid"] == [False]


def test_a_design_that_adds_up_to_too_much_is_refused(
    call: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    prescription = tmp_path / "design.json"
    posting = {"type": "posting", "rearfoot_deg": 15}
    design = {"format": "insole-design", "version": 1, "side": "left"}
    prescription.write_text(json.dumps({**design, "corrections": [posting] * 100}))
    out = tmp_path / "i.stl"
    assert run([*call, "--out", str(out), "--prescription", str(prescription)]) == 1
    assert "turn the foot by 1500° together, and must be -15 to 15 degrees" in last_line(capsys)
    assert not out.exists()
