"""Photos of a visit: read safely, kept without place and camera, marked, exported, erased."""

from __future__ import annotations

import io
import json
import os
from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from insole_core.cases.case_record import FootRecord
from insole_core.errors import Conflict, InputError, RecordsError
from insole_core.records.person import Person
from insole_core.records.photo import MOST_POINTS, Photo, PhotoMark
from insole_core.records.photos import MOST_PX, photo_jpeg
from insole_core.records.records import Records
from insole_core.records.retention import ErasureReason, erase_person
from insole_core.records.row_report import verify_rows
from insole_core.records.visit import Visit
from insole_core.workflows.records.export_person import export_person

TODAY = date.today()
ORIENTATION, GPS = 0x0112, 0x8825
LINE = PhotoMark(((0.1, 0.2), (0.5, 0.6), (0.9, 0.2)), "callus")
PLACE = PhotoMark(((0.25, 0.5),), "sore, 3 weeks")


@pytest.fixture
def visit(records: Records) -> Visit:
    person = records.persons.add(Person("Anna Berg"))
    return records.visits.add(Visit(person.id, TODAY))


@pytest.fixture
def lying(tmp_path: Path) -> Path:
    """A photo that a phone has turned: upright its left half is red, and it tells where it was."""
    colors = np.zeros((60, 40, 3), np.uint8)
    colors[:30] = (220, 30, 30)
    exif = Image.Exif()
    exif[ORIENTATION] = 8  # upright when it is turned left by 90°: its top is then on the left
    exif.get_ifd(GPS).update({1: "N", 2: (55.0, 42.0, 0.0), 3: "E", 4: (13.0, 11.0, 0.0)})
    path = tmp_path / "Anna at home.jpg"
    Image.fromarray(colors).save(path, exif=exif, quality=95)
    with Image.open(path) as written:
        assert written.getexif().get_ifd(GPS)
    return path


@pytest.fixture
def photo(records: Records, visit: Visit, lying: Path) -> Photo:
    return records.photos.add(visit.id, lying)


def picture_of(records: Records, photo: Photo) -> Image.Image:
    return Image.open(io.BytesIO(records.photos.picture(photo)))


def pixels(path: Path) -> NDArray[np.int64]:
    with Image.open(path) as picture:
        return np.asarray(picture, np.int64)


def test_a_photo_is_kept_upright_and_tells_no_place(records: Records, photo: Photo) -> None:
    picture = picture_of(records, photo)
    assert picture.size == (60, 40)
    red_left, red_right = (np.asarray(picture)[20, x, 0] for x in (10, 50))
    assert red_left > 180
    assert red_right < 60
    assert not picture.getexif()
    stored = records.photos.picture(photo)
    assert b"Exif" not in stored
    assert b"GPS" not in stored
    assert records.photos.of_visit(photo.visit_id) == [photo]


def test_a_photo_is_not_larger_than_a_screen_shows(
    records: Records, visit: Visit, tmp_path: Path
) -> None:
    path = tmp_path / "large.png"
    Image.new("RGB", (5000, 1000), (200, 150, 120)).save(path)
    assert picture_of(records, records.photos.add(visit.id, path)).size == (MOST_PX, 480)


@pytest.mark.parametrize("content", [b"", b"\x89PNG\r\n\x1a\n broken", b"GIF89a"])
def test_what_is_no_picture_is_refused(
    records: Records, visit: Visit, tmp_path: Path, content: bytes
) -> None:
    path = tmp_path / "p.jpg"
    path.write_bytes(content)
    with pytest.raises(InputError, match="no readable"):
        records.photos.add(visit.id, path)
    assert records.photos.of_visit(visit.id) == []


@pytest.mark.parametrize("side_px", [9_000, 12_000, 14_000])
def test_a_photo_of_too_many_pixels_is_refused(tmp_path: Path, side_px: int) -> None:
    path = tmp_path / "bomb.png"
    Image.new("1", (side_px, side_px)).save(path)
    assert path.stat().st_size < 100_000
    with pytest.raises(InputError, match="80 million pixels; take the photo with fewer"):
        photo_jpeg(path)


