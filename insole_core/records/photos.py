"""The photos of the record."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any, Final

import cv2
from PIL import Image
from sqlalchemy import Connection, Row, delete, func, insert, select, update

from insole_core.errors import Conflict, InputError, RecordsError
from insole_core.pressure.picture import MOST_PIXELS, read_picture_file
from insole_core.records.audit import AuditLog
from insole_core.records.author import utc_now
from insole_core.records.context import RecordsContext, refer_to
from insole_core.records.photo import (
    MOST_PHOTOS,
    Photo,
    marks_from_text,
    marks_to_json,
)
from insole_core.records.rights import Right
from insole_core.records.schema import visit_photos

MOST_PX: Final = 2400
"""Greatest width and height of a stored photo."""
_QUALITY: Final = 88


class Photos:
    """Adds, changes, finds and deletes photos of visits."""

    def __init__(self, context: RecordsContext) -> None:
        self._context = context

    def add(self, visit_id: str, path: Path) -> Photo:
        """Store the picture of a file with a visit, without the place and camera that it tells.

        Raises
        ------
        InputError
            When it is no picture, or the visit has as many as it takes.
        RecordsError, OutputError
            When it cannot be stored.
        """
        picture = photo_jpeg(path)
        sha256 = self._context.contents.put(picture)
        with self._context.writing_visit(Right.WRITE, visit_id) as (connection, _):
            of_visit = visit_photos.c.visit_id == visit_id
            query = select(func.count(), func.coalesce(func.max(visit_photos.c.number), 0))
            count, last = connection.execute(query.where(of_visit)).one()
            if count >= MOST_PHOTOS:
                raise InputError(
                    "A visit takes at most {most} photos; delete one first.", most=MOST_PHOTOS
                )
            now = utc_now()
            photo = Photo(
                visit_id,
                last + 1,
                sha256,
                created_at=now,
                changed_at=now,
                author=self._context.author.name,
                revision=1,
            )
            refer_to(connection, sha256, len(picture), "photo")
            values = vars(photo) | {"marks": "[]"}
            connection.execute(insert(visit_photos).values(values))
            self._context.log(connection, "added", "photo", photo.id, visit=visit_id)
        return photo

    def of_visit(self, visit_id: str) -> list[Photo]:
        """Return the photos of a visit, the first on top."""
        query = select(visit_photos).where(visit_photos.c.visit_id == visit_id)
        with self._context.reading() as connection:
            rows = connection.execute(query.order_by(visit_photos.c.number)).all()
        return [_photo(row) for row in rows]

    def counts_of(self, visit_ids: list[str]) -> dict[str, int]:
        """Return how many photos visits have; none for those without."""
        query = select(visit_photos.c.visit_id, func.count()).group_by(visit_photos.c.visit_id)
        query = query.where(visit_photos.c.visit_id.in_(visit_ids))
        with self._context.reading() as connection:
            return {row[0]: row[1] for row in connection.execute(query)}

    def picture(self, photo: Photo) -> bytes:
        """Return the picture of a photo, a JPEG.

        Raises
        ------
        RecordsError
            When it is missing, or was changed on the disk.
        """
        return self._context.contents.read(photo.content_sha256)

    def change(self, photo: Photo, revision: int) -> Photo:
        """Store caption and marks of a photo; return it as it is stored.

        Parameters
        ----------
        revision
            Of the photo that the change is based on.

        Raises
        ------
        InputError
            When one of them cannot be right.
        Conflict
            When somebody else has changed it meanwhile.
        """
        photo = photo.checked()
        with self._context.writing_visit(Right.WRITE, photo.visit_id) as (connection, _):
            stored = _stored(connection, photo.id)
            if stored.revision != revision:
                raise Conflict(
                    photo,
                    _photo(stored),
                    "Somebody else has drawn on this photo meanwhile; look at it again.",
                )
            values: dict[str, Any] = {
                "caption": photo.caption,
                "marks": json.dumps(marks_to_json(photo.marks), ensure_ascii=False),
                "changed_at": utc_now(),
                "revision": revision + 1,
            }
            row = update(visit_photos).where(visit_photos.c.id == photo.id)
            connection.execute(row.values(values))
            self._context.log(connection, "changed", "photo", photo.id, visit=photo.visit_id)
            return _photo(_stored(connection, photo.id))

    def delete(self, photo: Photo) -> None:
        """Delete a photo with its marks, which the audit log tells.

        Raises
        ------
        NotAllowed
        RecordsError
            When it is gone already.
        """
        with self._context.writing_visit(Right.WRITE, photo.visit_id) as (connection, _):
            _stored(connection, photo.id)
            connection.execute(delete(visit_photos).where(visit_photos.c.id == photo.id))
            AuditLog.seal(connection, self._context.author, "photo", [photo.id])
            self._context.log(connection, "deleted", "photo", photo.id, visit=photo.visit_id)


def photo_jpeg(path: Path) -> bytes:
    """Return a picture of a file as it is stored: upright, not too large, and nothing but pixels.

    Raises
    ------
    InputError
        When it is no PNG, JPEG or TIFF, damaged, or far larger than cameras make them.
    """
    too_large = InputError(
        "{path} has more than {most} million pixels; take the photo with fewer, or save it "
        "smaller.",
        path=path,
        most=MOST_PIXELS // 1_000_000,
    )
    colors = read_picture_file(path, too_large).colors
    height, width = colors.shape[:2]
    shrunk = MOST_PX / max(height, width)
    if shrunk < 1.0:
        size = max(round(width * shrunk), 1), max(round(height * shrunk), 1)
        colors = cv2.resize(colors, size, interpolation=cv2.INTER_AREA)
    return jpeg_of(Image.fromarray(colors))


def jpeg_of(image: Image.Image) -> bytes:
    """Return an image as JPEG, nothing but pixels."""
    written = io.BytesIO()
    image.save(written, "JPEG", quality=_QUALITY)
    return written.getvalue()


def _stored(connection: Connection, photo_id: str) -> Row[Any]:
    query = select(visit_photos).where(visit_photos.c.id == photo_id).with_for_update()
    row = connection.execute(query).one_or_none()
    if row is None:
        raise RecordsError("This photo is no longer in the record; open the photos again.")
    return row


def _photo(row: Row[Any]) -> Photo:
    return Photo(**{**row._mapping, "marks": marks_from_text(row.marks)})
