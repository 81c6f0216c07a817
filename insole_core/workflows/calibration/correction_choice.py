"""Whether the learnt correction is used for a set of sensors, as a proof of the chain decided.

Stored beside the calibrated sensors, because it holds for those that measure together.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

from insole_core.errors import InputError
from insole_core.files.atomic import make_output_folder, write_text
from insole_core.json_object import JsonObject
from insole_core.messages import Message, joined
from insole_core.recording.session import Session
from insole_core.workflows.calibration.sensor_store import sensors_folder_of_user

CHOICES_FILE = "correction_choices.json"
_FORMAT = "insole-correction-choices"

ChosenBy = Literal["default", "proof", "call"]


@dataclass(frozen=True)
class CorrectionChoice:
    """Whether the learnt correction is used, and who said so.

    Parameters
    ----------
    corrected
    chosen_by
        The product's default, a proof of the chain, or the caller.
    note
        For the user where something other than the default is done, or a choice cannot be read;
        a sentence, often empty.
    reason
        What the proof found, in the words of its report, or why there is no choice.
    is_learnt
        Whether there is a learnt correction for any of the sensors.
    """

    corrected: bool = True
    chosen_by: ChosenBy = "default"
    note: str = ""
    reason: str = ""
    is_learnt: bool = True

    def called(self, corrected: bool | None) -> CorrectionChoice:
        """Return the choice of the caller, or this one where he makes none that is possible."""
        if corrected is None:
            return self
        if corrected and not self.is_learnt:
            return replace(self, note=self.reason)
        return CorrectionChoice(corrected, "call")

    def json(self) -> dict[str, Any]:
        """Return it for a report."""
        return {
            "used": "learnt" if self.corrected else "none",
            "chosen_by": self.chosen_by,
            "reason": self.reason or self.note,
        }


BY_DEFAULT = CorrectionChoice()
NOT_LEARNT = CorrectionChoice(
    corrected=False,
    reason=Message(
        "No correction is learnt for sensors of this kind, so their depth is used as it is."
    ),
    is_learnt=False,
)


@dataclass(frozen=True)
class Decision:
    """What a proof decided for a set of sensors.

    Parameters
    ----------
    serials
        Of the sensors that were captured together.
    corrected
    decided_at
        ISO 8601, UTC.
    reason
        A sentence.
    """

    serials: frozenset[str]
    corrected: bool
    decided_at: str
    reason: str

    @property
    def choice(self) -> CorrectionChoice:
        """What follows for a session of these sensors."""
        note = Message(
            "The learnt correction is off for the sensors {serials}, because a proof on {date} "
            "found it to do harm.",
            serials=joined(sorted(self.serials)),
            date=self.decided_at[:10],
        )
        return CorrectionChoice(
            self.corrected, "proof", "" if self.corrected else note, self.reason
        )


class CorrectionChoices:
    """Storage of the decisions, in one file in the folder of the calibrated sensors.

    Parameters
    ----------
    folder
        Of the sensors.
    """

    def __init__(self, folder: Path) -> None:
        self.path = folder / CHOICES_FILE

    def of(self, serials: Iterable[str]) -> CorrectionChoice:
        """Return the choice for sensors that have captured together.

        A proof of more sensors holds for some of them too. A file that cannot be read, or that a
        newer version has written, is left alone; the default is used, and the note says so.
        """
        wanted = frozenset(serials)
        try:
            decisions = [_decision(item) for item in self._sets()]
        except InputError as error:
            note = Message(
                "{reason} Until then the learnt correction is used.", reason=error.message
            )
            return replace(BY_DEFAULT, note=note)
        fitting = [one for one in decisions if wanted and wanted <= one.serials]
        return min(fitting, key=lambda one: len(one.serials)).choice if fitting else BY_DEFAULT

    def keep(self, decision: Decision) -> Path:
        """Store a decision in place of the earlier one for the same sensors; all else stays.

        Raises
        ------
        InputError
            When the file that is there cannot be read, or is of a newer version; it stays as it is.
        OutputError
            When the place cannot be written.
        """
        others = [item.values for item in self._sets() if not _is_of(item, decision.serials)]
        kept = {
            "serials": sorted(decision.serials),
            "correction": "learnt" if decision.corrected else "none",
            "decided_at": decision.decided_at,
            "reason": decision.reason,
        }
        root = JsonObject.read(self.path).values if self.path.exists() else {}
        values = {**root, "format": _FORMAT, "version": 1, "sets": [*others, kept]}
        make_output_folder(self.path.parent)
        write_text(json.dumps(values, indent=1, ensure_ascii=False) + "\n", self.path)
        return self.path

    def _sets(self) -> list[JsonObject]:
        if not self.path.exists():
            return []
        root = JsonObject.read(self.path)
        root.check_format(_FORMAT)
        return root.objects("sets")


def choice_for(session: Session, sensors: Path | None = None) -> CorrectionChoice:
    """Return the choice for the sensors of a session.

    Parameters
    ----------
    sensors
        Folder of the calibrated sensors, by default this user's.
    """
    if not any(view.sensor.family.learnt for view in session.views):
        return NOT_LEARNT
    choices = CorrectionChoices(sensors or sensors_folder_of_user())
    return choices.of(view.sensor.serial for view in session.views)


def is_corrected(session: Session) -> bool:
    """Return whether the learnt correction is used for the sensors of a session of this user."""
    return choice_for(session).corrected


def _is_of(item: JsonObject, serials: frozenset[str]) -> bool:
    return frozenset(item.texts("serials")) == serials


def _decision(item: JsonObject) -> Decision:
    return Decision(
        frozenset(item.texts("serials")),
        item.choice("correction", ["learnt", "none"]) == "learnt",
        item.date("decided_at"),
        item.text("reason", empty=True),
    )
