"""Orders in the window: revised, listed, searched, cancelled, printed; terms that stay."""

from __future__ import annotations

import os
import zipfile
from collections.abc import Callable
from dataclasses import replace
from datetime import date, timedelta
from pathlib import Path
from threading import Event
from typing import Any

import manifold3d
import pytest
from canned_questions import CannedQuestions
from pointing import click_heading
from PySide6.QtCore import QModelIndex, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot
from sqlalchemy import insert

from insole_core.cases.order_note import OrderNote
from insole_core.errors import OutputError, Unreachable
from insole_core.export.shop_order import OrderTerms
from insole_core.formats.solid_content import SolidPart, write_solids
from insole_core.geometry.side import Side
from insole_core.records import schema
from insole_core.records.order import Order, OrderState
from insole_core.records.orders import Orders
from insole_core.records.records import Records
from insole_core.records.visit import Visit
from insole_core.solids.simplification import from_manifold
from insole_core.workflows.order_package import Ordered
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.features.records.nest_actions import NESTING
from insole_studio.features.records.nest_dialog import NestDialog
from insole_studio.features.records.order_files import OrderFiles
from insole_studio.features.records.orders_page import ALL, OPEN, OrdersPage

LEFT = Qt.MouseButton.LeftButton
TODAY = date.today()
YESTERDAY, SOON = TODAY - timedelta(days=1), TODAY + timedelta(days=9)


@pytest.fixture
def order(records: Records, visit: Visit) -> Order:
    """An order of Anna Berg that is late."""
    version = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    return records.orders.add(visit.id, [version.id], shop="CNC Nord", due_on=YESTERDAY)


@pytest.fixture
def page(clinic: Application, order: Order, rest: Callable[[], None]) -> OrdersPage:
    """The orders of the clinic."""
    clinic.controller.run_action("orders", False)
    rest()
    shown = clinic.features.records.orders
    assert shown is not None
    return shown


@pytest.fixture
def printed(clinic: Application, monkeypatch: pytest.MonkeyPatch) -> list[Path]:
    """What was opened in other programs."""
    paths: list[Path] = []

    def note(path: Path) -> bool:
        paths.append(path)
        return True

    monkeypatch.setattr(clinic.features.records.order_files, "_open", note)
    return paths


def choose(page: OrdersPage, word: str) -> None:
    """Choose which orders are shown, with the keyboard."""
    page.shown.setFocus()
    page.shown.show_value(word)
    page.shown.activated.emit(page.shown.currentIndex())


def keys(page: OrdersPage) -> list[str]:
    return [row.key for row in page.table.rows]


def test_orders_are_listed_moved_and_cancelled_and_nothing_vanishes(
    page: OrdersPage, clinic: Application, records: Records, order: Order, rest: Callable[[], None]
) -> None:
    (row,) = page.table.rows
    assert row.attention
    assert row.cells == (
        "Anna Berg", order.number, "1", "Designed", f"{YESTERDAY.isoformat()}, overdue", "CNC Nord",
        TODAY.isoformat(),
    )  # fmt: skip
    assert not page.move_button.isEnabled()
    page.table.take_first()
    page.to_state.show_value(OrderState.DELIVERED.value)
    QTest.mouseClick(page.move_button, LEFT)
    rest()
    assert keys(page) == []
    for word in (ALL, OrderState.DELIVERED.value):
        choose(page, word)
        rest()
        assert keys(page) == [order.id]
    page.table.take_first()
    QTest.mouseClick(page.cancel_button, LEFT)
    rest()
    assert keys(page) == []
    choose(page, OrderState.CANCELLED.value)
    rest()
    assert page.table.rows[0].cells[3] == "Cancelled"
    clinic.services.notices.take("record-order")  # Undo
    rest()
    assert records.orders.get(order.id).state is OrderState.DELIVERED
    choose(page, OPEN)
    rest()
    assert keys(page) == []


