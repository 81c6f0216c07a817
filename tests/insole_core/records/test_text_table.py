"""Tables of other programs: encodings, delimiters, quotation marks, and what is refused."""

from __future__ import annotations

import tempfile
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from insole_core.errors import InputError
from insole_core.records.text_table import MOST_COLUMNS, UnclearCharacterSet, read_table

_TEXT = "Namn;Född\nÅsa Öberg;1970-02-28\nЛев Толстой;1928-09-09\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_every_encoding_of_a_clinic_gives_the_same_names(tmp_path, encoding):
    table = _read(tmp_path, _TEXT.encode(encoding))
    assert table.column(0) == ["Åsa Öberg", "Лев Толстой"]
    assert table.headings == ("Namn", "Född")


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "cp1252"])
def test_encodings_without_a_mark_are_found(tmp_path, encoding):
    table = _read(tmp_path, "Namn;Född;Ort\nÅsa Öberg;1970-02-28;Malmö\n".encode(encoding))
    assert (table.encoding, table.rows[0].cells[0]) == (encoding, "Åsa Öberg")


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be"])
def test_cyrillic_without_a_mark_is_found(tmp_path, encoding):
    table = _read(tmp_path, "Имя;Родился\nЛев Толстой;неизвестно\n".encode(encoding))
    assert (table.encoding, table.rows[0].cells[0]) == (encoding, "Лев Толстой")


@pytest.mark.parametrize(
    ("encoding", "name", "is_certain"),
    [
        ("cp1252", "Håkan Öberg", True),
        ("cp1252", "Sørensen Kjær Åse", True),
        ("cp1252", "Jäger Groß Müller O’Neill", True),
        ("cp1251", "Пётр Иванов", True),
        ("koi8-r", "Пётр Иванов", True),
        ("iso8859-5", "Иванов", True),
        ("cp850", "Håkan Öberg", True),
        ("iso8859-9", "Ayşe Yıldız", False),
        ("cp1254", "Çağrı Şahin", False),
        ("cp1252", "Þórður Ýrr", False),
        ("cp1250", "Łukasz Wiśniewski", False),
        ("cp1250", "Antonín Dvořák", False),
        ("iso8859-2", "Tomáš", False),
        ("cp1250", "Erdős Pál", False),
        ("cp1257", "Šarūnas Žemaitė", False),
        ("cp1253", "Παπαδόπουλος", False),
        ("mac-roman", "Håkan Öberg", False),
    ],
)
def test_a_name_is_read_as_it_was_written_or_asked_for(tmp_path, encoding, name, is_certain):
    content = f"Name;Born\n{name};1970-02-28\n".encode(encoding)
    if is_certain:
        assert _read(tmp_path, content).column(0) == [name]
        return
    with pytest.raises(UnclearCharacterSet, match="does not tell its character set") as raised:
        _read(tmp_path, content)
    assert any(example in name for one in raised.value.readings for example in one.examples)
    path = tmp_path / "table.csv"
    path.write_bytes(content)
    tables = [read_table(path, reading.encoding) for reading in raised.value.readings]
    assert [name] in [table.column(0) for table in tables]


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
def test_the_delimiter_is_found_beside_others_in_the_texts(tmp_path, delimiter):
    quoted = f'"Berg{delimiter} Anna, jr; x"'
    rows = [["Name", "Born"], [quoted, "1970-02-28"], ["Per", "1980-01-01"]]
    text = "\r\n".join(delimiter.join(row) for row in rows)
    table = _read(tmp_path, text.encode())
    assert table.delimiter == delimiter
    assert table.rows[0].cells == (quoted.strip('"'), "1970-02-28")


def test_excel_may_state_the_delimiter(tmp_path):
    table = _read(tmp_path, b"sep=|\r\nName|Note\r\nAnna|a;b;c\r\n")
    assert table.headings == ("Name", "Note")
    assert [row.line for row in table.rows] == [3]


def test_a_text_of_several_lines_keeps_them_and_the_lines_are_counted(tmp_path):
    table = _read(tmp_path, b'Name,Notes\nAnna,"one\ntwo ""quoted"""\n\nPer,three\n')
    assert table.rows[0].cells == ("Anna", 'one\ntwo "quoted"')
    assert [row.line for row in table.rows] == [2, 5]


def test_three_hundred_columns_are_read(tmp_path):
    rows = [";".join(f"c{n}" for n in range(300)), ";".join(str(n) for n in range(300))]
    table = _read(tmp_path, "\n".join(rows).encode("utf-16"))
    assert len(table.headings) == 300
    assert table.rows[0].cells[299] == "299"


def test_a_short_row_is_filled_and_a_long_one_keeps_what_is_beyond(tmp_path):
    table = _read(tmp_path, b"a,b,c\n1,2,3\n1\n1,2,3,,\n1,2,3,x\n")
    assert [len(row.cells) for row in table.rows] == [3, 3, 3, 4]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "is empty"),
        (b"\n \n\t\n", "is empty"),
        (b'Name,Born\n"Anna,1970\nPer,1980\n', "quotation mark"),
        (b"Name,Born\nAnna \x81\x8d,1970\n", "character set"),
        (b"\xff\xfeN\x00a", "character set"),
        (b"PK\x03\x04" + bytes(range(256)), "no table|character set"),
        (b"Name\nA\0nna\n", "no table"),
        (",".join("x" * (MOST_COLUMNS + 2)).encode(), "columns"),
        (b"Name,Note\nAnna," + b"x" * 200_000, "too long"),
    ],
)
def test_what_is_no_table_is_refused_in_a_sentence(tmp_path, content, words):
    with pytest.raises(InputError, match=words):
        _read(tmp_path, content)


def test_what_is_no_file_is_refused(tmp_path):
    with pytest.raises(InputError, match="cannot be read"):
        read_table(tmp_path / "none.csv")
    with pytest.raises(InputError, match="cannot be read"):
        read_table(tmp_path)


@given(st.binary(max_size=300) | st.text(max_size=200).map(str.encode))
def test_any_content_is_a_table_or_refused_in_words(content):
    with tempfile.TemporaryDirectory() as folder, suppress(InputError):
        table = _read(Path(folder), content)
        assert all(len(row.cells) >= len(table.headings) for row in table.rows)


def _read(folder: Path, content: bytes):
    path = folder / "table.csv"
    path.write_bytes(content)
    return read_table(path)
