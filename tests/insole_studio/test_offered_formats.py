"""Every declared format is offered in each dialog and command that it belongs to."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QApplication

from insole_core.formats.file_formats import SCAN_SUFFIXES, SOLID_FORMATS, can_carry
from insole_core.solids.shop import read_shop
from insole_core.workflows.file_kind import kind_of
from insole_core.workflows.last_order import LastOrder
from insole_core.workflows.make_order import OrderChoice
from insole_studio.cli.main import command_parser
from insole_studio.features.export.order_form import OrderForm, Stock
from insole_studio.services.files import mesh_kinds, scan_kinds, surface_kinds

SOLIDS = [form.ending for form in SOLID_FORMATS]


@pytest.mark.parametrize("kinds", [mesh_kinds, scan_kinds, surface_kinds])
def test_a_dialog_that_opens_scans_shows_all_of_them(kinds: Callable[[], str]) -> None:
    shown = kinds().partition("(")[2].rstrip(")").split()
    assert [f"*{suffix}" for suffix in SCAN_SUFFIXES if f"*{suffix}" not in shown] == []


@pytest.mark.parametrize("suffix", SCAN_SUFFIXES)
def test_a_scan_is_known_by_its_name(suffix: str, tmp_path: Path) -> None:
    assert kind_of(tmp_path / f"foot{suffix.upper()}") == "mesh"


@pytest.mark.parametrize("command", ["design", "measure", "compare"])
def test_the_help_of_a_command_that_reads_scans_names_all(
    command: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        command_parser().parse_args([command, "--help"])
    shown = re.findall(r"\.\w+", capsys.readouterr().out)
    assert [suffix for suffix in SCAN_SUFFIXES if suffix not in shown] == []
    if command == "design":
        assert [
            suffix for suffix in SOLIDS if suffix not in shown and f"{suffix};" not in shown
        ] == []


@pytest.mark.parametrize("suffix", SOLIDS)
def test_an_order_is_made_in_every_format(suffix: str, tmp_path: Path) -> None:
    call = ["order", "create", "a.insole", "--out", "o.zip", "--format", suffix[1:]]
    assert command_parser().parse_args(call).format == suffix[1:]
    last = LastOrder(tmp_path / "last.json", read_shop())
    last.save(OrderChoice(suffix=suffix))
    assert last.load().suffix == suffix


def test_the_order_form_offers_every_format_and_its_text(qapp: QApplication) -> None:
    form = OrderForm(Stock((), ()))
    texts = {form.format.itemData(n): form.format.itemText(n) for n in range(form.format.count())}
    for each in SOLID_FORMATS:
        assert texts.pop(each.ending) == each.name
        if each.text_writer:
            assert texts.pop(f"{each.ending} text") == f"{each.name} as text"
        form.show_choice(OrderChoice(suffix=each.ending, layered=True), has_pair=False)
        assert form.choice().suffix == each.ending
        assert form.layered.isHidden() != can_carry(each.ending, "bodies")
        assert form.choice().has_layers == can_carry(each.ending, "bodies")
    assert texts == {}
    form.show_choice(OrderChoice(ascii_stl=True), has_pair=False)
    assert (form.choice().suffix, form.choice().ascii_stl) == (".stl", True)
    form.deleteLater()
