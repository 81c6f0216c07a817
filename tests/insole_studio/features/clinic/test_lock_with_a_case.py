"""The open visit is saved before and while the window is locked, for whoever has changed it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path

import pytest
from administering import OTHER_PASSWORD, PASSWORD, shown, sign_in
from PySide6.QtWidgets import QAbstractButton, QApplication
from pytestqt.qtbot import QtBot
from sqlalchemy import select
from stations import add_member, proven

from insole_core.cases.case_file import write_case
from insole_core.cases.case_record import CaseRecord, FootRecord, Patient
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.author import Role
from insole_core.records.person import Person
from insole_core.records.records import Records
from insole_core.records.schema import audit
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.document.clinic_record import RecordState
from insole_studio.document.record_keeper import KeepState
from insole_studio.features.clinic.sign_in_dialog import SignInDialog
from insole_studio.user_paths import UserPaths

TOMS_PASSWORD = "yet other long words"


@pytest.fixture
def eva(records: Records) -> Records:
    return records.for_author(proven("eva"))


@pytest.fixture
def tom(records: Records) -> Records:
    root = records.for_author(proven("admin", Role.ADMINISTRATOR))
    add_member(root.accounts, "tom", "Tom Tall", Role.TECHNICIAN, TOMS_PASSWORD)
    return records.for_author(proven("tom", Role.TECHNICIAN, "capture room"))


@pytest.fixture
def opened(
    with_accounts: Application, eva: Records, make_foot: Callable[[Side], Foot], qtbot: QtBot
) -> Application:
    """Eva has a visit of Anna open."""
    anna = eva.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    visit = eva.visits.add(Visit(anna.id, date.today()))
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    eva.prescriptions.save(visit.id, FootRecord.begun(make_foot(Side.LEFT), source), None)
    take_over(with_accounts, qtbot, "eva", OTHER_PASSWORD)
    with_accounts.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: with_accounts.case.kept is not None)
    return with_accounts


def take_over(app: Application, qtbot: QtBot, name: str, password: str) -> None:
    sign_in(shown(app, SignInDialog), name, password)
    lock = app.features.clinic.lock
    qtbot.waitUntil(lambda: lock.dialog is None)


def texts_of(app: Application) -> set[str]:
    """Return what stands on the buttons of the window."""
    return {button.text() for button in app.window.findChildren(QAbstractButton)}


def thicken(app: Application, thickness_mm: float) -> None:
    design = app.case.record.design
    assert design is not None
    app.case.apply(replace(design, thickness_mm=thickness_mm), "Thickness")


def newest(records: Records, app: Application) -> tuple[str, float]:
    """Return author and thickness of the newest version."""
    assert app.case.kept is not None
    version = records.prescriptions.versions(app.case.kept.visit.id, Side.LEFT)[0]
    return version.author, records.prescriptions.read(version.id).design.thickness_mm


def test_what_was_just_changed_is_saved_while_locked_and_the_next_user_goes_on_with_it(
    opened: Application, tom: Records, eva: Records, qtbot: QtBot
) -> None:
    thicken(opened, 4.5)
    record = opened.case.record
    opened.window.actions_by_key["lock"].trigger()
    assert opened.features.clinic.lock.dialog is not None
    qtbot.waitUntil(lambda: newest(eva, opened) == ("eva", 4.5))
    assert "Anna" not in opened.window.windowTitle()
    assert opened.window.windowTitle() == "Locked – Insole Studio"  # the name once
    take_over(opened, qtbot, "eva", OTHER_PASSWORD)
    assert opened.case.record is record
    assert "Anna" in opened.window.windowTitle()
    qtbot.waitUntil(lambda: opened.services.keeper.state is KeepState.SAVED)

    thicken(opened, 5.0)
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "tom", TOMS_PASSWORD)
    assert newest(eva, opened) == ("eva", 5.0)
    thicken(opened, 5.5)
    qtbot.waitUntil(lambda: newest(eva, opened) == ("tom", 5.5))


def test_the_log_tells_that_the_next_user_sees_what_was_open(
    opened: Application, tom: Records, eva: Records, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    """The visit on its panels, then the page of the patient; who returns sees nothing new."""

    def seen() -> list[tuple[str, str]]:
        with eva.context.database.reading() as connection:
            query = select(audit.c.author, audit.c.subject_kind).where(audit.c.action == "seen")
            rows = connection.execute(query.order_by(audit.c.seq)).all()
        return [(row.author, row.subject_kind) for row in rows]

    def sign_in_after_lock(name: str, password: str) -> None:
        opened.window.actions_by_key["lock"].trigger()
        take_over(opened, qtbot, name, password)
        rest()

    assert seen() == [("eva", "visit")]
    sign_in_after_lock("eva", OTHER_PASSWORD)
    assert seen() == [("eva", "visit")]
    sign_in_after_lock("tom", TOMS_PASSWORD)
    assert seen() == [("eva", "visit"), ("tom", "visit")]
    assert opened.case.kept is not None
    opened.features.records.show_person(opened.case.kept.person.id)
    rest()
    sign_in_after_lock("eva", OTHER_PASSWORD)
    assert sorted(seen()[3:]) == [("eva", "person"), ("eva", "visit")]
    sign_in_after_lock("admin", PASSWORD)
    assert len(seen()) == 5


def test_an_administrator_who_takes_over_finds_no_case(
    opened: Application, eva: Records, qtbot: QtBot
) -> None:
    assert opened.case.kept is not None
    visit_id = opened.case.kept.visit.id
    thicken(opened, 4.5)
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "admin", PASSWORD)
    qtbot.waitUntil(lambda: opened.case.is_empty)
    assert opened.window.page is opened.features.records.start
    assert "Anna" not in opened.window.windowTitle()
    (version,) = eva.prescriptions.versions(visit_id, Side.LEFT)[:1]
    assert eva.prescriptions.read(version.id).design.thickness_mm == 4.5


def test_a_conflict_that_comes_up_as_another_user_signs_in_keeps_nobody_out(
    opened: Application, tom: Records, qtbot: QtBot
) -> None:
    assert opened.case.kept is not None
    visit_id = opened.case.kept.visit.id
    theirs = tom.visits.open_case(visit_id)
    (foot,) = theirs.record.feet
    changed = foot.with_design(replace(foot.design, thickness_mm=6.0))
    opened.services.keeper._timer.blockSignals(True)  # it is saved as somebody signs in
    thicken(opened, 4.5)
    opened.window.actions_by_key["lock"].trigger()
    tom.prescriptions.save(visit_id, changed, theirs.bases[Side.LEFT])
    take_over(opened, qtbot, "tom", TOMS_PASSWORD)
    assert opened.services.keeper.state is KeepState.CONFLICT


def test_of_an_unsaved_file_another_user_sees_all_an_administrator_nothing_and_nothing_is_lost(
    opened: Application, tom: Records, small_session: Path, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    opened.controller.run_action("new_case", False)
    qtbot.waitUntil(lambda: opened.case.kept is None)
    opened.case.apply(Patient("Bo Ek"), "Edit")
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "tom", TOMS_PASSWORD)
    assert opened.case.record.patient.name == "Bo Ek"

    opened.features.foot.open_session(small_session, hand_over=False)
    opened.services.notices.put("handed", "Bo Ek: stored.", stays=True)
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "admin", PASSWORD)
    rest()
    assert opened.case.is_empty
    assert [w.windowTitle() for w in QApplication.topLevelWidgets() if w.isVisible()] == [
        opened.window.windowTitle()
    ]
    assert not [notice for notice in opened.services.notices.notices if "Bo Ek" in notice.text]
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "eva", OTHER_PASSWORD)
    qtbot.waitUntil(lambda: opened.case.record.patient.name == "Bo Ek")


def test_files_alone_leave_the_visit_that_was_open_as_accounts_were_asked_for(
    opened: Application, eva: Records, qtbot: QtBot
) -> None:
    """Somebody else switches the accounts on, or this window has to ask anew."""
    clinic, lock = opened.services.clinic, opened.features.clinic.lock
    assert opened.case.kept is not None
    lock._author = None
    clinic._set_state(RecordState.SIGNED_OUT)
    assert "Anna" not in opened.window.windowTitle()
    thicken(opened, 4.5)
    shown(opened, SignInDialog).close_button.click()
    assert lock.dialog is None
    assert opened.case.is_empty
    assert "Anna" not in opened.window.windowTitle()


def test_recovered_work_comes_up_once_somebody_who_treats_patients_has_signed_in(
    with_accounts: Application, paths: UserPaths, qtbot: QtBot
) -> None:
    app = with_accounts
    write_case(CaseRecord(Patient("Bo Ek")), paths.autosave_folder / "left.insole")
    app.services.recent.remember(paths.data_folder / "Bo Ek.insole")
    app.recover()
    assert "Bo Ek" not in app.window.windowTitle()
    assert "Bo Ek.insole" not in texts_of(app)
    assert app.case.is_empty
    [notice] = app.services.notices.notices
    assert notice.text.startswith("There is unsaved work on this computer.")
    take_over(app, qtbot, "admin", PASSWORD)
    assert app.case.is_empty
    assert "Bo Ek.insole" not in texts_of(app)
    app.window.actions_by_key["lock"].trigger()
    take_over(app, qtbot, "eva", OTHER_PASSWORD)
    assert app.case.record.patient.name == "Bo Ek"
    assert app.settings.record_had_accounts
    assert "Bo Ek.insole" in texts_of(app)
    app.autosave.forget()


def test_an_administrator_sees_no_case_that_waits_for_a_decision_and_nothing_of_it_is_lost(
    opened: Application, tom: Records, eva: Records, qtbot: QtBot, rest: Callable[[], None]
) -> None:
    """Somebody else has changed the same foot; the window is locked before anybody decides."""
    assert opened.case.kept is not None
    visit_id = opened.case.kept.visit.id
    theirs = tom.visits.open_case(visit_id)
    (foot,) = theirs.record.feet
    changed = foot.with_design(replace(foot.design, thickness_mm=6.0))
    tom.prescriptions.save(visit_id, changed, theirs.bases[Side.LEFT])
    thicken(opened, 4.5)
    keeper = opened.services.keeper
    qtbot.waitUntil(lambda: keeper.state is KeepState.CONFLICT)
    opened.window.actions_by_key["lock"].trigger()
    seen: list[str] = []
    opened.services.clinic.state_changed.connect(
        lambda: seen.append(opened.case.record.patient.name)
    )
    take_over(opened, qtbot, "admin", PASSWORD)
    rest()
    assert seen
    assert set(seen) == {""}
    assert opened.case.is_empty
    assert opened.window.page is opened.features.records.start
    assert opened.services.messages.dialogs == []
    opened.window.actions_by_key["lock"].trigger()
    take_over(opened, qtbot, "eva", OTHER_PASSWORD)
    rest()
    kept = [eva.prescriptions.read(v.id) for v in eva.prescriptions.versions(visit_id, Side.LEFT)]
    assert [foot.design.thickness_mm for foot in kept][:2] == [6.0, 4.5]


def test_quitting_a_locked_window_shows_nothing_and_asks_nothing(
    opened: Application, qtbot: QtBot
) -> None:
    opened.window.actions_by_key["lock"].trigger()
    dialog = shown(opened, SignInDialog)
    with qtbot.waitSignal(opened.controller.closed):
        dialog.close_button.click()
    assert opened.features.clinic.lock.dialog is not None
    assert "Anna" not in opened.window.windowTitle()
