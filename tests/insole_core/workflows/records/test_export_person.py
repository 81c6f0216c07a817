"""A person as a folder that opens without this program."""

from __future__ import annotations

import hashlib
import json
import zipfile
from dataclasses import replace
from datetime import date
from html.parser import HTMLParser
from pathlib import Path

import jsonschema
import pytest
import trimesh
from fhirclient.models.devicerequest import DeviceRequest
from fhirclient.models.patient import Patient
from read_pdf import bytes_of_pdf

from insole_core.cases.case_file import read_case
from insole_core.errors import InputError, OutputError
from insole_core.geometry.side import Side
from insole_core.insole.elements import Pelott
from insole_core.progress import Cancelled, Progress
from insole_core.records.capture import NOT_RECORDED
from insole_core.records.person import Person
from insole_core.records.visit import Visit
from insole_core.solids.prescription_paper import Responsible
from insole_core.workflows.records.export_person import export_person

_SCHEMA = Path(__file__).parents[4] / "docs/formats/record.schema.json"


@pytest.fixture(scope="module")
def export(clinic, tmp_path_factory):
    return export_person(clinic.records, clinic.person.id, tmp_path_factory.mktemp("out") / "p")


@pytest.fixture(scope="module")
def pseudonymous(clinic, tmp_path_factory):
    folder = tmp_path_factory.mktemp("out") / "p"
    return export_person(clinic.records, clinic.person.id, folder, is_pseudonymous=True)


@pytest.mark.slow
def test_the_folder_holds_everything_and_its_checksums(export):
    found = {p.relative_to(export.folder).as_posix() for p in export.folder.rglob("*.*")}
    assert found >= {
        "summary.html", "summary.pdf", "person.json", "fhir/Patient.json",
        "visits/2026-03-01/case.insole", "visits/2026-03-01/left.stl",
        "visits/2026-11-20/case.insole", "visits/2026-11-20/left.stl",
        "visits/2026-11-20/right.stl", "orders/26-7KQ4M/26-7KQ4M-left.stl",
        "orders/26-7KQ4M/26-7KQ4M-left-prescription.pdf",
    }  # fmt: skip
    assert found == set(export.files)
    assert export.left_out == ()
    sums = dict(
        reversed(line.split("  "))
        for line in (export.folder / "SHA256SUMS").read_text().splitlines()
    )
    assert sums == {
        name: hashlib.sha256((export.folder / name).read_bytes()).hexdigest() for name in found
    }


def test_only_the_owner_may_read_it(export):
    paths = [export.folder, *export.folder.rglob("*")]
    assert all(path.stat().st_mode & 0o077 == 0 for path in paths)


def test_no_text_of_the_patient_is_part_of_a_path(export):
    assert not any("berg" in name.casefold() for name in export.files)


def test_the_summary_shows_texts_as_texts_and_needs_nothing_else(export, clinic):
    page = _Page((export.folder / "summary.html").read_text(encoding="utf-8"))
    assert f"Name: {clinic.person.name}" in page.text
    assert "Åsa Öberg: plattfot <foot>" in page.text
    assert "Pelott" in page.text
    assert page.tags.isdisjoint({"script", "foot", "link", "iframe"})
    assert page.sources
    assert all(source.startswith("data:") for source in page.sources)
    assert page.text.index("Visit on 2026-11-20") < page.text.index("Visit on 2026-03-01")
    assert (export.folder / "summary.pdf").read_bytes().startswith(b"%PDF")


def test_the_summary_alone_tells_years_later_how_the_devices_came_about(export, clinic):
    page = _Page((export.folder / "summary.html").read_text(encoding="utf-8"))
    new = clinic.visits[1]
    left = clinic.records.prescriptions.versions(new.id, Side.LEFT)
    (capture,) = clinic.records.captures.of_visit(new.id)
    for told in (
        f"made with Insole Studio {left[0].program_version}",
        "version 2 of ",
        "version 1 of ",
        ": Öberg wants it so",
        f"Capture: {capture.file_name}",
        f"– SHA-256 {capture.content_sha256}",
        f"captures/{_capture_name(export)}, SHA-256 {capture.content_sha256}",
        f"calibrated on: {NOT_RECORDED}",
        f"orders/26-7KQ4M/26-7KQ4M-left.stl, SHA-256 {hashlib.sha256(b'of the shop').hexdigest()}",
        "Written by",
    ):
        assert told in page.text, told


