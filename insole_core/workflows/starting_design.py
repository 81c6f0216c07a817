"""The design that a new foot begins with: one of the clinic's usual device, without corrections."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from insole_core.foot.foot import Foot
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device, apply_device
from insole_core.insole.prescription.materials import MaterialTable, with_least_thickness
from insole_core.messages import Message
from insole_core.workflows.clinic_devices import clinic_devices, default_device
from insole_core.workflows.clinic_materials import ClinicMaterials
from insole_core.workflows.default_device import DefaultDevice


@dataclass(frozen=True)
class StartingDevice:
    """The device of new designs.

    Parameters
    ----------
    materials
        The clinic's table.
    problem
        Why it is not the clinic's choice, a sentence; None if it is.
    """

    device: Device
    materials: MaterialTable
    problem: Message | None = None

    def design(self, foot: Foot) -> InsoleDesign:
        """Return a new design for a foot, without expansion where its tissue was spread already."""
        design = apply_device(self.device, InsoleDesign(foot.side))
        if foot.form.is_spread and design.finish is not None:
            design = replace(design, finish=replace(design.finish, expansion_mm=0.0))
        return with_least_thickness(design, self.materials)


def starting_device(folder: Path) -> StartingDevice:
    """Return the device of new designs.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """
    devices = clinic_devices(folder).load().items
    device, problem = default_device(devices, DefaultDevice(folder).load())
    return StartingDevice(device, ClinicMaterials(folder).load()[0], problem)
