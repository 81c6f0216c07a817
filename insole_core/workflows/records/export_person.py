"""One person as a folder that opens without this program: docs/formats/person-export.md."""

from __future__ import annotations

import io
import json
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import date
from itertools import groupby
from pathlib import Path, PurePosixPath
from typing import Any, Final

from PIL import Image, ImageDraw, ImageFont

from insole_core.cases.case_file import write_case
from insole_core.cases.case_json import foot_to_json
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.errors import DesignError, InputError, NotAllowed, RecordsError, Unreachable
from insole_core.evaluation.report_files import write_html, write_pdf
from insole_core.export.lettering import letters_note
from insole_core.files.atomic import make_private_folder, replacing_folder, write_private
from insole_core.formats.stl import write_stl
from insole_core.geometry.side import Side
from insole_core.given_file import sha256_of
from insole_core.insole.build import build_insole
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.records.fhir import (
    PrescribedDevice,
    Resource,
    device_request_resource,
    patient_resource,
)
from insole_core.records.order import Order, OrderFile
from insole_core.records.photo import Photo, PhotoMark
from insole_core.records.photos import jpeg_of
from insole_core.records.records import Records
from insole_core.records.rights import Right, require
from insole_core.records.statement import statement_of, write_statement_paper
from insole_core.records.visits import patient_of
from insole_core.solids.export_job import standing
from insole_core.solids.prescription_paper import NOBODY, Responsible
from insole_core.solids.solid import make_solid
from insole_core.workflows.records.person_dossier import (
    ExportedFile,
    PersonDossier,
    VisitDossier,
    person_json,
    pseudonymous,
    pseudonymous_foot,
    read_dossier,
)
from insole_core.workflows.records.person_summary import (
    ENGLISH,
    FootPicture,
    Relief,
    Wording,
    person_report,
    relief_of,
)
from insole_core.workflows.records.plain_name import plain_name

SUMS_NAME: Final = "SHA256SUMS"
_PERSON_NAME: Final = "person.json"
_MARK_COLOR: Final = "#ff5f00"
"""Stands out from skin, and from the red and green of the sides."""
_LINE, _TEXT = 1 / 250, 1 / 32
"""Width of a line, and height of a number, as parts of the longer side."""


@dataclass(frozen=True)
class PersonExport:
    """What was exported.

    Parameters
    ----------
    files
        Paths within the folder.
    left_out
        A sentence for each thing that is not in it.
    """

    folder: Path
    files: tuple[str, ...]
    left_out: tuple[str, ...]


def export_person(
    records: Records,
    person_id: str,
    folder: Path,
    *,
    is_pseudonymous: bool = False,
    responsible: Responsible = NOBODY,
    wording: Wording = ENGLISH,
    progress: Progress = SILENT,
) -> PersonExport:
    """Export all that the record holds of a person, as a whole or not at all.

    What is damaged or cannot be made, such as an insole of a foot that is too short for it, is left
    out and told.

    Parameters
    ----------
    folder
        New or empty.
    is_pseudonymous
        Leave out all that names or describes the person.
    responsible
        Maker and clinic, for the statement (Annex XIII) of each order whose prescriptions are
        signed; who signed is in the record.
    wording
        The language of summary and statement.

    Raises
    ------
    InputError
        When a pseudonymous export would hold the name in a text of a prescription.
    OutputError
        When the folder cannot be written, or holds other files.
    RecordsError
        When there is no such person, or the account may not export.
    Cancelled
    """
    with records.context.reading() as connection:
        require(connection, records.who, Right.EXPORT)
    dossier = read_dossier(records, person_id)
    name = dossier.person.name
    if is_pseudonymous:
        dossier = pseudonymous(dossier)
    with replacing_folder(folder) as beside:
        writer = _ExportWriter(records, dossier, name, beside, responsible, wording=wording)
        writer.write(progress)
    files = tuple(file.path for file in writer.files)
    with records.context.writing(Right.EXPORT, dossier.person.id) as connection:
        records.context.log(
            connection,
            "exported",
            "person",
            dossier.person.id,
            files=len(files),
            is_pseudonymous=is_pseudonymous,
        )
    return PersonExport(folder, files, tuple(writer.left_out))


