"""Named values in files of their own: those of the product, and a folder of the clinic's own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Generic, Protocol, TypeVar

from insole_core.errors import InputError, OutputError
from insole_core.files.atomic import make_output_folder, replacing_file
from insole_core.forgiving_json import keep_unreadable
from insole_core.insole.prescription.item_name import key_of
from insole_core.messages import Message


class Named(Protocol):
    """A value with a name."""

    @property
    def name(self) -> str: ...  # noqa: D102


Item = TypeVar("Item", bound=Named)


@dataclass(frozen=True)
class Listed(Generic[Item]):
    """The values that were found.

    Parameters
    ----------
    items
        By `key_of` their names, in the order of the keys.
    own
        Keys of those of the clinic.
    unreadable
        A sentence for each file of the clinic that cannot be read; the others are there.
    """

    items: dict[str, Item]
    own: frozenset[str]
    unreadable: tuple[Message, ...]


class NamedFiles(Generic[Item]):
    """Storage of named values, one JSON file each.

    A value of the clinic takes the place of one of the product with the same name, until it is
    removed.

    Parameters
    ----------
    product
        Folder of the product's files.
    own
        Folder of the clinic's files; it need not exist.
    read, write
        Of one file; `read` raises an `InputError`.
    """

    def __init__(
        self,
        product: Path,
        own: Path,
        read: Callable[[Path], Item],
        write: Callable[[Item, Path], None],
    ) -> None:
        self._product = product
        self._own = own
        self._read = read
        self._write = write

    def load(self) -> Listed[Item]:
        """Return all values.

        Raises
        ------
        InputError
            When a file of the product cannot be read.
        """
        items = {key_of(item.name): item for item in map(self._read, _files(self._product))}
        own, unreadable = set(), []
        for path in _files(self._own):
            try:
                item = self._read(path)
            except InputError as error:
                unreadable.append(error.message)
                continue
            items[key_of(item.name)] = item
            own.add(key_of(item.name))
        return Listed(dict(sorted(items.items())), frozenset(own), tuple(unreadable))

    def save(self, item: Item) -> None:
        """Store a value of the clinic under its name; one of that name is replaced.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        path = [self._own / f"{key_of(item.name)}.json", *self._files_of(item.name)][-1]
        make_output_folder(path.parent)
        if path.exists():
            keep_unreadable(path, lambda: self._read(path))
        with replacing_file(path) as beside:
            self._write(item, beside)

    def read(self, path: Path) -> Item:
        """Read a file that another clinic exported.

        Raises
        ------
        InputError
            When the file cannot be read.
        """
        return self._read(path)

    def export(self, item: Item, path: Path) -> None:
        """Write the file of a value, for another clinic to import.

        Raises
        ------
        OutputError
            When the place cannot be written.
        """
        with replacing_file(path) as beside:
            self._write(item, beside)

    def remove(self, name: str) -> None:
        """Remove a value of the clinic; one of the product of that name comes back.

        Raises
        ------
        OutputError
            When the file cannot be removed.
        """
        for path in self._files_of(name):
            try:
                path.unlink(missing_ok=True)
            except OSError as error:
                raise OutputError(
                    "{path} cannot be removed ({reason}); check that you may write there.",
                    path=path,
                    reason=error.strerror or "",
                ) from error

    def _files_of(self, name: str) -> list[Path]:
        """Return the clinic's files that hold a value of a name; the last one counts.

        A file that was copied into the folder may be called anything.
        """
        return [path for path in _files(self._own) if self._holds(path, name)]

    def _holds(self, path: Path, name: str) -> bool:
        try:
            return key_of(self._read(path).name) == key_of(name)
        except InputError:
            return False


def _files(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.json"))
