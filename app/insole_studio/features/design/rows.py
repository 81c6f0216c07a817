"""Values passed from presenters to views."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.geometry.side import Side


@dataclass(frozen=True)
class Measure:
    """One measure with its display texts; `tip` is its definition.

    `values` holds one number, or left, right, their ±, their difference and the difference in per
    cent; none for a line that explains the others. `key` identifies the measure if its place can
    be shown.
    """

    name: str
    values: tuple[str, ...]
    unit: str = ""
    tip: str = ""
    key: str = ""
    is_within_error: bool = False


@dataclass(frozen=True)
class WarningRow:
    """One warning: its sentence, and whether a click leads to its cause."""

    text: str
    leads: bool


@dataclass(frozen=True)
class CorrectionRow:
    """One correction in the list; `ordered` if its position among the others matters."""

    id: str
    side: Side
    text: str
    enabled: bool
    selected: bool
    ordered: bool = False


@dataclass(frozen=True)
class FieldSpec:
    """One editable number; `tip` says what it does.

    With a `slider`, the value can also be dragged, from `least` to `greatest`. With `least_known`,
    it is 0 if it is unknown, and otherwise at least that.
    """

    key: str
    label: str
    unit: str
    value: float
    least: float
    greatest: float
    step: float
    decimals: int = 1
    tip: str = ""
    slider: bool = False
    least_known: float = 0.0

    @property
    def shape(self) -> FieldSpec:
        """The same without value and range."""
        return replace(self, value=0.0, least=0.0, greatest=0.0)


@dataclass(frozen=True)
class ChoiceSpec:
    """One choice among options, which are pairs of value and text; `tip` says what it does."""

    key: str
    label: str
    value: str
    options: tuple[tuple[str, str], ...]
    tip: str = ""

    @property
    def shape(self) -> ChoiceSpec:
        """The same without the value."""
        return replace(self, value="")


@dataclass(frozen=True)
class Proposal:
    """A button: key of its action, text and tooltip."""

    key: str
    text: str
    tip: str = ""


@dataclass(frozen=True)
class FieldGroup:
    """A titled group of fields, with buttons.

    `caption` describes the buttons if their texts are not enough; a group that `folds` is for
    experts, and shown when its title is clicked.
    """

    title: str
    fields: tuple[FieldSpec | ChoiceSpec, ...] = ()
    offers: tuple[Proposal, ...] = ()
    note: str = ""
    caption: str = ""
    folds: bool = False

    @property
    def shape(self) -> FieldGroup:
        """The same without values and ranges; groups of equal shape can share fields.

        Of a group that is not folded, title and note are values as well: it is not opened by them.
        """
        title = self.title if self.folds else ""
        fields = tuple(field.shape for field in self.fields)
        return replace(self, title=title, note="", fields=fields)
