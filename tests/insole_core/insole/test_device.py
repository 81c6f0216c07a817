"""Devices: what they change, what they leave, and their files."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from referencing import Registry, Resource

from insole_core.errors import DesignError, InputError
from insole_core.geometry.side import Side
from insole_core.insole.elements import HeelSkive, Pelott, Posting
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_json import design_from_json, design_to_json
from insole_core.insole.prescription.device import (
    apply_device,
    device_of,
    device_to_json,
    read_device,
    write_device,
)
from insole_core.insole.prescription.item_name import key_of
from insole_core.insole.prescription.outline import Outline
from insole_core.insole.prescription.shell import Shell
from insole_core.insole.prescription.template import mirrored
from insole_core.resources import resource_path

DEVICES = sorted(resource_path("devices").glob("*.json"))
KEYS = {
    "as-scanned", "eva-full-length", "functional-three-quarter", "dress-three-quarter",
    "sport-full-length", "ucbl-child", "diabetic-full-length", "flat",
}  # fmt: skip
PATIENTS = InsoleDesign(
    Side.RIGHT,
    (Pelott(centre_mm=(3.0, 140.0)), Posting(rearfoot_deg=4), HeelSkive()),
    grid_mm=0.5,
    margin_mm=12.0,
    outline=Outline(source="shoe_size", shoe_size_eu=41.0, toe_allowance_mm=9.0),
    shell=Shell(body_weight_kg=82.0),
)


def content(name: str) -> dict[str, Any]:
    loaded: dict[str, Any] = json.loads(resource_path(f"devices/{name}.json").read_text("utf-8"))
    return loaded


def test_the_product_has_these_devices():
    assert {path.stem for path in DEVICES} == KEYS
    assert all(key_of(read_device(path).name) == path.stem for path in DEVICES)
    assert all(read_device(path).source for path in DEVICES)


@pytest.mark.parametrize("path", DEVICES, ids=lambda path: path.stem)
def test_a_device_keeps_what_is_of_the_patient(path: Path):
    device = read_device(path)
    made = apply_device(device, PATIENTS)
    assert made.device == device.name
    for key in ("side", "corrections", "grid_mm", "margin_mm", "max_height_mm"):
        assert getattr(made, key) == getattr(PATIENTS, key)
    assert (made.outline.source, made.outline.shoe_size_eu) == ("shoe_size", 41.0)
    assert made.outline.extent == device.values.outline.extent
    assert made.outline.toe_allowance_mm == device.values.outline.toe_allowance_mm
    assert (made.finish, made.base, made.bottom) == (
        device.values.finish, device.values.base, device.values.bottom,
    )  # fmt: skip
    assert made.shell is None or made.shell.body_weight_kg == 82.0
    assert made.least_thickness_mm == device.values.least_thickness_mm


@pytest.mark.parametrize("path", DEVICES, ids=lambda path: path.stem)
def test_a_design_of_a_device_is_one_value_on_disk_and_mirrored(path: Path):
    made = apply_device(read_device(path), PATIENTS)
    assert design_from_json(json.loads(json.dumps(design_to_json(made)))) == made
    assert mirrored(made) == apply_device(read_device(path), mirrored(PATIENTS))


def test_as_scanned_undoes_every_other_device():
    plain = InsoleDesign(Side.LEFT)
    as_scanned = read_device(resource_path("devices/as-scanned.json"))
    for path in DEVICES:
        back = apply_device(as_scanned, apply_device(read_device(path), plain))
        assert replace(back, device="") == plain


def test_a_device_of_a_design_makes_the_same_on_another_foot(tmp_path: Path):
    worn = apply_device(
        read_device(resource_path("devices/functional-three-quarter.json")), PATIENTS
    )
    assert worn.shell is not None
    worn = replace(
        worn,
        thickness_mm=4.5,
        shell=replace(worn.shell, trim_mm=((40.0, 150.0), (-40.0, 140.0)), chamfer_mm=1.0),
    )
    own = device_of(worn, " Ours ", ("mine",), "the clinic")
    path = tmp_path / "ours.json"
    write_device(own, path)
    assert read_device(path) == own
    assert own.name == "Ours"
    other = apply_device(own, InsoleDesign(Side.LEFT))
    assert (other.thickness_mm, other.corrections, other.outline.source) == (4.5, (), "foot")
    assert other.shell == replace(worn.shell, trim_mm=None, body_weight_kg=None)


@pytest.mark.parametrize("name", ["", "  ", "--", "x" * 61])
def test_a_device_needs_a_name(name: str):
    with pytest.raises(DesignError, match="1 to 60 characters"):
        device_of(PATIENTS, name)


def without(key: str) -> dict[str, Any]:
    return {k: v for k, v in content("flat").items() if k != key}


def with_design(**values: Any) -> dict[str, Any]:
    return {**content("flat"), "design": {**content("flat")["design"], **values}}


BAD = [
    (without("format"), "format is missing"),
    (without("name"), "name is missing"),
    ({**content("flat"), "format": "insole-design"}, 'format .* must be "insole-device"'),
    ({**content("flat"), "version": 2}, "version 2.*newer"),
    ({**content("flat"), "side": "left"}, "side does not belong here: a device fits both feet"),
    ({**content("flat"), "nmae": "Flat"}, "nmae is no key of a device"),
    ({**content("flat"), "name": "..."}, "1 to 60 characters"),
    (with_design(side="left"), "design.side does not belong here"),
    (with_design(corrections=[]), "design.corrections is no key of a device"),
    (with_design(grid_mm=1), "design.grid_mm is no key"),
    (with_design(thickness_mm=0), "thickness_mm is 0, and must be 0.5 to 40 mm"),
    (with_design(bottom="round"), 'bottom is "round"'),
    (with_design(outline={"source": "drawn"}), "design.outline.source is no key"),
    (with_design(finish={"arch_fil_mm": 1}), "arch_fil_mm"),
    (with_design(finish={"rim": [{"border": "inner", "along": 0, "height_mm": 1}]}), "inner"),
    (with_design(shell={"body_weight_kg": 80}), "design.shell .* belong to one foot"),
    (with_design(shell={"trim_mm": [[40, 150], [-40, 140]]}), "design.shell .* belong to one foot"),
    ([], "one JSON object"),
]


FORMATS = Path(__file__).parents[3] / "docs" / "formats"
SCHEMAS = [
    json.loads((FORMATS / f"{n}.schema.json").read_text("utf-8")) for n in ("device", "design")
]
VALIDATOR = jsonschema.Draft202012Validator(
    {**SCHEMAS[0], "$id": "device.schema.json"},
    registry=Registry().with_resource("design.schema.json", Resource.from_contents(SCHEMAS[1])),
)


@pytest.mark.parametrize("path", DEVICES, ids=lambda path: path.stem)
def test_the_devices_obey_the_schema(path: Path):
    VALIDATOR.validate(content(path.stem))
    VALIDATOR.validate(json.loads(json.dumps(device_to_json(read_device(path)))))


@pytest.mark.parametrize(("bad", "sentence"), BAD, ids=[sentence for _, sentence in BAD])
def test_the_schema_refuses_what_the_reader_refuses(bad: Any, sentence: str):
    if sentence != "1 to 60 characters":  # which characters count is more than a schema says
        assert not VALIDATOR.is_valid(bad)


@pytest.mark.parametrize(("bad", "sentence"), BAD, ids=[sentence for _, sentence in BAD])
def test_a_device_is_read_strictly(tmp_path: Path, bad: Any, sentence: str):
    path = tmp_path / "device.json"
    path.write_text(json.dumps(bad), "utf-8")
    with pytest.raises(InputError, match=sentence) as refused:
        read_device(path)
    assert str(path) in str(refused.value)


def test_the_file_holds_only_what_a_device_is():
    for path in DEVICES:
        assert device_to_json(read_device(path))["design"].keys() <= {
            "thickness_mm", "outline", "layers", "bottom", "base", "finish", "shell",
        }  # fmt: skip
