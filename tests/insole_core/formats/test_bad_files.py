"""A damaged or hostile file of a format made of XML is refused in one clear sentence."""

from __future__ import annotations

import io
import re
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.formats.reading import read_raw
from insole_core.formats.scan_content import file_content
from insole_core.formats.solid_content import SolidPart
from insole_core.formats.writing import write_solids
from insole_core.geometry.mesh import TriangleMesh

CORNERS = np.array([[0.0, 0, 0], [10, 0, 0], [0, 20, 0], [0, 0, 30.125]])
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]], np.int32)
TETRA = TriangleMesh(CORNERS, FACES)
LAUGHS = b'<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
OUTSIDE = b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/hostname">]>'

Change = Callable[[bytes], bytes]


def amf(folder: Path) -> bytes:
    path = folder / "sound.amf"
    write_solids([SolidPart(TETRA, "left")], path)
    return path.read_bytes()


def packed(*names: str) -> Change:
    def change(content: bytes) -> bytes:
        file = io.BytesIO()
        with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
            for name in names:
                archive.writestr(name, content)
        return file.getvalue()

    return change


def bomb(_: bytes) -> bytes:
    file = io.BytesIO()
    with (
        zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive,
        archive.open("foot.amf", "w", force_zip64=True) as inner,
    ):
        for _number in range(160):
            inner.write(bytes(4_000_000))
    return file.getvalue()


def swapped(old: bytes, new: bytes) -> Change:
    return lambda content: content.replace(old, new, 1)


def behind_head(more: bytes) -> Change:
    return lambda content: content.replace(b"?>", b"?>" + more, 1)


BAD: dict[str, tuple[str, Change, str]] = {
    "AMF cut off": (".amf", lambda content: content[: len(content) // 2], "damaged or cut off"),
    "AMF that is no XML": (".amf", lambda _: b"amf", "follow the rules of the format"),
    "AMF of another unit": (".amf", swapped(b"millimeter", b"parsec"), "unit parsec is none"),
    "AMF with laughs": (".amf", behind_head(LAUGHS), "declares entities"),
    "AMF that names a file": (".amf", behind_head(OUTSIDE), "declares entities"),
    "AMF, corner beyond": (".amf", swapped(b"<v1>0<", b"<v1>9<"), "corner that it does not hold"),
    "AMF, corner below": (".amf", swapped(b"<v1>0<", b"<v1>-1<"), "corner that it does not hold"),
    "AMF, huge corner": (".amf", swapped(b"<v1>0<", b"<v1>1e30<"), "follow the rules"),
    "AMF, word for a number": (".amf", swapped(b"<x>0.0", b"<x>one"), "follow the rules"),
    "AMF, corner is no number": (".amf", swapped(b"<v1>0<", b"<v1>nan<"), "follow the rules"),
    "AMF without a coordinate": (".amf", swapped(b"<x>0.00000</x>", b""), "lacks 'x'"),
    "AMF without objects": (".amf", lambda _: b"<amf></amf>", "holds no object"),
    "AMF, archive of two": (".amf", packed("a.amf", "b.amf"), "no model, or several"),
    "AMF, archive without one": (".amf", packed("a.txt"), "no model, or several"),
    "AMF bomb": (".amf", bomb, "larger than 572 MB"),
    "STL in the name of an AMF": (".amf", lambda _: b"solid x\n", "something else than its name"),
}
SOUND = {".amf": amf}


@pytest.mark.parametrize("what", BAD)
def test_a_bad_file_is_one_sentence(what: str, tmp_path: Path) -> None:
    suffix, change, words = BAD[what]
    path = tmp_path / f"foot{suffix}"
    path.write_bytes(change(SOUND[suffix](tmp_path)))
    with pytest.raises(InputError, match=re.escape(words)) as refused:
        read_raw(file_content(path))
    assert "\n" not in str(refused.value)


def test_an_amf_in_an_archive_is_moved_to_where_its_constellation_says(tmp_path: Path) -> None:
    place = b"""<constellation id="9"><instance objectid="2"><deltax>5</deltax><rz> 90 </rz>
        </instance></constellation></amf>"""
    content = amf(tmp_path).replace(b"</amf>", place).replace(b"millimeter", b"inch")
    path = tmp_path / "foot.amf"
    path.write_bytes(packed("foot.amf")(content))
    raw = read_raw(file_content(path))
    assert raw.unit == "inch"
    assert raw.vertices == pytest.approx(CORNERS @ [[0, 1, 0], [-1, 0, 0], [0, 0, 1]] + [5, 0, 0])


def test_bodies_of_one_assembly_are_one_object_of_an_amf(tmp_path: Path) -> None:
    layers = [SolidPart(TETRA, name, assembly="left") for name in ("cover", "base")]
    path = tmp_path / "layers.amf"
    write_solids([*layers, SolidPart(TETRA, "Fuß & <wedge>")], path, label="P-17")
    text = path.read_text(encoding="utf-8")
    assert text.count("<object ") == 2
    assert text.count("<volume ") == 3
    assert "Insole P-17" in text
    assert "Fuß &amp; &lt;wedge&gt;" in text
    assert len(read_raw(file_content(path)).triangles) == 3 * len(FACES)
