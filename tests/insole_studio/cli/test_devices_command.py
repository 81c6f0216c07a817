"""Devices and findings on the command line."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh

from insole_core.formats.ply import write_ply
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_to_json
from insole_core.insole.prescription.device import device_of
from insole_core.insole.prescription.materials import read_materials
from insole_core.simulate import FootShape, build_foot
from insole_core.workflows.clinic_devices import DefaultDevice, clinic_devices
from insole_core.workflows.clinic_tables import ClinicMaterials
from insole_studio.cli.main import run
from insole_studio.user_paths import UserPaths


@pytest.fixture(scope="module")
def scan(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    write_ply(build_foot(FootShape(), np.random.default_rng(1), cell_mm=4.0).mesh, path)
    return path


@pytest.fixture
def clinic(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of the clinic's settings."""
    paths = UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")
    monkeypatch.setattr(UserPaths, "of_user", lambda: paths)
    return paths.settings_folder


def ours(thickness_mm: float = 7.0):
    return device_of(InsoleDesign(Side.LEFT, thickness_mm=thickness_mm), "Ours")


def made(scan: Path, tmp_path: Path, *options: str) -> trimesh.Trimesh:
    out = tmp_path / "i.stl"
    assert run(["design", str(scan), "--side", "left", "--out", str(out), *options]) == 0
    return trimesh.load_mesh(out, process=False)


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


def test_devices_and_findings_are_listed(clinic: Path, capsys: pytest.CaptureFixture[str]) -> None:
    clinic_devices(clinic).save(ours())
    assert run(["devices"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "device\tours\tOurs" in lines
    assert "device\teva-full-length\tEVA, full length\tdefault" in lines
    assert "finding\tcavus-foot\tCavus foot" in lines
    DefaultDevice(clinic).save("Ours")
    assert run(["devices", "--json"]) == 0
    listed = json.loads(capsys.readouterr().out)
    assert [item["key"] for item in listed if item.get("default")] == ["ours"]
    assert all(item["source"] for item in listed if item["key"] != "ours")


def test_a_device_that_cannot_be_read_is_told(
    clinic: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    clinic_devices(clinic).save(ours())
    (clinic / "devices" / "ours.json").write_text("half a fi")
    DefaultDevice(clinic).save("Ours")
    assert run(["devices"]) == 0
    said = capsys.readouterr()
    assert "ours.json is not valid JSON" in said.err
    assert 'The clinic\'s device "Ours" is gone' in said.err
    assert "EVA, full length\tdefault" in said.out


def test_an_unknown_device_is_answered_with_the_known_ones(
    clinic: Path, scan: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["design", str(scan), "--side", "left", "--out", str(tmp_path / "i.stl")]
    assert run([*call, "--device", "clog"]) == 1
    assert last_line(capsys).startswith('There is no device "clog"; choose one of as-scanned, ')
    assert run([*call, "--finding", "cold feet"]) == 1
    assert last_line(capsys).startswith('There is no finding "cold feet"; choose one of ')
    assert not (tmp_path / "i.stl").exists()


@pytest.mark.slow
def test_a_design_starts_with_the_clinics_device(clinic: Path, scan: Path, tmp_path: Path) -> None:
    usual = made(scan, tmp_path)
    named = made(scan, tmp_path, "--device", "EVA, full length")
    np.testing.assert_array_equal(usual.vertices, named.vertices)
    scanned = made(scan, tmp_path, "--device", "as-scanned")
    assert scanned.extents[2] > usual.extents[2] + 3  # the flanks, above a designed rim
    clinic_devices(clinic).save(ours())
    DefaultDevice(clinic).save("Ours")
    thick = made(scan, tmp_path)
    assert thick.extents[2] == pytest.approx(scanned.extents[2] + 4, abs=1e-3)


@pytest.mark.slow
def test_a_prescription_stays_as_it_is_unless_a_device_is_named(
    clinic: Path, scan: Path, tmp_path: Path
) -> None:
    DefaultDevice(clinic).save("UCBL, child")
    design = InsoleDesign(Side.LEFT, (Pelott(centre_mm=(0.0, 140.0)),), grid_mm=2.0)
    path = tmp_path / "design.json"
    path.write_text(json.dumps(design_to_json(design)))
    plain = made(scan, tmp_path, "--prescription", str(path))
    path.write_text(json.dumps(design_to_json(replace(design, corrections=()))))
    bare = made(scan, tmp_path, "--prescription", str(path))
    assert plain.volume > bare.volume
    short = made(scan, tmp_path, "--prescription", str(path), "--device", "ucbl-child")
    assert short.extents[1] < 0.8 * bare.extents[1]


@pytest.mark.slow
def test_findings_add_up(clinic: Path, scan: Path, tmp_path: Path) -> None:
    plain = made(scan, tmp_path)
    lifted = made(scan, tmp_path, "--finding", "leg-length-discrepancy")
    both = made(scan, tmp_path, "--finding", "leg-length-discrepancy", "--finding", "metatarsalgia")
    assert plain.volume < lifted.volume < both.volume


@pytest.mark.slow
def test_a_table_of_materials_says_how_thick_it_is_made(
    scan: Path, clinic: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    table = tmp_path / "shop.json"
    listed = [{"name": "PP", "least_mm": 6, "least_edge_mm": 3, "thickness": [{"mm": 6}]}]
    listed.append({**listed[0], "name": "polypropylene"})
    content = {"format": "insole-materials", "version": 1, "materials": listed}
    table.write_text(json.dumps(content))
    options = ("--device", "functional-three-quarter")
    plain = made(scan, tmp_path, *options)
    thick = made(scan, tmp_path, *options, "--materials", str(table))
    assert thick.volume > 1.3 * plain.volume
    ClinicMaterials(clinic).save(read_materials(table).materials)
    assert made(scan, tmp_path, *options).volume == pytest.approx(thick.volume)
    table.write_text(json.dumps({**content, "materials": []}))
    arguments = ["design", str(scan), "--side", "left", "--out", str(tmp_path / "o.stl")]
    assert run([*arguments, "--materials", str(table)]) == 1
    assert "holds no material; add one" in last_line(capsys)
    assert not (tmp_path / "o.stl").exists()