def test_a_photo_whose_camera_wrote_odd_facts_is_taken(tmp_path: Path) -> None:
    path = tmp_path / "odd.jpg"
    cut_off = b"Exif\0\0II*\0\x08\0\0\0\x05\0\x12\x01"
    Image.new("RGB", (60, 40), (200, 150, 120)).save(path, exif=cut_off)
    with pytest.warns(UserWarning, match="EXIF"), Image.open(path) as picture:
        picture.getexif()
    assert Image.open(io.BytesIO(photo_jpeg(path))).size == (60, 40)


def test_marks_are_kept_and_who_marks_second_is_told(records: Records, photo: Photo) -> None:
    marked = replace(photo, caption="Left sole", marks=(LINE, PLACE))
    stored = records.photos.change(marked, photo.revision)
    assert (stored.caption, stored.marks) == ("Left sole", (LINE, PLACE))
    assert records.photos.of_visit(photo.visit_id) == [stored]
    with pytest.raises(Conflict, match="drawn on this photo"):
        records.photos.change(marked, photo.revision)
    for beside in ((1.2, 0.5), (float("nan"), 0.5)):
        with pytest.raises(InputError, match="lie on the photo"):
            records.photos.change(replace(stored, marks=(PhotoMark((beside,)),)), stored.revision)
    endless = PhotoMark(((0.5, 0.5),) * (MOST_POINTS + 1))
    with pytest.raises(InputError, match="at most 2000 points"):
        records.photos.change(replace(stored, marks=(endless,)), stored.revision)
    with records.context.database.reading() as connection:
        report = verify_rows(connection)
    assert (report.changed, report.unlogged) == ({}, {})


def test_a_visit_with_a_photo_is_kept_until_that_is_deleted(records: Records, photo: Photo) -> None:
    with pytest.raises(RecordsError, match=r"photos \(1\)"):
        records.visits.delete(photo.visit_id)
    records.photos.delete(photo)
    assert records.audit.lines()[0].action == "deleted"
    with pytest.raises(RecordsError, match="no longer in the record"):
        records.photos.delete(photo)
    with records.context.database.reading() as connection:
        report = verify_rows(connection)
    assert (report.changed, report.unlogged) == ({}, {})
    records.visits.delete(photo.visit_id)


def test_photos_go_with_the_person_though_the_device_stays(
    records: Records, photo: Photo, foot_record: FootRecord
) -> None:
    base = records.prescriptions.save(photo.visit_id, foot_record, None)
    records.orders.add(photo.visit_id, [base.version_id])
    records.photos.change(replace(photo, marks=(PLACE,)), 1)
    person_id = records.visits.get(photo.visit_id).person_id
    os.utime(records.contents.path(photo.content_sha256), (1e9, 1e9))  # of long ago
    erased = erase_person(records.context, person_id, ErasureReason.REQUEST, TODAY)
    assert erased.kept_until is not None
    assert records.photos.of_visit(photo.visit_id) == []
    with pytest.raises(RecordsError):
        records.photos.picture(photo)
    assert records.audit.verify().is_intact
    with records.context.database.reading() as connection:
        report = verify_rows(connection)
    assert (report.changed, report.unlogged) == ({}, {})


@pytest.mark.parametrize("is_pseudonymous", [False, True])
def test_photos_are_exported_with_their_marks_but_never_under_a_pseudonym(
    records: Records, photo: Photo, tmp_path: Path, is_pseudonymous: bool
) -> None:
    records.photos.change(replace(photo, caption="Left sole", marks=(LINE, PLACE)), 1)
    person_id = records.visits.get(photo.visit_id).person_id
    done = export_person(records, person_id, tmp_path / "out", is_pseudonymous=is_pseudonymous)
    photos = [name for name in done.files if "/photos/" in name]
    content = json.loads((done.folder / "person.json").read_text("utf-8"))
    summary = (done.folder / "summary.html").read_text("utf-8")
    if is_pseudonymous:
        assert photos == content["visits"][0]["photos"] == []
        assert "1 photo, which shows the patient" in str(done.left_out[0])
        assert "sore" not in summary
        return
    place = f"visits/{TODAY.isoformat()}/photos"
    assert photos == [f"{place}/1.jpg", f"{place}/1-marked.jpg"]
    (told,) = content["visits"][0]["photos"]
    assert told["marks"][1] == {"points": [[0.25, 0.5]], "text": "sore, 3 weeks"}
    assert "Left sole" in summary
    assert "2: sore, 3 weeks" in summary.replace("\n", " ")
    plain, marked = (pixels(done.folder / name) for name in photos)
    assert np.abs(plain - marked).max() > 60
