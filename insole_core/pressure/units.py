"""Units of pressure in the exports of plates and insoles."""

from __future__ import annotations

from enum import StrEnum

_KPA = {"kPa": 1.0, "N/cm²": 10.0, "mmHg": 0.133322, "psi": 6.894757, "g/cm²": 0.0980665,
        "kg/cm²": 98.0665}  # fmt: skip
_WRITTEN = {
    "kpa": "kPa", "n/cm2": "N/cm²", "n/cm²": "N/cm²", "n/cm^2": "N/cm²", "mmhg": "mmHg",
    "psi": "psi", "g/cm2": "g/cm²", "g/cm²": "g/cm²", "g/cm^2": "g/cm²", "kg/cm2": "kg/cm²",
    "kg/cm²": "kg/cm²", "kg/cm^2": "kg/cm²", "n": "N",
}  # fmt: skip


class PressureUnit(StrEnum):
    """Unit of the numbers of a map."""

    KPA = "kPa"
    N_CM2 = "N/cm²"
    MMHG = "mmHg"
    PSI = "psi"
    G_CM2 = "g/cm²"
    KG_CM2 = "kg/cm²"
    NEWTON = "N"
    """Force on each sensor."""

    def kpa(self, sensor_mm2: float) -> float:
        """Return the pressure, kPa, of a number 1 on a sensor of an area, mm²."""
        return 1000.0 / sensor_mm2 if self is PressureUnit.NEWTON else _KPA[self]

    @classmethod
    def written(cls, text: str) -> PressureUnit | None:
        """Return the unit that a text names, in whatever case; None when it names none."""
        name = _WRITTEN.get(text.strip().lower())
        return None if name is None else cls(name)
