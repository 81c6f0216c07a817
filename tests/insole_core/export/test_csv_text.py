import csv
import io

import pytest

from insole_core.export.csv_text import csv_text


@pytest.mark.parametrize(
    "formula",
    [
        "=cmd|' /C calc'!A0",
        " =1+1",
        "\u00a0=1+1",
        "+cmd|'/c calc'!A1",
        "-2+3+cmd|'/c calc'!A1",
        "@SUM(1)",
        "\t=1",
        "\r=1",
        "\n=1",
        "＝1+1",
    ],
)
def test_a_cell_is_never_a_formula(formula):
    text = csv_text([["a", formula, "b"]])
    ((before, cell, after),) = csv.reader(io.StringIO(text, newline=""))
    assert (before, cell, after) == ("a", f"'{formula}", "b")


@pytest.mark.parametrize(
    "hidden", ["Ek;=cmd()", "Ek,=cmd()", "Ek\t=cmd()", "Ek\n=cmd()", '";=cmd()']
)
@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
def test_no_cell_begins_within_another_whatever_the_country_puts_between_cells(hidden, delimiter):
    text = csv_text([[hidden]])
    for row in csv.reader(io.StringIO(text, newline=""), delimiter=delimiter):
        assert not any(cell.startswith("=") for cell in row)


def test_numbers_and_plain_texts_stay_as_they_are():
    rows = [["-3.250", "+46701234567", "", "Åsa Öberg"], ["12", "O'Neill", "a, b", "-"]]
    assert csv_text(rows).splitlines() == [
        "-3.250,+46701234567,,Åsa Öberg",
        "12,O'Neill,\"a, b\",'-",
    ]
