"""Devices and forms of product and clinic."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.errors import InputError, OutputError
from insole_core.insole.prescription.device import Device, device_of, write_device
from insole_core.workflows.clinic_devices import (
    AS_SCANNED,
    DEFAULT_DEVICE,
    clinic_devices,
    clinic_forms,
    default_device,
    find_device,
)


def ours(name: str = "Ours & mine", thickness_mm: float = 5.0) -> Device:
    values = find_device(clinic_devices(Path("/nowhere")).load().items, DEFAULT_DEVICE).values
    return device_of(replace(values, thickness_mm=thickness_mm), name, ("mine",), "the clinic")


def test_those_of_the_product_are_there_without_a_folder(tmp_path: Path):
    devices = clinic_devices(tmp_path / "none").load()
    assert find_device(devices.items, DEFAULT_DEVICE).values.finish is not None
    assert find_device(devices.items, AS_SCANNED).values.finish is None
    assert (devices.own, devices.unreadable) == (frozenset(), ())
    assert set(clinic_forms(tmp_path).load().items) == {
        "flat", "eva-full-length", "functional-three-quarter", "dress-three-quarter",
        "sport-full-length", "ucbl-child", "diabetic-full-length",
    }  # fmt: skip


def test_a_device_of_the_clinic_is_stored_changed_and_removed(tmp_path: Path):
    files = clinic_devices(tmp_path)
    files.save(ours())
    files.save(ours(thickness_mm=6.0))
    loaded = files.load()
    assert loaded.items["ours-mine"] == ours(thickness_mm=6.0)
    assert loaded.own == {"ours-mine"}
    files.remove("Ours & mine")
    assert "ours-mine" not in files.load().items
    files.remove("Ours & mine")  # a second time, nothing is wrong


def test_a_device_that_was_copied_in_is_changed_and_removed_like_the_others(tmp_path: Path):
    copied = tmp_path / "devices" / "sent by mail.json"
    copied.parent.mkdir()
    write_device(ours(), copied)
    files = clinic_devices(tmp_path)
    files.save(ours(thickness_mm=6.0))
    assert files.load().items["ours-mine"] == ours(thickness_mm=6.0)
    files.remove("Ours & mine")
    assert "ours-mine" not in files.load().items


def test_the_clinics_device_takes_the_place_of_the_products(tmp_path: Path):
    files = clinic_devices(tmp_path)
    product = files.load().items["flat"]
    files.save(ours("Flat"))
    assert files.load().items["flat"] == ours("Flat")
    files.remove("Flat")
    assert files.load().items["flat"] == product


def test_a_device_goes_from_clinic_to_clinic(tmp_path: Path):
    there = tmp_path / "sent.json"
    clinic_devices(tmp_path / "one").export(ours(), there)
    other = clinic_devices(tmp_path / "two")
    other.save(other.read(there))
    assert other.load().items["ours-mine"] == ours()


def test_a_file_that_cannot_be_read_is_told_and_hides_no_other(tmp_path: Path):
    files = clinic_devices(tmp_path)
    files.save(ours())
    broken = tmp_path / "devices" / "half.json"
    broken.write_text("half a fi")
    loaded = files.load()
    assert "ours-mine" in loaded.items
    (sentence,) = loaded.unreadable
    assert str(broken) in sentence


def test_a_file_that_cannot_be_read_is_kept_when_another_takes_its_place(tmp_path: Path):
    files = clinic_devices(tmp_path)
    path = tmp_path / "devices" / "ours-mine.json"
    path.parent.mkdir()
    path.write_text("half a fi")
    files.save(ours())
    assert path.with_name("ours-mine.json.broken-1").read_text() == "half a fi"
    assert files.load().items["ours-mine"] == ours()


def test_a_folder_that_cannot_be_made_is_one_sentence(tmp_path: Path):
    (tmp_path / "file").write_bytes(b"")
    with pytest.raises(OutputError, match="cannot be written"):
        clinic_devices(tmp_path / "file").save(ours())


def test_importing_what_is_no_device_stores_nothing(tmp_path: Path):
    path = tmp_path / "sent.json"
    path.write_text('{"format": "insole-design", "version": 1}')
    with pytest.raises(InputError, match="insole-device"):
        clinic_devices(tmp_path).read(path)
    assert not (tmp_path / "devices").exists()


def test_a_device_is_found_by_its_name_in_any_spelling(tmp_path: Path):
    devices = clinic_devices(tmp_path).load().items
    for name in ("EVA, full length", "eva full-length", "EVA-FULL-LENGTH"):
        assert find_device(devices, name).name == "EVA, full length"
    with pytest.raises(InputError, match=r'no device "clog".*as-scanned.*ucbl-child'):
        find_device(devices, "clog")


def test_a_default_that_is_gone_is_told(tmp_path: Path):
    devices = clinic_devices(tmp_path).load().items
    assert default_device(devices, "flat") == (devices["flat"], None)
    device, problem = default_device(devices, "Ours")
    assert device.name == DEFAULT_DEVICE
    assert problem == (
        'The clinic\'s device "Ours" is gone, so new designs start with "EVA, full length"; choose '
        "another one as the clinic's."
    )


def test_a_written_device_is_text_of_any_language(tmp_path: Path):
    path = tmp_path / "d.json"
    write_device(ours("Sula för häl"), path)
    assert "Sula för häl" in path.read_text("utf-8")
