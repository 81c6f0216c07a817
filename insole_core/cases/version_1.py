"""Migration of cases of version 1, which had one foot with one prescription."""

from __future__ import annotations

from typing import Any

from insole_core.cases.case_record import FIRST_NAME
from insole_core.json_object import JsonObject

FOOT_NAME_1 = "foot.npz"


def as_version_2(case: JsonObject) -> JsonObject:
    """Convert the root object of a case from version 1 to version 2.

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