def test_the_json_keeps_to_its_schema_and_holds_all_versions(export):
    content = _json(export, "person.json")
    jsonschema.Draft202012Validator(json.loads(_SCHEMA.read_text())).validate(content)
    old, new = content["visits"]
    assert [(v["side"], v["number"]) for v in old["prescriptions"]] == [("left", 1)]
    assert [(v["side"], v["number"]) for v in new["prescriptions"]] == [
        ("left", 1), ("left", 2), ("right", 1)
    ]  # fmt: skip
    corrections = new["prescriptions"][1]["foot"]["variants"][0]["design"]["corrections"]
    assert [correction["type"] for correction in corrections] == ["pelott"]
    assert content["orders"][0]["version_ids"] == [new["prescriptions"][1]["id"]]
    assert content["follow_ups"][0]["notes"] == "Öberg runs"


def test_the_case_and_the_insoles_are_those_of_each_visit(export, clinic):
    case = read_case(export.folder / "visits/2026-11-20/case.insole")
    assert case.patient.name == clinic.person.name
    assert [foot.side for foot in case.feet] == [Side.LEFT, Side.RIGHT]
    assert len(case.feet[0].design.corrections) == 1
    plain, padded, right = (
        trimesh.load(export.folder / "visits" / name)
        for name in ("2026-03-01/left.stl", "2026-11-20/left.stl", "2026-11-20/right.stl")
    )
    assert all(solid.is_watertight and solid.volume > 0 for solid in (plain, padded, right))
    assert padded.volume > plain.volume + 1000
    assert abs(plain.bounds[0, 2]) < 1e-3
    # The right foot is the mirror image of the left one.
    assert right.bounds[1, 0] == pytest.approx(-plain.bounds[0, 0], abs=0.5)


def test_the_fhir_resources_are_read_by_a_reader_of_r4(export, clinic):
    patient = Patient(_json(export, "fhir/Patient.json"))
    assert patient.name[0].text == clinic.person.name
    requests = [
        DeviceRequest(_json(export, name)) for name in export.files if "DeviceRequest" in name
    ]
    assert [r.parameter[0].valueCodeableConcept.text for r in requests] == ["left", "left", "right"]
    assert [r.status for r in requests] == ["draft", "draft", "draft"]
    assert requests[1].groupIdentifier.value == "26-7KQ4M"
    assert {r.subject.reference for r in requests} == {f"Patient/{patient.id}"}


@pytest.mark.slow
def test_a_pseudonymous_export_names_and_describes_nobody(pseudonymous, clinic):
    said = ("Öberg", "berg", "1964-08-23", "196408233234", "070 1", "plattfot", "heel spur")
    for path in filter(Path.is_file, pseudonymous.folder.rglob("*")):
        content = _all_bytes(path)
        for text in said:
            for encoding in ("utf-8", "latin-1", "utf-16-le", "utf-16-be"):
                assert text.encode(encoding) not in content, (path, text)
    page = _Page((pseudonymous.folder / "summary.html").read_text(encoding="utf-8"))
    assert clinic.person.pseudonym in page.text
    content = _json(pseudonymous, "person.json")
    jsonschema.Draft202012Validator(json.loads(_SCHEMA.read_text())).validate(content)
    assert not any("prescription.pdf" in name or "captures" in name for name in pseudonymous.files)
    assert "orders/26-7KQ4M/26-7KQ4M-left.stl" in pseudonymous.files
    assert len(pseudonymous.left_out) == 2
    case = read_case(pseudonymous.folder / "visits/2026-11-20/case.insole")
    assert (case.patient.name, case.patient.pseudonym) == ("", clinic.person.pseudonym)


def test_a_name_in_a_prescription_is_refused_where_it_would_leave(clinic, tmp_path):
    records = clinic.records
    person = records.persons.add(Person("Lena Holmgren"))
    visit = records.visits.add(Visit(person.id, date(2026, 11, 20)))
    foot = records.visits.open_case(clinic.visits[0].id).record.feet[0]
    records.prescriptions.save(visit.id, foot.with_name("A", "for Holmgren"), None)
    with pytest.raises(InputError, match="prescription holds the patient's name"):
        export_person(records, person.id, tmp_path / "p", is_pseudonymous=True)
    assert list(tmp_path.iterdir()) == []


def test_a_damaged_surface_and_an_impossible_insole_are_told_and_the_rest_exported(
    clinic, tmp_path
):
    records = clinic.records
    person = records.persons.add(Person("Per Ek"))
    visits = [records.visits.add(Visit(person.id, date(2026, 11, 20))) for _ in range(2)]
    foot = records.visits.open_case(clinic.visits[1].id).record.feet[1]
    recess = Pelott(centre_mm=(0.0, 35.0), height_mm=-8.0)
    impossible = foot.with_design(replace(foot.design, corrections=(recess,)))
    records.prescriptions.save(visits[0].id, impossible, None)
    known = set(records.contents.digests())
    mesh = foot.foot.mesh.moved(foot.foot.mesh.vertices + 1e-9)
    moved = replace(foot, foot=replace(foot.foot, mesh=mesh))
    records.prescriptions.save(visits[1].id, moved, None)
    (stored,) = set(records.contents.digests()) - known
    path = records.contents.path(stored)
    path.chmod(0o600)
    path.write_bytes(b"changed")
    export = export_person(records, person.id, tmp_path / "p")
    thin, damaged = export.left_out
    assert thin.startswith("visits/2026-11-20/right.stl: The insole would be")
    assert damaged.startswith("visits/2026-11-20-2, right, version 1: ")
    assert "visits/2026-11-20/case.insole" in export.files
    page = _Page((export.folder / "summary.html").read_text(encoding="utf-8"))
    assert thin in page.text
    assert _json(export, "person.json")["visits"][1]["prescriptions"][0]["foot"] is None