class _ExportWriter:
    """Writes the parts of an export into an unfinished folder."""

    def __init__(
        self,
        records: Records,
        dossier: PersonDossier,
        name: str,
        folder: Path,
        responsible: Responsible,
        *,
        wording: Wording,
    ) -> None:
        self._records = records
        self._dossier = dossier
        self._name = name
        """Of the person, also where the dossier is pseudonymous."""
        self._folder = folder
        self._responsible = responsible
        self._wording = wording
        self._feet: dict[str, Any] = {}
        self._pictures: dict[str, list[FootPicture]] = {}
        self._requests: list[Resource] = []
        self.files: list[ExportedFile] = []
        self.left_out: list[str] = list(dossier.withheld)

    def write(self, progress: Progress) -> None:
        """Write everything.

        Raises
        ------
        InsoleError, Cancelled
        """
        visits = self._dossier.visits
        names = _numbered([visit.visit.visited_on.isoformat() for visit in visits])
        for visit, name, step in zip(
            visits, names, progress.part(0.0, 0.8).parts(len(visits)), strict=True
        ):
            step.step(0.0, "Exporting the visit of {day}", day=visit.visit.visited_on.isoformat())
            self._write_visit(visit, f"visits/{name}", step)
        progress.step(0.8, "Exporting orders")
        orders = self._dossier.orders
        numbers = _numbered([plain_name(order.number, "order") for order in orders])
        for order, name in zip(orders, numbers, strict=True):
            progress.step(0.8, "Exporting the order {number}", number=order.number)
            self._write_order(order, f"orders/{name}")
        self._write_fhir()
        progress.step(0.9, "Writing the summary")
        self._write_summary()

    def _write_visit(self, dossier: VisitDossier, place: str, progress: Progress) -> None:
        feet = self._read_versions(dossier, place, progress.part(0.0, 0.2))
        case = CaseRecord(self._patient(dossier))
        for foot in reversed(feet):  # the left one is shown first
            case = case.with_foot(foot)
        if feet:
            self._add(
                f"{place}/case.insole", lambda path: write_case(case, path, self._packed(dossier))
            )
        for foot, step in zip(case.feet, progress.part(0.2, 0.9).parts(len(feet)), strict=True):
            self._write_foot(dossier, foot, place, step)
        for capture in dossier.captures:
            progress.step(0.9, "Copying {name}", name=capture.file_name)
            with self._told(f"{place}, {capture.file_name}"):
                folder = self._new_folder(f"{place}/captures")
                self._note(self._records.captures.copy_to(capture, folder))
        for photo in dossier.photos:
            self._write_photo(photo, f"{place}/photos")

    def _write_photo(self, photo: Photo, place: str) -> None:
        """Write a photo as it is, and once more with its marks drawn on it."""
        name = f"{place}/{photo.number}.jpg"
        with self._told(name):
            picture = self._records.photos.picture(photo)
            self._add(name, lambda path: write_private(path, picture))
            if photo.marks:
                marked = _with_marks(picture, photo.marks)
                self._add(
                    f"{place}/{photo.number}-marked.jpg", lambda path: write_private(path, marked)
                )

    def _patient(self, dossier: VisitDossier) -> Patient:
        if not self._dossier.is_pseudonymous:
            return patient_of(self._dossier.person, dossier.visit)
        day = dossier.visit.visited_on.isoformat()
        return Patient(visit=day, pseudonym=self._dossier.person.pseudonym)

    def _packed(self, dossier: VisitDossier) -> dict[Side, bytes]:
        """Return the surfaces of the newest feet as the record has them packed."""
        newest = (dossier.newest(side) for side in Side)
        read = self._records.prescriptions.packed_surface
        return {
            version.side: read(version.id)
            for version in newest
            if version is not None and version.id in self._feet
        }

    def _read_versions(
        self, dossier: VisitDossier, place: str, progress: Progress
    ) -> list[FootRecord]:
        """Keep what each version of a prescription states; return the newest of each foot."""
        newest: dict[Side, FootRecord] = {}
        versions = dossier.versions
        for version, step in zip(versions, progress.parts(len(versions)), strict=True):
            step.step(0.0, "Reading version {number}", number=version.number)
            foot = None
            with self._told(f"{place}, {version.side}, version {version.number}"):
                foot = self._records.prescriptions.read(version.id)
            if foot is not None and self._dossier.is_pseudonymous:
                foot = pseudonymous_foot(foot, self._name)
            if foot is not None:
                self._feet[version.id] = foot_to_json(foot)
                if version == dossier.newest(version.side):
                    newest[version.side] = foot
        return [newest[side] for side in Side if side in newest]

    def _write_foot(
        self, dossier: VisitDossier, foot: FootRecord, place: str, progress: Progress
    ) -> None:
        insole = None
        with self._told(f"{place}/{foot.side}.stl"):
            insole = self._write_insole(foot, f"{place}/{foot.side}.stl", progress.part(0.0, 0.8))
        progress.step(0.8, "Drawing the foot")
        sole = relief_of(foot.foot.mesh, from_above=False)
        picture = FootPicture(foot.side, foot.variant(foot.chosen), sole, insole)
        self._pictures.setdefault(dossier.visit.id, []).append(picture)
        version = dossier.newest(foot.side)
        if version is not None:
            order = self._dossier.order_of(version.id)
            device = PrescribedDevice(version, foot.design, dossier.visit, order)
            self._requests.append(device_request_resource(self._dossier.person, device))

    def _write_insole(self, foot: FootRecord, name: str, progress: Progress) -> Relief:
        insole = build_insole(foot.foot, foot.design, progress.part(0.0, 0.7))
        progress.step(0.7, "Closing the insole")
        solid = make_solid(insole)
        solid = solid.transformed(standing(solid))
        label = f"{self._dossier.person.pseudonym}, {foot.side}"
        progress.step(0.8, "Writing the insole")
        self._add(name, lambda path: write_stl(solid, path, label))
        return relief_of(solid, from_above=True)

    def _write_order(self, order: Order, place: str) -> None:
        for release, files in groupby(order.files, lambda file: file.release):
            is_newest = release == order.release
            where = place if is_newest else f"{place}/revision-{release}"
            self._write_order_files(tuple(files), where)
        self._write_statement(order, place)

    def _write_order_files(self, files: Sequence[OrderFile], place: str) -> None:
        names = _numbered([plain_name(file.name, "file") for file in files])
        for file, name in zip(files, names, strict=True):
            with self._told(f"{place}/{name}"):
                path = self._new_folder(place) / name
                self._records.contents.copy_to(file.content_sha256, path)
                self._note(path)

    def _write_statement(self, order: Order, place: str) -> None:
        """Write the statement of an order, which names the patient; nothing unsigned is stated."""
        versions = (v for visit in self._dossier.visits for v in visit.versions)
        signed = {version.id for version in versions if version.signed_by}
        if self._dossier.is_pseudonymous or not signed.issuperset(order.version_ids):
            return
        with self._told(f"{place}/statement.pdf"):
            statement = statement_of(self._records.context, order.id, self._responsible)
            self._add_json(f"{place}/statement.json", statement.as_json())
            self._add(
                f"{place}/statement.pdf",
                lambda path: write_statement_paper(
                    statement, path, date.today(), self._wording.translate
                ),
            )

    def _write_fhir(self) -> None:
        person, is_pseudonymous = self._dossier.person, self._dossier.is_pseudonymous
        patient = patient_resource(person, is_pseudonymous=is_pseudonymous)
        self._add_json("fhir/Patient.json", patient)
        for number, request in enumerate(self._requests, start=1):
            self._add_json(f"fhir/DeviceRequest-{number}.json", request)

    def _write_summary(self) -> None:
        letters = letters_note([self._dossier.person.name])
        if letters is not None:
            self.left_out.append(Message("{what}: {reason}", what="summary.pdf", reason=letters))
        files = [f"{file.path}, SHA-256 {file.sha256}" for file in self.files]
        report = person_report(self._dossier, self._pictures, files, self.left_out, self._wording)
        self._add("summary.html", lambda path: write_html(report, path))
        self._add("summary.pdf", lambda path: write_pdf(report, path))
        content = person_json(self._dossier, self._feet, self.files, self.left_out)
        self._add_json(_PERSON_NAME, content)
        sums = "".join(f"{file.sha256}  {file.path}\n" for file in self.files)
        write_private(self._folder / SUMS_NAME, sums.encode())

    @contextmanager
    def _told(self, what: str) -> Iterator[None]:
        """Note what is damaged or cannot be made, and go on; all else ends the export."""
        try:
            yield
        except (Unreachable, NotAllowed):
            raise
        except (DesignError, InputError, RecordsError) as error:
            self.left_out.append(Message("{what}: {reason}", what=what, reason=error.message))

    def _add(self, name: str, write: Callable[[Path], object]) -> None:
        path = self._new_folder(str(PurePosixPath(name).parent)) / PurePosixPath(name).name
        write(path)
        self._note(path)

    def _add_json(self, name: str, content: Any) -> None:
        text = json.dumps(content, indent=1, ensure_ascii=False) + "\n"
        self._add(name, lambda path: write_private(path, text.encode()))

    def _new_folder(self, name: str) -> Path:
        folder = self._folder / name
        make_private_folder(folder)
        return folder

    def _note(self, path: Path) -> None:
        name = path.relative_to(self._folder).as_posix()
        self.files.append(ExportedFile(name, sha256_of(path), path.stat().st_size))


