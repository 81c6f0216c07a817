"""The stored files of an order, brought back: its papers to print, its folder to look into."""

from __future__ import annotations

import shutil
import uuid
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject

from insole_core.errors import OutputError
from insole_core.files.atomic import make_output_folder, make_private_folder
from insole_core.files.write_errors import output_errors
from insole_core.messages import joined
from insole_core.records.order import Order
from insole_core.visible_text import visible_line
from insole_core.workflows.records.plain_name import free_folder
from insole_studio.services.app_services import AppServices
from insole_studio.services.files import Kept
from insole_studio.services.other_programs import open_file
from insole_studio.texts import tr
from insole_studio.user_paths import is_older

if TYPE_CHECKING:
    from insole_core.records.records import Records

Open = Callable[[Path], bool]
_LEFT_S = 86_400.0
"""Age from which copies are of a window that crashed: another one may be printing newer ones."""


class OrderFiles(QObject):
    """Opens papers and folders of orders in the programs that the user has for them.

    Parameters
    ----------
    open_path
        Opens a file or a folder; returns whether there is a program for it.
    """

    def __init__(self, services: AppServices, open_path: Open = open_file) -> None:
        super().__init__(services.window)
        self._services = services
        self._open = open_path
        self._tell = services.messages.show_error
        self._printed: list[Path] = []
        _remove_old(services.paths.papers_folder)

    def close(self) -> None:
        """Remove the copies that were printed from this window."""
        while self._printed:
            shutil.rmtree(self._printed.pop(), ignore_errors=True)

    def open_papers(self, order_id: str) -> None:
        """Open the papers of the newest revision, from where they are printed."""
        folder = self._services.paths.papers_folder / uuid.uuid4().hex
        self._printed.append(folder)

        def copy(records: Records) -> tuple[Path, ...]:
            from insole_core.workflows.records.order_papers import copy_papers

            with output_errors(folder):
                make_private_folder(folder)
            return copy_papers(records, order_id, folder)

        self._services.clinic.ask("records-papers", copy, self._open_all, self._tell)

    def open_folder(self, order_id: str) -> None:
        """Open the folder that the files were written to; where it is gone, they are copied."""

        def show(order: Order) -> None:
            place = Path(order.place)
            if order.place and _holds(place, order):
                self._open_all((place,))
            elif order.files:
                self._copy_to_folder(order)
            else:
                sentence = tr("Order {number} was written without files.")
                self._services.messages.say(sentence.format(number=order.number))

        self._services.clinic.ask(
            "records-order", lambda records: records.orders.get(order_id), show, self._tell
        )

    def _copy_to_folder(self, order: Order) -> None:
        """Copy the files of an order out of the record, and open the folder of the copies."""
        title = tr("The files of order {number} are copied from the record; choose where to")
        questions = self._services.messages.questions
        within = questions.folder_to_open(title.format(number=order.number), Kept.EXPORTS)
        if within is None:
            return
        folder = free_folder(within, order.number, "order")

        def copy(records: Records) -> tuple[Path, ...]:
            make_output_folder(folder)
            records.orders.copy_files(order.id, folder)
            return (folder,)

        self._services.clinic.ask("records-order-files", copy, self._open_all, self._tell)

    def _open_all(self, paths: tuple[Path, ...]) -> None:
        if not paths:
            self._services.messages.say(tr("This order was written without papers."))
        closed = [path for path in paths if not self._open(path)]
        if len(closed) == 1:
            self._tell(
                OutputError(
                    "{path} cannot be opened: no program for it is installed; open it from "
                    "the file manager.",
                    path=visible_line(str(closed[0])),
                )
            )
        elif closed:
            self._tell(
                OutputError(
                    "No program is installed that opens {names}; they are in {folder}.",
                    names=joined(visible_line(path.name) for path in closed),
                    folder=visible_line(str(closed[0].parent)),
                )
            )


def _remove_old(papers: Path) -> None:
    """Remove the copies that a window has left behind which did not end by itself."""
    for folder in papers.glob("*"):
        if is_older(folder, _LEFT_S):
            shutil.rmtree(folder, ignore_errors=True)


def _holds(place: Path, order: Order) -> bool:
    """Return whether a folder has the files of an order's newest revision."""
    try:
        return bool(order.newest_files) and all(
            (place / file.name).is_file() for file in order.newest_files
        )
    except OSError:  # a share that does not answer, or a path of another system
        return False
