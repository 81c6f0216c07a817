"""What a clinician types is found in the list of findings, in the language of the window."""

from __future__ import annotations

from pathlib import Path

import pytest

from insole_core.insole.prescription.design import InsoleDesign
from insole_core.workflows.clinic_findings import ClinicFindings
from insole_core.workflows.findings import Finding
from insole_studio.features.design.devices.device_choices import finding_choices, matching


def found(text: str) -> list[str]:
    def as_it_is(_finding: Finding, design: InsoleDesign) -> InsoleDesign:
        return design

    choices = list(finding_choices(ClinicFindings(Path("/nowhere")).load(), as_it_is))
    return [choice.name for choice in matching(choices, text)]


@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("plantar fasciitis", "Plantar fasciitis"),
        ("fasciitis", "Plantar fasciitis"),
        ("heel spur", "Heel spur"),
        ("calcaneal spur", "Heel spur"),
        ("horseshoe", "Worn heel pad"),
        ("hammer toe 2nd", "Pressure under the 2nd toe"),
        ("callus 3rd head", "Overload of the 3rd metatarsal head"),
        ("cuboid", "Cuboid syndrome"),
        ("toe filler", "Missing 1st toe"),
        ("fallen arch", "Flatfoot of an adult"),
    ],
)
def test_it_is_found_by_what_it_is_called_and_treated_with(typed: str, first: str) -> None:
    assert found(typed)[0] == first


@pytest.mark.usefixtures("swedish")
@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("plantar fasciit", "Plantar fasciit"),
        ("hälsporre", "Hälsporre"),
        ("halsporre", "Hälsporre"),
        ("heel spur", "Hälsporre"),
        ("liktorn", "Tryck under 1:a tån"),
        ("nedsjunket", "Plattfot hos vuxen"),
        ("kuboid", "Kuboidsyndrom"),
    ],
)
def test_it_is_found_in_swedish_as_in_english(typed: str, first: str) -> None:
    assert found(typed)[0] == first
