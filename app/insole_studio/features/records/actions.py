"""Actions of the clinic's record: its pages, patients and visits."""

from __future__ import annotations

from typing import TYPE_CHECKING

from insole_studio.services.action_record import ActionRecord
from insole_studio.texts import tr

if TYPE_CHECKING:
    from insole_studio.features.records.patient_records import PatientRecords


OF_PERSON = ("new_visit", "new_visit_same", "follow_up", "person_orders")
"""Actions on the person whose page is shown."""
ADDING = ("new_patient", "import_table", "import_cases")
"""Actions that add patients, wherever they are asked for."""

RECORD_ACTIONS: tuple[ActionRecord[PatientRecords], ...] = (
    ActionRecord(
        "patients",
        lambda: tr("Patients"),
        lambda: tr("Search for a patient; today's visits and open orders"),
        lambda records, _on: records.show_start(),
        icon="patients",
        shortcut="F3",
        everywhere=True,
    ),
    ActionRecord(
        "new_patient",
        lambda: tr("New patient…"),
        lambda: tr("Add a patient to the clinic's record"),
        lambda records, _on: records.ask_new_patient(),
        icon="new_patient",
        shortcut="Ctrl+Shift+N",
    ),
    ActionRecord(
        "import_table",
        lambda: tr("Import patients…"),
        lambda: tr("Add the patients of a table (CSV) from another program"),
        lambda records, _on: records.transfer.import_table(),
    ),
    ActionRecord(
        "import_cases",
        lambda: tr("Import case files…"),
        lambda: tr("Add the case files of a folder as visits"),
        lambda records, _on: records.transfer.import_cases(),
    ),
    ActionRecord(
        "export_patient",
        lambda: tr("Export patient…"),
        lambda: tr("Export the patient as a folder that opens without this program"),
        lambda records, _on: records.export_patient(),
        short=lambda: tr("Export…"),
    ),
    ActionRecord(
        "new_visit",
        lambda: tr("New visit"),
        lambda: tr("Add a visit of today for the patient on the page, and open it"),
        lambda records, _on: records.begin_visit(),
        icon="visit",
        shortcut="Ctrl+T",
    ),
    ActionRecord(
        "new_visit_same",
        lambda: tr("New visit, same prescription"),
        lambda: tr("Add a visit of today, to be prescribed as the last one on a new scan"),
        lambda records, _on: records.begin_visit(same_prescription=True),
    ),
    ActionRecord(
        "orders",
        lambda: tr("Orders"),
        lambda: tr("The orders of the clinic by state, the first due on top"),
        lambda records, _on: records.show_orders(),
        shortcut="Shift+F3",
        everywhere=True,
    ),
    ActionRecord(
        "person_orders",
        lambda: tr("Orders of the patient"),
        lambda: tr("The orders of the patient on the page"),
        lambda records, _on: records.show_orders(of_person=True),
        short=lambda: tr("Orders"),
    ),
    ActionRecord(
        "follow_up",
        lambda: tr("Follow-up…"),
        lambda: tr("What became of the insoles of the patient on the page"),
        lambda records, _on: records.ask_follow_up(),
    ),
    ActionRecord(
        "visit_photos",
        lambda: tr("Photos of the visit…"),
        lambda: tr("Photos of the open visit, to draw and write on"),
        lambda records, _on: records.show_photos(),
    ),
    ActionRecord(
        "sample_patient",
        lambda: tr("Sample patient"),
        lambda: tr("An invented patient to try the program with; comes back if it was removed"),
        lambda records, _on: records.sample.show(),
    ),
    ActionRecord(
        "remove_sample",
        lambda: tr("Remove the sample patient…"),
        lambda: tr("Remove the invented patient and all that was tried on it"),
        lambda records, _on: records.sample.ask_to_remove(),
    ),
    ActionRecord(
        "add_to_record",
        lambda: tr("Add to the record…"),
        lambda: tr("Make a visit of the open case; its file stays as it is"),
        lambda records, _on: records.add_case(),
    ),
)
