"""Files of the record without any text that a user or another program has put into them."""

from __future__ import annotations

import zipfile
from collections.abc import Set
from dataclasses import dataclass, replace
from pathlib import Path, PurePath

from insole_core.cases.name_words import holds_any
from insole_core.errors import InputError
from insole_core.files.atomic import scratch_folder
from insole_core.formats.ply import write_ply
from insole_core.formats.reading import read_raw
from insole_core.geometry.mesh import TriangleMesh
from insole_core.recording.reader import read_session
from insole_core.recording.writer import MANIFEST, write_session
from insole_core.records.content_store import ContentStore, DamagedContent
from insole_core.records.context import put_file
from insole_core.scans.scan_folder import part_content, scan_parts
from insole_core.zip_archive import ZipArchive


@dataclass(frozen=True)
class BareFile:
    """A stored file that holds no text of its own.

    Parameters
    ----------
    suffix
        That its content has.
    """

    sha256: str
    size: int
    suffix: str


class BareFiles:
    """Stores scans and sessions once more, without their texts.

    A scan stays as points, triangles and colours, a session as what its sensors have measured.
    Nothing else can be told apart from its texts, and nothing stays of it. Each is made once.
    """

    def __init__(self, store: ContentStore) -> None:
        self._store = store
        self._made: dict[tuple[str, str], BareFile | None] = {}

    def of(self, sha256: str, suffix: str, words: Set[str]) -> BareFile | None:
        """Return a file without its texts; None where nothing can stay of it.

        Parameters
        ----------
        suffix
            That says what it is, in small letters.
        words
            Of the patient's name, folded: a session that holds one after all does not stay.

        Raises
        ------
        Unreachable, OutputError
            As for `ContentStore.put`.
        """
        key = sha256, suffix
        if key not in self._made:
            try:
                self._made[key] = self._make(sha256, suffix, words)
            except (InputError, DamagedContent):
                self._made[key] = None
        return self._made[key]

    def nothing(self) -> BareFile:
        """Return the empty file."""
        return BareFile(self._store.put(b""), 0, "")

    def _make(self, sha256: str, suffix: str, words: Set[str]) -> BareFile | None:
        self._store.identity()  # makes its folder
        with scratch_folder(self._store.folder / "bare.zip") as parts:
            given = parts / f"given{suffix}"
            self._store.copy_to(sha256, given)
            bare = _bare_session(given, parts) if _is_session(given) else _bare_scan(given, parts)
            if _holds_name(bare, words):
                return None
            return BareFile(*put_file(self._store, bare), bare.suffix)


def _holds_name(bare: Path, words: Set[str]) -> bool:
    """Return whether a serial number or a like text of a session holds the name."""
    if bare.suffix != ".zip":
        return False
    with zipfile.ZipFile(bare) as archive:
        texts = [archive.read(n).decode() for n in archive.namelist() if n.endswith(".json")]
    return any(holds_any(text, words) for text in texts)


def _is_session(path: Path) -> bool:
    if path.suffix != ".zip":
        return False
    names = ZipArchive(path.name, path).names
    return any(PurePath(name).name == MANIFEST for name in names)


def _bare_session(given: Path, folder: Path) -> Path:
    session = read_session(given)
    condition = session.manifest.capture_condition
    if condition is not None:
        condition = replace(condition, notes="")
    manifest = replace(session.manifest, capture_condition=condition, extra={})
    bare = folder / "bare.zip"
    write_session(replace(session, manifest=manifest), bare)
    return bare


def _bare_scan(given: Path, folder: Path) -> Path:
    """Write the points, triangles and colours of a scan, in the unit and the frame of its file."""
    bares = []
    for number, part in enumerate(scan_parts(given), 1):
        raw = read_raw(part_content(part))
        bares.append(folder / f"{part.side or number}.ply")
        write_ply(TriangleMesh(raw.vertices, raw.triangles, raw.colors, raw.touches), bares[-1])
    if len(bares) == 1:
        return bares[0]
    archive = folder / "bare.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for bare in bares:
            packed.write(bare, bare.name)
    return archive
