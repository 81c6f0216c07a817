"""What a computer holds outside the record of somebody erased goes with them."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from insole_core.cases.case_record import CaseRecord, Patient
from insole_core.records.traces import Traces
from insole_studio.document.journal import Origin, find_recovered, new_journal, write_journal
from insole_studio.document.kept_visit import UnkeptVisit
from insole_studio.document.record_maintenance import ErasedLeftovers, forget_leftovers
from insole_studio.settings import Settings, folder_names, load_settings, save_settings
from insole_studio.user_paths import UserPaths

NAME = "Zaphodina Uniqname"
CAPTURE = "0a1b2c3d-0000-4000-8000-000000000000"
TRACES = Traces.of((NAME,), {"visit-1"}, {CAPTURE})


@pytest.fixture
def paths(tmp_path: Path) -> UserPaths:
    paths = UserPaths(tmp_path / "config" / "settings.json", tmp_path / "data" / "autosave")
    for folder in (paths.settings_folder, paths.autosave_folder, paths.fetched_folder):
        folder.mkdir(parents=True)
    return paths


def leave(paths: UserPaths, patient: Patient, visit_id: str = "") -> None:
    """Leave unsaved work, as a window does whose program was killed."""
    origin = Origin()
    if visit_id:
        origin = Origin(visit=UnkeptVisit(visit_id, patient, {}))
    write_journal(CaseRecord(patient), origin, new_journal(paths.autosave_folder))


def bytes_of(folder: Path) -> bytes:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return b"\n".join(str(path).encode() + path.read_bytes() for path in files)


def test_the_leftovers_of_one_person_go_and_those_of_others_stay(paths: UserPaths) -> None:
    leave(paths, Patient(NAME, notes="flat foot"), "visit-1")
    leave(paths, Patient("Uniqname, Zaphodina"))  # of a file, not of the record
    leave(paths, Patient("Eva Berg"), "visit-2")
    leave(paths, Patient("Eva Berg"))
    for capture in (CAPTURE, CAPTURE.replace("0a", "ff")):
        (paths.fetched_folder / f"mesh-{capture[:8]}.stl").write_bytes(NAME.encode())
    printed = paths.papers_folder / "1" / "prescription.pdf"
    printed.parent.mkdir(parents=True)
    printed.write_bytes(NAME.encode())
    settings = Settings(recent=[f"/home/{NAME}.insole", "/home/eva.insole"])
    for name in folder_names():
        setattr(settings, name, f"/home/{NAME}/{name}")
    settings.scans_folder = "/home/Eva"
    save_settings(settings, paths.settings_file)
    forget_leftovers(TRACES, paths, settings)
    left = find_recovered(paths.autosave_folder)
    assert [journal.record.patient.name for journal in left] == ["Eva Berg", "Eva Berg"]
    assert [path.name for path in paths.fetched_folder.iterdir()] == ["mesh-ff1b2c3d.stl"]
    assert not printed.exists()
    assert NAME.encode() not in bytes_of(paths.settings_folder)
    assert NAME.encode() not in bytes_of(paths.autosave_folder)
    stored = load_settings(paths.settings_file)
    assert (stored.recent, stored.scans_folder) == (["/home/eva.insole"], "/home/Eva")


def test_a_note_that_another_window_has_just_removed_is_no_error(paths: UserPaths) -> None:
    note = paths.erasures_folder / "1.json"
    note.parent.mkdir()
    note.write_text(json.dumps({"person": "person-1", **TRACES.to_json()}))

    class Known(dict[str, bool]):
        def get(self, *_of: object) -> bool:  # type: ignore[override]
            note.unlink()  # between reading it and looking at its age
            return False

    leftovers = ErasedLeftovers(paths)
    leftovers.forget(Known({"person-1": False}))
    assert not leftovers.are_noted


def test_settings_that_are_damaged_lose_the_name_and_nothing_else(paths: UserPaths) -> None:
    """Also those of a clinician with the same name, and what was set aside as damaged."""
    damaged = f'{{"author": "Dr Ek", "recent": ["/home/{NAME} 1.insole", "/home/eva.insole"'
    broken = paths.settings_file.with_name("settings.json.broken-1")
    for path in (paths.settings_file, broken):
        path.write_text(damaged)
        forget_leftovers(TRACES, paths)
        assert path.read_text() == damaged.replace("Uniqname", "–")
    wrong = {"theme": 7, "author": NAME, "recent": [f"/{NAME}.insole", 3], "later": [NAME]}
    paths.settings_file.write_text(json.dumps(wrong))
    forget_leftovers(TRACES, paths)
    assert json.loads(paths.settings_file.read_text()) == {**wrong, "recent": [3]}
