"""How long the record is kept; erasing a patient on request, and those whose time is over."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import date
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFormLayout, QHBoxLayout, QLineEdit, QSpinBox, QWidget

from insole_core.records.retention import LEAST_YEARS, MOST_YEARS, ErasureReason, keep_for
from insole_studio.document.clinic_record import ClinicRecord
from insole_studio.document.record_maintenance import ErasedLeftovers
from insole_studio.features.clinic.record_dialog import RecordDialog
from insole_studio.services.person_list import name_and_birth
from insole_studio.texts import fill, tr
from insole_studio.widgets.form_parts import ComboBox, allow, mark_labels, plain_button
from insole_studio.widgets.message_label import MessageLabel
from insole_studio.widgets.row_table import RowTable, TableRow

if TYPE_CHECKING:
    from insole_core.records.person import Person
    from insole_core.records.records import Records
    from insole_core.records.retention import Erasable, Erasure

_SIZE = (680, 520)
_MOST_LETTERS = 60
_NO_REASON = ""
_MOST_LISTED = 100


@dataclass(frozen=True)
class _Shown:
    """What the dialog shows before anybody is looked up.

    Parameters
    ----------
    over
        Those whose time of keeping is over, the oldest first, at most `_MOST_LISTED`.
    """

    years: int
    over: list[Erasable]


class EraseDialog(RecordDialog):
    """Finds the patient by the pseudonym of a written request, and names nobody but who is shown.

    Whoever erases may be somebody who may not see patients.

    Parameters
    ----------
    shown
        The patient whose page or visit the window shows, proposed and named; None for none.
    leftovers
        What this computer holds of them, which is removed once they are erased.
    """

    def __init__(
        self,
        clinic: ClinicRecord,
        shown: Person | None,
        leftovers: ErasedLeftovers,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(tr("Erase a patient"), clinic, parent)
        self.resize(*_SIZE)
        self._leftovers = leftovers
        self._shown_person = shown
        self._found: Erasable | None = None
        self._over: list[Erasable] = []
        self._is_asked = False
        self._is_one_asked = False
        self._today = date.today()
        self._years = LEAST_YEARS
        self.pseudonym = QLineEdit("" if shown is None else shown.pseudonym)
        self.pseudonym.setMaxLength(_MOST_LETTERS)
        self.pseudonym.setPlaceholderText(tr("As it stands on the patient's page: P-…"))
        self.pseudonym.textEdited.connect(lambda _text: self._forget())
        self.pseudonym.returnPressed.connect(self.look_up)
        self.find_button = plain_button(tr("Show what is erased"), self.look_up)
        self.reason = ComboBox(
            [
                (_NO_REASON, tr("Choose why")),
                (str(ErasureReason.REQUEST), tr("The patient has asked for it")),
                (str(ErasureReason.RETENTION_OVER), tr("The time of keeping is over")),
            ]
        )
        self.reason.edited.connect(lambda _reason: self._allow())
        self.years = QSpinBox()
        self.years.setRange(LEAST_YEARS, MOST_YEARS)
        self.years.setSuffix(tr(" years after the last entry"))
        self.years.editingFinished.connect(self._keep_years)
        self.means = MessageLabel()
        self.words = MessageLabel("quiet")
        self.over = RowTable((tr("Pseudonym"), tr("Visits"), tr("Orders"), tr("Kept until")))
        self.over.setAccessibleName(tr("The time of keeping is over"))
        self.over.chosen.connect(self._take)
        self.erase_all = self.add_button("", self._erase_all)
        self.erase = self.add_button("", self._erase)
        self._lay_out()
        self._ask_before_all()
        self._allow()
        self.ask(_read, self._show_over)

    def look_up(self) -> None:
        """Show what erasing the patient with this pseudonym would mean."""
        pseudonym = self.pseudonym.text().strip()
        if pseudonym:
            self.say("")
            self.ask(lambda records: _find(records, pseudonym), self._show)

    def _lay_out(self) -> None:
        row = QHBoxLayout()
        row.addWidget(self.pseudonym, 1)
        row.addWidget(self.find_button)
        form = QFormLayout()
        form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        form.addRow(tr("Pseudonym"), row)
        form.addRow(tr("Reason"), self.reason)
        mark_labels(form)
        keeping = QFormLayout()
        keeping.addRow(tr("The record is kept for"), self.years)
        mark_labels(keeping)
        self.content.addLayout(form)
        self.content.addWidget(self.means)
        self.content.addLayout(keeping)
        self.content.addWidget(self.words)
        self.content.addWidget(self.over, 1)
        self.content.addStretch()  # takes the space of a list that is not there

    def _show_over(self, shown: _Shown) -> None:
        self._over = shown.over
        # Earlier programs stored any number, which nobody shortens by leaving the field.
        self.years.setMaximum(max(MOST_YEARS, shown.years))
        self.years.setValue(shown.years)
        self._years = shown.years
        self.over.show_rows([_row(erasable) for erasable in shown.over])
        self.over.setVisible(bool(shown.over))
        self.words.say(_over_text(len(shown.over)))
        self._ask_before_all()
        if self.pseudonym.text():
            self.look_up()

    def _keep_years(self) -> None:
        years = self.years.value()
        if years == self._years:
            return
        self._years = years

        def keep(records: Records) -> _Shown:
            keep_for(records.context, years)
            return _read(records)

        self.change(keep, self._show_over)

    def _ask_before_all(self) -> None:
        """Let the button ask first, for those who are listed now."""
        self._is_asked = False
        self.erase_all.setText(tr("Erase all listed…"))
        self.erase_all.setVisible(bool(self._over))

    def _erase_all(self) -> None:
        """Erase all who are listed, once it has been said what that means."""
        if not self._is_asked:
            self._is_asked = True
            count = len(self._over)
            if count == 1:
                verb = tr("Erase one patient for good")
                what = tr("All that the record holds of the listed patient goes.")
            else:
                verb = tr("Erase {count} patients for good").format(count=count)
                what = tr("All that the record holds of the {count} listed patients goes.")
            self.erase_all.setText(verb)
            self.say_all(
                [
                    what.format(count=count),
                    tr("This cannot be undone; backups made before still hold the patient."),
                ],
                warns=True,
            )
            return
        listed, today, leftovers = self._over, self._today, self._leftovers
        reason = ErasureReason.RETENTION_OVER

        def erase(records: Records) -> _Shown:
            for one in listed:
                leftovers.erase(records, one.person_id, reason, today)
            return _read(records)

        def done(shown: _Shown) -> None:
            self._show_over(shown)
            self.say(tr("Patients erased: {count}.").format(count=len(listed)))

        self.change(erase, done)

    def _take(self, pseudonym: str) -> None:
        self.pseudonym.setText(pseudonym)
        self.reason.show_value(str(ErasureReason.RETENTION_OVER))
        self.look_up()

    def _show(self, found: Erasable) -> None:
        self._found = found
        self.means.say_all([*self._who(found), *_meaning(found, self._today)])
        self.make_room()
        self._allow()

    def _who(self, found: Erasable) -> list[str]:
        """Return name and birth date of the patient whom the window shows anyhow."""
        shown = self._shown_person
        if shown is None or shown.id != found.person_id:
            return []
        return [name_and_birth(shown.name, shown.birth_date)]

    def _forget(self) -> None:
        self._found = None
        self.means.say("")
        self._allow()

    def _allow(self) -> None:
        """Let the button ask first, for the one who is shown and the reason that is chosen."""
        if self._is_one_asked:
            self._is_one_asked = False
            self.say("")
        self.erase.setText(tr("Erase…"))
        why_not = ""
        if self._found is None:
            why_not = tr("Give the pseudonym of the patient first.")
        elif self.reason.currentData() == _NO_REASON:
            why_not = tr("Choose the reason first.")
        allow(self.erase, why_not)

    def refuse(self, error: Exception) -> None:
        """Tell why nobody was found or erased."""
        super().refuse(error)
        self._ask_before_all()
        self._forget()

    def _erase(self) -> None:
        """Erase who is shown, once it has been asked whether it is the right one."""
        found, today, leftovers = self._found, self._today, self._leftovers
        assert found is not None
        if not self._is_one_asked:
            self._is_one_asked = True
            self.erase.setText(tr("Erase {pseudonym} for good").format(pseudonym=found.pseudonym))
            sentences = [
                *self._who(found),
                tr("This cannot be undone; backups made before still hold the patient."),
            ]
            self.say_all(sentences, warns=True)
            return
        reason = ErasureReason(self.reason.currentData())

        def erase(records: Records) -> tuple[Erasure, _Shown]:
            return leftovers.erase(records, found.person_id, reason, today), _read(records)

        def done(answer: tuple[Erasure, _Shown]) -> None:
            erasure, shown = answer
            self._forget()
            self.pseudonym.clear()
            self._show_over(shown)
            self.say(_result(found.pseudonym, erasure))

        self.change(erase, done)


def _find(records: Records, pseudonym: str) -> Erasable:
    from insole_core.records.retention import find_erasable

    return find_erasable(records.context, pseudonym)


def _read(records: Records) -> _Shown:
    from insole_core.records.retention import over_retention_named, years_of_keeping

    years = years_of_keeping(records.context)
    return _Shown(years, over_retention_named(records.context, date.today(), _MOST_LISTED))


def _over_text(count: int) -> str:
    if count == 0:
        return tr("Nobody's time of keeping is over.")
    return tr("The time of keeping is over for these; nobody is erased by itself. Enter takes one:")


def _row(erasable: Erasable) -> TableRow:
    cells = (
        erasable.pseudonym,
        str(erasable.visits),
        str(erasable.orders),
        erasable.kept_until.isoformat(),
    )
    return TableRow(erasable.pseudonym, cells)


def _meaning(found: Erasable, today: date) -> list[str]:
    """Say what goes and what the law keeps."""
    counts = fill(
        tr("{pseudonym}: visits {visits}, orders {orders}."),
        pseudonym=found.pseudonym,
        visits=found.visits,
        orders=found.orders,
    )
    if found.kept_until > today:
        return [
            counts,
            tr(
                "Erased are name, birth date, personal number, contact and all notes, and captures "
                "that no insole was made from."
            ),
            tr(
                "The law keeps what documents the devices, under the pseudonym, until {day} "
                "(Regulation (EU) 2017/745, Annex XIII)."
            ).format(day=found.kept_until.isoformat()),
            tr("This cannot be undone; backups made before still hold the patient."),
        ]
    return [
        counts,
        tr("The time of keeping ended on {day}: all of it is erased.").format(
            day=found.kept_until.isoformat()
        ),
        tr("This cannot be undone; backups made before still hold the patient."),
    ]


def _result(pseudonym: str, erasure: Erasure) -> str:
    if erasure.kept_until is not None:
        return tr(
            "Everything that says who {pseudonym} is has been erased; the devices stay documented "
            "until {day}."
        ).format(pseudonym=pseudonym, day=erasure.kept_until.isoformat())
    return tr("Everything about {pseudonym} has been erased.").format(pseudonym=pseudonym)
