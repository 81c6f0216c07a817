"""What the tests of the pages of the record share."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from datetime import date

import pytest
from pytestqt.qtbot import QtBot

from insole_core.cases.case_record import FootRecord
from insole_core.cases.scan_source import ScanSource
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.records.author import Author
from insole_core.records.person import Person
from insole_core.records.place import RecordsPlace
from insole_core.records.records import Records, open_records
from insole_core.records.visit import Visit
from insole_studio.app.bootstrap import Application
from insole_studio.document import record_keeper
from insole_studio.features.records.visit_card import VisitPictures
from insole_studio.user_paths import UserPaths


@pytest.fixture(autouse=True)
def quick_saving(monkeypatch: pytest.MonkeyPatch) -> None:
    """Save a change sooner than a user would notice; one test waits as long as the product does."""
    monkeypatch.setattr(record_keeper, "SAVE_AFTER_MS", 20)


@pytest.fixture(autouse=True)
def without_pictures(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make no small pictures, which take longer than all else, but where a test asks for them."""
    if request.node.get_closest_marker("drawn") is None:
        monkeypatch.setattr(VisitPictures, "want", lambda _pictures, _versions: None)


@pytest.fixture
def other_station(clinic: Application, paths: UserPaths) -> Iterator[Records]:
    """The same record, opened by somebody else at another computer."""
    place = RecordsPlace.local(paths.records_folder)
    opened = open_records(place, Author("Dr. Dal", "capture-room"))
    yield opened
    opened.close()


@pytest.fixture
def visit(records: Records, make_foot: Callable[[Side], Foot]) -> Visit:
    """A visit of Anna Berg with a prescription for her left foot."""
    anna = records.persons.add(Person("Anna Berg", date(1970, 2, 28)))
    added = records.visits.add(Visit(anna.id, date.today(), reason="Heel pain"))
    source = ScanSource("mesh", "/nowhere/foot.ply", "0" * 64)
    records.prescriptions.save(added.id, FootRecord.begun(make_foot(Side.LEFT), source), None)
    return added


@pytest.fixture
def opened(clinic: Application, visit: Visit, qtbot: QtBot) -> Application:
    """The window with the visit on its panels."""
    clinic.features.records.open_visit(visit.id)
    qtbot.waitUntil(lambda: clinic.case.kept is not None)
    return clinic