def test_a_thousand_orders_are_searched_sorted_and_loaded_as_one_scrolls(
    page: OrdersPage, records: Records, visit: Visit, order: Order, rest: Callable[[], None]
) -> None:
    with records.context.database.writing() as connection:
        connection.execute(insert(schema.orders), [
            {"id": f"o{n}", "number": f"26-X{n:05}", "visit_id": visit.id,
             "person_id": visit.person_id, "state": "delivered", "shop": f"Shop {n % 7}",
             "created_at": f"{YESTERDAY.isoformat()}T{n:05}", "changed_at": "2026", "revision": 1}
            for n in range(1000)
        ])  # fmt: skip
    choose(page, ALL)
    rest()
    assert len(page.table.rows) == 200
    assert "200" in page._count.text()
    assert "1001" in page._count.text()
    bar = page.table.verticalScrollBar()
    bar.setValue(bar.maximum())
    rest()
    assert len(page.table.rows) == 400
    assert bar.value() > 0
    click_heading(page.table, 1)
    rest()
    assert page.table.rows[0].cells[1] == min(f"26-X{0:05}", order.number)
    click_heading(page.table, 1)
    rest()
    assert page.table.rows[0].cells[1] == max(f"26-X{999:05}", order.number)
    page.search.setFocus()
    QTest.keyClicks(page.search, "x00712")
    rest()
    assert [row.cells[1] for row in page.table.rows] == ["26-X00712"]


def test_papers_are_printed_again_and_the_folder_is_opened(
    page: OrdersPage, clinic: Application, records: Records, order: Order, printed: list[Path],
    questions: CannedQuestions, rest: Callable[[], None], tmp_path: Path,
) -> None:  # fmt: skip
    page.table.take_first()
    QTest.mouseClick(page.papers_button, LEFT)
    rest()
    assert printed == []
    written = tmp_path / "26-1"
    written.mkdir()
    (written / "p-left.stl").write_bytes(b"solid")
    (written / "p-left-job-sheet.pdf").write_bytes(b"%PDF 2")
    with zipfile.ZipFile(written / "order.zip", "w") as packed:
        packed.writestr("packed-job-sheet.pdf", b"%PDF packed")
    order = records.orders.revise(
        order.id,
        order.version_ids,
        order.revision,
        release=2,
        files=sorted(written.iterdir()),
        place=str(written),
    )
    rest()
    page.table.take_first()
    QTest.mouseClick(page.papers_button, LEFT)
    rest()
    assert sorted(path.read_bytes() for path in printed) == [b"%PDF 2", b"%PDF packed"]
    copies = printed.copy()
    printed.clear()
    QTest.mouseClick(page.folder_button, LEFT)
    rest()
    assert printed == [written]
    printed.clear()
    written.rename(tmp_path / "elsewhere")
    questions.path = tmp_path
    QTest.mouseClick(page.folder_button, LEFT)
    rest()
    assert printed == [tmp_path / order.number]
    assert (printed[0] / "p-left.stl").read_bytes() == b"solid"
    papers = clinic.services.paths.papers_folder
    for left in (papers / "left", papers / "printing"):  # by other windows
        left.mkdir()
    os.utime(papers / "left", (0, 0))
    OrderFiles.close(clinic.features.records.order_files)
    assert not any(path.exists() for path in copies)
    OrderFiles(clinic.services)
    assert [path.name for path in papers.iterdir()] == ["printing"]


