"""The file of a form: docs/formats/device.md."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from insole_core.errors import DesignError, InputError
from insole_core.insole.prescription.base_form import Form
from insole_core.insole.prescription.design_json import form_from_json, form_to_json
from insole_core.json_object import JsonObject

FORMAT, VERSION = "insole-form", 1


def read_form(path: Path) -> Form:
    """Read a form.

    Raises
    ------
    InputError
        Naming the file, and the key that is missing, unknown or out of range.
    """
    content = JsonObject.read(path)
    content.check_format(FORMAT, VERSION)
    values: dict[str, Any] = dict(content.values)
    del values["format"], values["version"]
    try:
        return form_from_json(values)
    except DesignError as error:
        raise InputError("{file}: {reason}", file=content.file, reason=error.message) from error


def write_form(form: Form, path: Path) -> None:
    """Write a form to a path, as a rule the temporary one of `replacing_file`."""
    content = {"format": FORMAT, "version": VERSION, **form_to_json(form)}
    text = json.dumps(content, ensure_ascii=False)
    path.write_text(text + "\n", encoding="utf-8", newline="\n")