@pytest.mark.slow
def test_the_statement_of_a_signed_order_is_exported_where_the_maker_is_known(clinic, tmp_path):
    records = clinic.records
    person = records.persons.add(Person("Per Ek"))
    visit = records.visits.add(Visit(person.id, date(2026, 11, 20)))
    foot = records.visits.open_case(clinic.visits[0].id).record.feet[0]
    base = records.prescriptions.save(visit.id, foot, None)
    records.prescriptions.sign(base.version_id)
    order = records.orders.add(visit.id, [base.version_id])
    maker = Responsible(maker="Shop", maker_address="Street 1")
    export = export_person(records, person.id, tmp_path / "p", responsible=maker)
    content = _json(export, f"orders/{order.number}/statement.json")
    assert content["identification"]["name"] == "Per Ek"
    assert content["responsible"]["prescriber"] == "anna"
    assert f"orders/{order.number}/statement.pdf" in export.files
    assert _json(export, "fhir/DeviceRequest-1.json")["requester"] == {"display": "anna"}
    nobody = export_person(records, person.id, tmp_path / "q")
    (missing,) = nobody.left_out
    assert "without the maker" in missing


def test_names_that_could_be_paths_become_plain_ones(clinic, tmp_path):
    records = clinic.records
    person = records.persons.add(Person("Per Ek"))
    visit = records.visits.add(Visit(person.id, date(2026, 11, 20)))
    foot = records.visits.open_case(clinic.visits[0].id).record.feet[0]
    base = records.prescriptions.save(visit.id, foot, None)
    files = []
    for number, name in enumerate(("Ek Per.stl", "CON é.stl", "x.stl"), start=1):
        path = tmp_path / name
        path.write_bytes(b"solid" * number)
        files.append(path)
    records.orders.add(visit.id, [base.version_id], files=files, number="../../Ek Per")
    export = export_person(records, person.id, tmp_path / "p")
    of_order = sorted(name for name in export.files if name.startswith("orders/"))
    assert of_order == ["orders/order/file-2.stl", "orders/order/file.stl", "orders/order/x.stl"]


def test_a_folder_with_other_files_stays_and_a_cancelled_export_leaves_nothing(clinic, tmp_path):
    (tmp_path / "p").mkdir()
    (tmp_path / "p/mine.txt").write_text("mine")
    with pytest.raises(OutputError, match=r"mine\.txt"):
        export_person(clinic.records, clinic.person.id, tmp_path / "p")
    answers = iter([False, False, True])
    with pytest.raises(Cancelled):
        export_person(
            clinic.records,
            clinic.person.id,
            tmp_path / "q",
            progress=Progress(is_cancelled=lambda: next(answers)),
        )
    assert [path.name for path in tmp_path.iterdir()] == ["p"]


def test_the_audit_log_tells_the_export_without_a_name(export, clinic):
    lines = clinic.records.audit.lines(subject_id=clinic.person.id)
    details = [line.details for line in lines if line.action == "exported"]
    assert len(export.files) in [json.loads(text)["files"] for text in details]
    assert not any("berg" in text for text in details)


def _capture_name(export):
    (name,) = (Path(name).name for name in export.files if "/captures/" in name)
    return name


def _all_bytes(path):
    """Return the name of a file, and all that is in it, unpacked."""
    content = path.name.encode() + path.read_bytes()
    if path.suffix == ".pdf":
        content += bytes_of_pdf(path)
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as archive:
            for name in archive.namelist():
                content += name.encode() + archive.read(name)
    return content


class _Page(HTMLParser):
    """What a browser makes of a page: its text, tags and sources of pictures."""

    def __init__(self, content: str) -> None:
        super().__init__()
        self.text = ""
        self.tags: set[str] = set()
        self.sources: list[str] = []
        self.feed(content)

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.sources += [value for name, value in attributes if name in ("src", "href")]

    def handle_data(self, data):
        self.text += data + "\n"


def _json(export, name):
    return json.loads((export.folder / name).read_text(encoding="utf-8"))