def test_papers_that_no_program_shows_are_told_of_in_one_sentence(
    page: OrdersPage, clinic: Application, records: Records, order: Order,
    rest: Callable[[], None], tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    monkeypatch.setattr(clinic.features.records.order_files, "_open", lambda _path: False)
    names = "p-left-job-sheet.pdf", "p-left-prescription.pdf"
    for name in names:
        (tmp_path / name).write_bytes(b"%PDF")
    written = [tmp_path / name for name in names]
    records.orders.revise(
        order.id, order.version_ids, order.revision, release=2, files=written, place=str(tmp_path)
    )
    rest()
    page.table.take_first()
    QTest.mouseClick(page.papers_button, LEFT)
    rest()
    (told,) = clinic.services.messages.dialogs
    assert all(name in told.text() for name in names)
    assert str(clinic.services.paths.papers_folder) in told.text()


def test_a_visit_that_is_exported_again_is_one_order_with_two_revisions(
    records: Records, visit: Visit, opened: Application, rest: Callable[[], None], tmp_path: Path,
    qtbot: QtBot,
) -> None:  # fmt: skip
    opened.features.export.open()
    stage = opened.features.export.stage
    assert stage is not None

    def settle() -> None:
        qtbot.waitUntil(lambda: not stage.jobs.is_running())
        rest()

    settle()
    QTest.keyClicks(stage.view.form.terms.colour, "black")
    stage.view.form.relief.show_value("engraved")
    stage.view.form.numbered.click()
    settle()
    for _ in range(2):
        stage.presenter.export_to(tmp_path / "p.stl")
        settle()
    (listed,) = records.orders.of_person(visit.person_id)
    order = records.orders.get(listed.id)
    assert (order.release, order.place) == (2, str(tmp_path))
    (part,) = stage.presenter.parts
    assert part.order.mark[-1].endswith("-3-L"), "made again for the revision that would be next"
    assert [(f.release, f.name) for f in order.files] == [
        (2, "p-left-job-sheet.pdf"), (2, "p-left.stl"),
        (1, "p-left-job-sheet.pdf"), (1, "p-left.stl"),
    ]  # fmt: skip
    assert records.visits.get(visit.id).terms == OrderTerms(colour="black")
    records.orders.move(order.id, OrderState.CANCELLED, "", order.revision)  # at another station
    field = stage.view.form.order
    qtbot.waitUntil(lambda: field.count() == 1)
    stage.presenter.export_to(tmp_path / "p.stl")
    settle()
    assert len(records.orders.of_person(visit.person_id)) == 2
    assert stage.view.form.terms.colour.text() == "black"


def test_an_order_is_revised_from_the_page(
    page: OrdersPage, clinic: Application, records: Records, order: Order, rest: Callable[[], None]
) -> None:
    """Its visit opens, with the window that exports the next revision of it."""
    page.table.clearSelection()
    page.table.setCurrentIndex(QModelIndex())
    assert not page.revise_button.isEnabled()
    assert page.revise_button.toolTip() == "Choose an order in the list first."
    page.table.take_first()
    assert page.revise_button.toolTip().startswith("Open its visit")
    QTest.mouseClick(page.revise_button, LEFT)
    rest()
    stage = clinic.features.export.stage
    assert stage is not None
    assert f"{order.number}, revision 2" in stage.view.form.order.currentText()
    stage.close()
    records.orders.move(order.id, OrderState.CANCELLED, "", order.revision)
    clinic.controller.run_action("orders", False)
    rest()
    choose(page, ALL)
    rest()
    page.table.take_first()
    QTest.mouseClick(page.revise_button, LEFT)
    rest()
    assert clinic.features.export.stage is None
    (told,) = clinic.services.messages.dialogs
    assert "gets no revision" in told.text()


def test_a_revision_keeps_what_was_agreed_with_the_shop_meanwhile(
    clinic: Application, records: Records, visit: Visit, order: Order, rest: Callable[[], None],
    qtbot: QtBot, tmp_path: Path,
) -> None:  # fmt: skip
    terms = OrderTerms(remarks="soft heel", deliver_on=SOON)
    records.visits.change(replace(visit, terms=terms), visit.revision)
    later = SOON + timedelta(days=5)
    typed = {"shop": "CNC", "due_on": later, "remarks": "soft heel\ncall on Monday"}
    records.orders.change(order.id, typed, order.revision)
    clinic.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    rest()
    solid = tmp_path / "p-left.stl"
    solid.write_bytes(b"solid")

    def export(terms: OrderTerms, revision: int) -> Order:
        ordered = Ordered((solid,), terms, order.number, revision)
        clinic.features.export.exported_files.emit(clinic.case.record, ordered, visit.id)
        qtbot.waitUntil(lambda: records.orders.get(order.id).release == revision)
        return records.orders.get(order.id)

    revised = export(terms, 2)
    assert (revised.due_on, revised.remarks) == (later, "soft heel\ncall on Monday")
    sooner = SOON + timedelta(days=1)
    revised = export(OrderTerms(remarks="hard heel", deliver_on=sooner), 3)
    assert (revised.due_on, revised.remarks) == (sooner, "hard heel\ncall on Monday")


def test_a_revision_exported_while_the_record_is_away_is_stored_when_it_is_back(
    records: Records, visit: Visit, order: Order, opened: Application, rest: Callable[[], None],
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    solid = tmp_path / "p-left.stl"
    solid.write_bytes(b"solid")

    def fail(*_given: object, **_named: object) -> Order:
        raise Unreachable("The database does not answer.")

    states: list[RecordState] = []  # for reading answers, so that it is soon back
    record = opened.services.clinic
    record.state_changed.connect(lambda: states.append(record.state))
    with monkeypatch.context() as away:
        away.setattr(Orders, "revise", fail)
        opened.case.note_order(OrderNote(order.number, 2))
        ordered = Ordered((solid,), OrderTerms(), order.number, 2)
        opened.features.export.exported_files.emit(opened.case.record, ordered, visit.id)
        qtbot.waitUntil(lambda: bool(opened.services.messages.dialogs))
        assert states[0] is RecordState.AWAY
    called = {"shop": "CNC", "due_on": SOON, "remarks": "call"}
    records.orders.change(order.id, called, order.revision)  # at another station
    qtbot.waitUntil(lambda: records.orders.get(order.id).release == 2)
    rest()
    assert opened.case.record.order.revision == 2


@pytest.mark.parametrize("name", ["add", "revise"])
def test_an_order_whose_answer_was_lost_is_not_stored_twice(
    records: Records, visit: Visit, order: Order, opened: Application, rest: Callable[[], None],
    qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str,
) -> None:  # fmt: skip
    solid = tmp_path / "p-left.stl"
    solid.write_bytes(b"solid")
    store = getattr(Orders, name)

    def store_and_fail(*given: object, **named: object) -> Order:
        store(*given, **named)
        raise Unreachable("The database does not answer.")

    number, revision = ("26-7", 1) if name == "add" else (order.number, 2)
    with monkeypatch.context() as away:
        away.setattr(Orders, name, store_and_fail)
        ordered = Ordered((solid,), OrderTerms(), number, revision)
        opened.features.export.exported_files.emit(opened.case.record, ordered, visit.id)
        qtbot.waitUntil(lambda: bool(opened.services.messages.dialogs))
    waiting = opened.services.paths.waiting_orders_folder
    qtbot.waitUntil(lambda: not list(waiting.rglob("*.json")))
    rest()
    assert len(opened.services.messages.dialogs) == 1
    (stored,) = (o for o in records.orders.of_person(visit.person_id) if o.number == number)
    assert records.orders.get(stored.id).release == revision


def test_a_stored_order_does_not_take_back_a_revision_that_is_out(clinic: Application) -> None:
    clinic.case.note_order(OrderNote("26-7KQ4M", 2))
    clinic.case.note_stored_order(OrderNote("26-7KQ4M", 1))
    assert clinic.case.record.order.revised().revision == 3
    clinic.case.note_stored_order(OrderNote())
    assert clinic.case.record.order.number == ""


def test_a_revision_that_somebody_else_has_written_is_told(
    records: Records, visit: Visit, order: Order, opened: Application, rest: Callable[[], None],
    qtbot: QtBot, tmp_path: Path,
) -> None:  # fmt: skip
    records.orders.revise(order.id, order.version_ids, order.revision, release=2)
    solid = tmp_path / "p-left.stl"
    solid.write_bytes(b"solid")
    ordered = Ordered((solid,), OrderTerms(), order.number, 2)
    opened.features.export.exported_files.emit(opened.case.record, ordered, visit.id)
    qtbot.waitUntil(lambda: bool(opened.services.messages.dialogs))
    (dialog,) = opened.services.messages.dialogs
    assert "has a revision 2 already" in dialog.text()


def test_an_order_that_is_written_after_its_visit_was_left_is_in_the_record(
    records: Records, visit: Visit, opened: Application, rest: Callable[[], None], tmp_path: Path,
    qtbot: QtBot,
) -> None:  # fmt: skip
    opened.features.export.open()
    stage = opened.features.export.stage
    assert stage is not None
    qtbot.waitUntil(lambda: not stage.jobs.is_running())
    stage.presenter.export_to(tmp_path / "p.stl")
    opened.controller.run_action("new_case", False)
    assert opened.case.kept is None
    qtbot.waitUntil(lambda: bool(records.orders.of_person(visit.person_id)))
    rest()
    (order,) = records.orders.of_person(visit.person_id)
    assert {file.name for file in records.orders.get(order.id).files} == {
        "p-left.stl", "p-left-job-sheet.pdf",
    }  # fmt: skip


def box_file(path: Path, length_mm: float) -> Path:
    """Write a solid that is longer than wide."""
    box = from_manifold(manifold3d.Manifold.cube([80.0, length_mm, 12.0]))
    write_solids([SolidPart(box, "box")], path)
    return path


def test_a_nest_that_found_no_room_is_asked_about_again_as_it_was(
    page: OrdersPage, clinic: Application, records: Records, visit: Visit,
    questions: CannedQuestions, tmp_path: Path, rest: Callable[[], None],
) -> None:  # fmt: skip
    version = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    file = box_file(tmp_path / "26-A-left.stl", 240.0)
    records.orders.add(visit.id, [version.id], number="26-A", files=[file])
    clinic.services.clinic.changed.emit()
    rest()

    def opened() -> NestDialog:
        QTest.mouseClick(page.nest_button, LEFT)
        dialog = clinic.features.records.nest_actions.dialog
        assert dialog is not None
        return dialog

    dialog = opened()
    dialog.block.show_value("")
    dialog.block.edited.emit("")
    for field, side in zip(dialog.sides, (200, 150, 20), strict=True):
        field.setValue(side)
    dialog.gap.setValue(7)
    dialog.margin.setValue(9)
    dialog.machine.setCurrentText("LinuxCNC")
    dialog.both_sides.setChecked(False)
    dialog.marked.setChecked(True)
    chosen = dialog.choice
    assert chosen.milling is not None
    questions.path = tmp_path / "day.3mf"
    QTest.mouseClick(dialog.nest, LEFT)
    rest()
    told = clinic.services.messages.dialogs[-1].text()
    assert told.startswith("The piece finds no room on ")
    dialog = opened()
    assert dialog.choice == chosen
    dialog.sides[0].setValue(600)
    dialog.machine.setCurrentText("No router")
    QTest.mouseClick(dialog.nest, LEFT)
    rest()
    said = " ".join(notice.text for notice in clinic.services.notices.notices)
    assert "One piece is nested in day.3mf." in said
    dialog = opened()
    assert dialog.choice.milling is None
    dialog.block.setCurrentIndex(0)
    dialog.block.edited.emit(dialog.block.currentData())
    questions.path = None
    QTest.mouseClick(dialog.nest, LEFT)
    assert opened().choice.block.size_mm == (600, 150, 20), "what was not nested is not kept"


def test_orders_of_the_page_are_nested_on_a_sheet(
    page: OrdersPage, clinic: Application, records: Records, visit: Visit, order: Order,
    questions: CannedQuestions, tmp_path: Path, rest: Callable[[], None],
    monkeypatch: pytest.MonkeyPatch, qtbot: QtBot,
) -> None:  # fmt: skip
    """Those that are ticked, in the size that is typed; nobody is named in the files."""
    version = records.prescriptions.versions(visit.id, Side.LEFT)[0]
    written = [
        records.orders.add(
            visit.id, [version.id], number=number,
            files=[box_file(tmp_path / f"{number}-{side}.stl", length) for side in Side],
        )
        for number, length in (("26-A", 240.0), ("26-B", 250.0))
    ]  # fmt: skip
    clinic.services.clinic.changed.emit()
    rest()
    QTest.mouseClick(page.nest_button, LEFT)
    dialog = clinic.features.records.nest_actions.dialog
    assert dialog is not None
    texts = [dialog.orders.item(row).text() for row in range(dialog.orders.count())]
    assert len(texts) == 3
    assert all("Anna Berg" in text for text in texts)
    dialog.block.show_value("")
    dialog.block.edited.emit("")
    for field, side in zip(dialog.sides, (600, 300, 20), strict=True):
        field.setValue(side)
    questions.path = tmp_path / "day.3mf"
    QTest.mouseClick(dialog.nest, LEFT)
    rest()
    said = " ".join(notice.text for notice in clinic.services.notices.notices)
    assert f"Order {order.number} has no solids and does not lie here" in said
    assert {path.name for path in tmp_path.glob("day*")} == {
        "day.3mf", "day.dxf", "day-pieces.pdf"
    }  # fmt: skip
    with zipfile.ZipFile(tmp_path / "day.3mf") as archive:
        model = archive.read("3D/3dmodel.model").decode()
    assert all(f"{number} {side}" in model for number in ("26-A", "26-B") for side in Side)
    assert "Berg" not in model + (tmp_path / "day.dxf").read_text()
    assert [records.orders.get(each.id).state for each in written] == 2 * [OrderState.DESIGNED]
    papers = clinic.services.paths.papers_folder
    assert not [*papers.iterdir()]
    QTest.mouseClick(page.nest_button, LEFT)
    dialog = clinic.features.records.nest_actions.dialog
    assert dialog is not None
    questions.path = tmp_path / "never.3mf"
    QTest.mouseClick(dialog.nest, LEFT)
    qtbot.waitUntil(lambda: clinic.services.jobs.is_running(NESTING))
    clinic.services.jobs.cancel(NESTING)
    rest()
    assert not [*papers.iterdir()]
    assert not [*tmp_path.glob("never*")]
    copied, go_on, copy_files = Event(), Event(), Orders.copy_files

    def note(*arguments: Any) -> tuple[Path, ...]:
        files = copy_files(*arguments)
        copied.set()
        assert go_on.wait(60)
        return files

    def start(name: str) -> None:
        QTest.mouseClick(page.nest_button, LEFT)
        dialog = clinic.features.records.nest_actions.dialog
        assert dialog is not None
        for row, text in enumerate(texts):
            ticked = Qt.CheckState.Checked if "26-A" in text else Qt.CheckState.Unchecked
            dialog.orders.item(row).setCheckState(ticked)
        dialog.block.show_value("")
        dialog.block.edited.emit("")
        for field, side in zip(dialog.sides, (600, 300, 20), strict=True):
            field.setValue(side)
        questions.path = tmp_path / name
        QTest.mouseClick(dialog.nest, LEFT)

    start("first.3mf")
    qtbot.waitUntil(lambda: clinic.services.jobs.is_running(NESTING))
    monkeypatch.setattr(Orders, "copy_files", note)
    start("second.3mf")
    assert copied.wait(60)
    clinic.services.jobs.cancel(NESTING)  # the first, while the second is copied
    QApplication.processEvents()
    go_on.set()
    rest()
    assert {path.name for path in tmp_path.glob("second*")} == {
        "second.3mf", "second.dxf", "second-pieces.pdf"
    }  # fmt: skip
    assert not [*papers.iterdir()]

    def fail(*arguments: Any) -> tuple[Path, ...]:
        copy_files(*arguments)
        raise OutputError("The disk is full; make room.")

    monkeypatch.setattr(Orders, "copy_files", fail)
    start("third.3mf")
    rest()
    assert "The disk is full" in clinic.services.messages.dialogs[-1].text()
    assert not [*papers.iterdir()]
    monkeypatch.undo()
    QTest.mouseClick(page.nest_button, LEFT)
    dialog = clinic.features.records.nest_actions.dialog
    assert dialog is not None
    dialog.machine.setCurrentText("LinuxCNC")
    (tmp_path / "friday-2.nc").write_text("(friday)\n")
    (tmp_path / "friday.3mf").touch()
    questions.replace = False
    questions.path = tmp_path / "friday.3mf"
    QTest.mouseClick(dialog.nest, LEFT)
    told = clinic.services.messages.dialogs[-1].text()
    assert "earlier program (friday-2.nc) would lie beside friday.nc" in told
    QTest.mouseClick(page.nest_button, LEFT)
    dialog = clinic.features.records.nest_actions.dialog
    assert dialog is not None
    assert dialog.machine.currentText() == "LinuxCNC"
    questions.path = tmp_path / "Berg friday.3mf"
    QTest.mouseClick(dialog.nest, LEFT)
    rest()
    assert "The file name holds the patient's name" in clinic.services.messages.dialogs[-1].text()
    assert not [*tmp_path.glob("Berg*")]
