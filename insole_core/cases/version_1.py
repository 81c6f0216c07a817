"""Cases of version 1 had one foot, with one prescription; they are read as cases of today."""

from __future__ import annotations

from typing import Any

from insole_core.cases.case_record import FIRST_NAME
from insole_core.json_object import JsonObject

FOOT_NAME_1 = "foot.npz"


def as_version_2(case: JsonObject) -> JsonObject:
    """Say in the words of version 2 what a case of version 1 says.

    Raises
    ------
    InputError
        When a part is missing.
    """
    content: dict[str, Any] = {"patient": case.value("patient"), "feet": []}
    annotations = case.value("annotations")
    if case.has("foot"):
        foot = case.object("foot")
        content["at_hand"] = foot.value("side")
        content["feet"] = [
            {
                **foot.values,
                "source": case.value("source"),
                "annotations": annotations,
                "variants": [{"name": FIRST_NAME, "design": case.value("design")}],
                "chosen": FIRST_NAME,
            }
        ]
    return JsonObject(case.file, content)
