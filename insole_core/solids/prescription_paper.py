"""The prescription on paper, and who answers for the device (Regulation (EU) 2017/745, Annex XIII).

Section 1 of the annex asks for the name and address of the manufacturer, what identifies the
device, the patient's name, an acronym or a numerical code, the name of the person who made out the
prescription and of the health institution, and the characteristics that it specifies.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from insole_core.errors import InputError
from insole_core.foot.landmarks import Landmarks
from insole_core.geometry.side import Side
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.messages import Translate, joined


@dataclass(frozen=True)
class Responsible:
    """Who answers for a custom-made device.

    Parameters
    ----------
    prescriber
        The person who made out the prescription.
    clinic
        The health institution; may be empty, as where the prescriber has a practice of their own.
    maker, maker_address
        The manufacturer, who signs the statement.
    """

    prescriber: str = ""
    clinic: str = ""
    maker: str = ""
    maker_address: str = ""

    @property
    def missing(self) -> tuple[str, ...]:
        """What the statement needs and nobody has given, in words."""
        needed = {
            "the prescriber": self.prescriber,
            "the maker": self.maker,
            "the maker's address": self.maker_address,
        }
        return tuple(words for words, value in needed.items() if not value.strip())


NOBODY = Responsible()


def prescriber_of(designs: Sequence[InsoleDesign]) -> str:
    """Return who prescribed, if all active corrections that are signed name the same person."""
    authors = {correction.author for design in designs for correction in design.active}
    authors.discard("")
    return authors.pop() if len(authors) == 1 else ""


def require_statement(responsible: Responsible, identification: Mapping[str, str]) -> None:
    """Check that a prescription can state what Annex XIII asks for.

    Parameters
    ----------
    identification
        Of the patient: "name" or "pseudonym".

    Raises
    ------
    InputError
        Naming what is missing.
    """
    missing = list(responsible.missing)
    if not any(identification.get(key, "").strip() for key in ("name", "pseudonym")):
        missing.insert(0, "the patient's name or a pseudonym")
    if missing:
        raise InputError(
            "The prescription cannot be written without {missing}; put in what is missing.",
            missing=joined(missing),
        )


def write_prescription_paper(
    designs: Sequence[InsoleDesign],
    path: Path,
    *,
    responsible: Responsible,
    identification: Mapping[str, str],
    material: str,
    day: date,
    provenance: Mapping[Side, Mapping[str, str]] | None = None,
    landmarks: Mapping[Side, Landmarks] | None = None,
    warnings: Mapping[Side, Sequence[str]] | None = None,
    translate: Translate = str,
) -> None:
    """Write the prescription of one foot or of both, with the statement.

    Parameters
    ----------
    identification
        Of patient and device: name, birth date, visit, pseudonym or order number.
    day
        Date of the paper.
    provenance
        What is known of the device of each foot beside its design: how it came about, what it
        changes.
    landmarks : insole frame
        Of each foot, for the places of pads behind the heads.
    warnings
        What is unusual about the insole of each foot, a sentence each.
    translate
        Into the language of the paper.

    Raises
    ------
    InputError
        When something that the statement names is missing.
    OutputError
        When the place cannot be written.
    """
    from insole_core.export.paper import write_prescription

    require_statement(responsible, identification)
    lines, make, unusual = [], {}, []
    for design in designs:
        side = translate(str(design.side))
        marks = (landmarks or {}).get(design.side)
        said = correction_lines(design, marks)
        lines += [f"{side.capitalize()}. {translate(line)}" for line in said]
        unusual += [
            f"{side.capitalize()}. {translate(sentence)}"
            for sentence in (warnings or {}).get(design.side, ())
        ]
        known = (provenance or {}).get(design.side, {})
        for key, value in {**make_facts(design), **known}.items():
            make[f"{side}, {translate(key)}"] = translate(value)
    sides = " and ".join(str(design.side) for design in designs)
    write_prescription(
        {**identification, "side": sides, "date": day.isoformat()},
        lines,
        {"material": translate(material) or "–", **make},
        path,
        warnings=unusual,
        responsible={key.replace("_", " "): value for key, value in vars(responsible).items()},
        translate=translate,
    )
