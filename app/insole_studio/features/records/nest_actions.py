"""Nests the stored solids of several orders, and writes the nest."""

from __future__ import annotations

import shutil
import uuid
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.cases.case_record import Patient
from insole_core.errors import InsoleError
from insole_core.files.atomic import make_private_folder
from insole_core.files.write_errors import is_there, output_errors
from insole_core.formats.file_formats import SOLID_FORMATS
from insole_core.progress import Progress
from insole_core.records.order import OrderSummary
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.services.other_programs import open_file
from insole_studio.texts import tr, translate_core_message

# What computes is imported when somebody nests: the window starts faster without it.
if TYPE_CHECKING:
    from insole_core.records.records import Records
    from insole_core.workflows.nest_orders import WrittenNest
    from insole_studio.features.records.nest_dialog import NestChoice, NestDialog

NESTING = "nest-orders"
_FORMAT = ".3mf"
"""That is offered first: it keeps the pieces apart, each with its name."""


class NestActions(QObject):
    """Asks what is nested on which block, reads the orders' solids, and writes the nest."""

    def __init__(self, services: AppServices) -> None:
        super().__init__(services.window)
        self._services = services
        self._tell = services.messages.show_error
        self.dialog: NestDialog | None = None
        """The one that is open."""
        self._last: NestChoice | None = None
        """What was nested last, and how, until the program ends."""
        self._copying: Path | None = None
        self._copies: set[Path] = set()
        """Those that are nested, and those that no nest has taken."""
        services.jobs.ended.connect(self._remove_copies)

    def ask(self, orders: Sequence[OrderSummary]) -> None:
        """Ask which of the orders are nested, and how."""
        from insole_core.solids.shop import read_shop
        from insole_core.workflows.clinic_tables import ClinicBlocks
        from insole_core.workflows.mill import clinic_machines
        from insole_studio.features.records.nest_dialog import NestDialog

        folder = self._services.paths.settings_folder
        try:
            blocks = ClinicBlocks(folder / "blocks.json").load()
        except InsoleError as error:
            self._tell(error)
            return
        machines = clinic_machines(folder).load().items
        dialog = NestDialog(orders, (*read_shop().blocks, *blocks), machines, self._services.window)
        if self._last is not None:
            dialog.show_means(self._last)
        self.dialog = dialog
        dialog.finished.connect(dialog.deleteLater)
        dialog.accepted.connect(lambda: self._ask_place(dialog.choice, orders))
        dialog.finished.connect(self._forget_dialog)
        dialog.open()

    def _forget_dialog(self) -> None:
        self.dialog = None

    def _ask_place(self, choice: NestChoice, orders: Sequence[OrderSummary]) -> None:
        """Ask where the nest is written, then read the files of its orders."""
        from insole_core.workflows.nameless import require_nameless
        from insole_core.workflows.nest_orders import places_of_nest, require_no_other_nest

        formats = sorted(SOLID_FORMATS, key=lambda form: form.ending != _FORMAT)
        kinds = ";;".join(f"{form.name} ({form.patterns})" for form in formats)
        questions = self._services.messages.questions
        out = questions.name_to_write(tr("nest") + _FORMAT, kinds, Kept.EXPORTS)
        if out is None:
            return
        self._last = choice
        names = [order.person_name for order in orders if order.id in choice.orders]
        try:
            for name in names:
                require_nameless(Patient(name), {"file name": out.stem})
            require_no_other_nest(out, out.stem, choice.milling)
        except InsoleError as error:
            self._tell(error)
            return
        there = [p for p in places_of_nest(out, choice.milling).values() if is_there(p)]
        if there and not questions.may_replace(there):
            return
        folder = self._services.paths.papers_folder / uuid.uuid4().hex
        if self._copying is not None:  # the new question takes the place of the earlier one
            self._copies.add(self._copying)
        self._copying = folder
        numbers = {order.id: order.number for order in orders}

        def copy(records: Records) -> dict[str, tuple[Path, ...]]:
            files = {}
            for order_id in choice.orders:
                place = folder / order_id
                with output_errors(place):
                    make_private_folder(place)
                files[numbers[order_id]] = records.orders.copy_files(order_id, place)
            return files

        def nest(files: dict[str, tuple[Path, ...]]) -> None:
            self._copying = None
            self._nest(choice, files, out)
            self._copies.add(folder)  # only now has a nest ended that this one replaces

        def missed(error: Exception) -> None:
            self._copying = None
            shutil.rmtree(folder, ignore_errors=True)
            self._tell(error)

        self._services.clinic.ask(NESTING, copy, nest, missed)

    def _nest(self, choice: NestChoice, files: dict[str, tuple[Path, ...]], out: Path) -> None:
        from insole_core.workflows.nest_orders import (
            gathered,
            has_pieces,
            nest_pieces,
            pieces_of_files,
            write_nest,
        )

        def task(progress: Progress) -> tuple[int, WrittenNest]:
            missing = [number for number, copies in files.items() if not has_pieces(copies)]
            pieces = gathered(
                pieces_of_files(copies, number)
                for number, copies in files.items()
                if number not in missing
            )
            nest = nest_pieces(
                pieces, choice.block,
                gap_mm=choice.gap_mm, margin_mm=choice.margin_mm,
                across=choice.milling is None, marked=choice.marked, missing=missing,
                progress=progress.part(0.0, 0.6),
            )  # fmt: skip
            written = write_nest(
                nest, out,
                title=out.stem, milling=choice.milling, translate=translate_core_message,
                progress=progress.part(0.6, 1.0),
            )  # fmt: skip
            return len(nest.pieces), written

        self._services.run(NESTING, task, lambda done: self._say(*done, out))

    def _remove_copies(self, channel: str) -> None:
        """Remove the copies of the nest that has ended, also where it was cancelled."""
        while channel == NESTING and self._copies:
            shutil.rmtree(self._copies.pop(), ignore_errors=True)

    def _say(self, count: int, written: WrittenNest, out: Path) -> None:
        one, several = (
            tr("One piece is nested in {name}."),
            tr("{count} pieces are nested in {name}."),
        )
        sentence = one if count == 1 else several
        told = sentence.format(count=count, name=out.name)
        notes = (translate_core_message(note) for note in written.notes)
        self._services.notices.put(
            NESTING, " ".join((told, *notes)),
            (tr("Open the folder"), lambda: open_file(out.parent)),
            stays=True, on_pages=True,
        )  # fmt: skip