def _numbered(names: Sequence[str]) -> list[str]:
    """Return names of which each stands once: the second "a" is "a-2"."""
    counts: Counter[str] = Counter()
    unique = []
    for name in names:
        counts[name.casefold()] += 1
        count = counts[name.casefold()]
        stem, dot, suffix = name.partition(".")
        unique.append(name if count == 1 else f"{stem}-{count}{dot}{suffix}")
    return unique


def _with_marks(picture: bytes, marks: Sequence[PhotoMark]) -> bytes:
    """Return a JPEG with lines and places drawn on it, each with its number from 1."""
    with Image.open(io.BytesIO(picture), formats=("JPEG",)) as read:
        image = read.convert("RGB")
    drawn = ImageDraw.Draw(image)
    longest = max(image.size)
    width, font = max(round(longest * _LINE), 1), ImageFont.load_default(longest * _TEXT)
    for number, mark in enumerate(marks, start=1):
        points = [(x * image.width, y * image.height) for x, y in mark.points]
        x, y = points[0]
        if len(points) > 1:
            drawn.line(points, fill=_MARK_COLOR, width=width, joint="curve")
        else:
            drawn.circle((x, y), 3 * width, outline=_MARK_COLOR, width=width)
        place = (x + 4 * width, y)
        drawn.text(
            place, str(number), fill=_MARK_COLOR, font=font, stroke_width=1, stroke_fill="white"
        )
    return jpeg_of(image)
