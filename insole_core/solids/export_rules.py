"""The shop's and the clinic's rules for what may leave the house: resources/rules/export.json."""

from __future__ import annotations

import json
import math
from collections.abc import Collection
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

from insole_core.errors import InputError
from insole_core.export.atomic import replacing_file
from insole_core.messages import Message, joined
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-export-rules", 1
Policy: TypeAlias = Literal["blocking", "warning", "off"]
CheckName: TypeAlias = Literal[
    "watertight", "thickness", "cutter", "undercut", "step", "block", "shoe_height"
]
_LEAST_CUTTER_MM, _GREATEST_CUTTER_MM = 1.0, 40.0
CHECK_NAMES: tuple[CheckName, ...] = get_args(CheckName)


@dataclass(frozen=True)
class ExportRules:
    """How strictly each check is taken, and its limit.

    Parameters
    ----------
    policies
        A check that is not named is off.
    limits
        Thickness: least, mm. Cutter: most material left in hollows, mm. Undercut: most area, mm².
        Step: most rise over 1 mm, mm. Shoe height: greatest height of the insole, mm.
    cutter_diameter_mm
        Of the ball-nose cutter.
    block_mm
        Length, width, height of the stock.
    """

    policies: dict[CheckName, Policy] = field(default_factory=dict)
    limits: dict[CheckName, float] = field(default_factory=dict)
    cutter_diameter_mm: float = 10.0
    block_mm: tuple[float, float, float] = (340.0, 130.0, 40.0)

    def with_rule(self, name: CheckName, policy: Policy, limit: float | None = None) -> ExportRules:
        """Take one check more or less strictly; a check without a limit keeps having none."""
        limits = self.limits if limit is None else {**self.limits, name: limit}
        return replace(self, policies={**self.policies, name: policy}, limits=limits)

    def with_cutter(self, diameter_mm: float) -> ExportRules:
        """Hold hollows against another cutter.

        Raises
        ------
        InputError
            When no cutter is that large or small.
        """
        if not _LEAST_CUTTER_MM <= diameter_mm <= _GREATEST_CUTTER_MM:
            raise InputError(
                "A cutter of {diameter_mm:g} mm is asked for, and must be {least_mm:g} to "
                "{most_mm:g} mm; give another diameter.",
                diameter_mm=diameter_mm,
                least_mm=_LEAST_CUTTER_MM,
                most_mm=_GREATEST_CUTTER_MM,
            )
        return replace(self, cutter_diameter_mm=diameter_mm)

    def only(self, names: Collection[CheckName]) -> ExportRules:
        """Switch the other checks off."""
        return replace(self, policies={k: v for k, v in self.policies.items() if k in names})


def read_rules(path: Path | None = None) -> ExportRules:
    """Read rules, by default those that come with the product.

    Raises
    ------
    InputError
        Names the file and the key that is missing or wrong.
    """
    path = path or resource_path("rules/export.json")
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(
            "{path} cannot be read: {reason}; check its name.",
            path=path,
            reason=str(error.strerror),
        ) from error
    except (ValueError, RecursionError) as error:
        raise InputError("{path} is no valid JSON; write the rules anew.", path=path) from error
    if not isinstance(content, dict) or (content.get("format"), content.get("version")) != (
        FORMAT, VERSION,
    ):  # fmt: skip
        raise InputError(
            '{path} holds no export rules; "format" must be "{format}", version 1.',
            path=path,
            format=FORMAT,
        )
    rules = content.get("rules")
    if not isinstance(rules, dict) or not rules.keys() <= set(CHECK_NAMES):
        raise InputError(
            '"rules" in {path} must name checks of: {checks}.',
            path=path,
            checks=joined(CHECK_NAMES),
        )
    return _parsed(rules, path)


def write_rules(rules: ExportRules, path: Path) -> None:
    """Write rules as `read_rules` reads them.

    Raises
    ------
    OutputError
        When the place cannot be written.
    """
    content: dict[str, dict[str, Any]] = {
        name: {"policy": policy} for name, policy in rules.policies.items()
    }
    for name, limit in rules.limits.items():
        content.setdefault(name, {"policy": "off"})["limit"] = limit
    content.setdefault("cutter", {"policy": "off", "limit": 0.0})
    content["cutter"]["cutter_diameter_mm"] = rules.cutter_diameter_mm
    content.setdefault("block", {"policy": "off"})["size_mm"] = list(rules.block_mm)
    text = json.dumps({"format": FORMAT, "version": VERSION, "rules": content}, indent=1)
    with replacing_file(path) as beside:
        beside.write_text(text + "\n", encoding="utf-8")


def _parsed(rules: dict[CheckName, Any], path: Path) -> ExportRules:
    policies: dict[CheckName, Policy] = {}
    limits: dict[CheckName, float] = {}
    for name, rule in rules.items():
        if not isinstance(rule, dict) or rule.get("policy") not in get_args(Policy):
            raise InputError(
                'The policy of "{name}" in {path} must be "blocking", "warning" or "off".',
                name=name,
                path=path,
            )
        policies[name] = rule["policy"]
        if name not in ("watertight", "block"):
            limits[name] = _number(
                rule.get("limit"), Message('limit of "{check}"', check=name), path
            )
    diameter = rules.get("cutter", {}).get("cutter_diameter_mm", ExportRules.cutter_diameter_mm)
    size = rules.get("block", {}).get("size_mm", list(ExportRules.block_mm))
    if not isinstance(size, list) or len(size) != 3:
        raise InputError(
            "size_mm of the block in {path} must be [length, width, height].", path=path
        )
    length, width, height = (_number(value, "size_mm of the block", path) for value in size)
    return ExportRules(
        policies, limits, _number(diameter, "cutter_diameter_mm", path), (length, width, height)
    )


def _number(value: Any, what: str, path: Path) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise InputError("The {what} in {path} must be a number.", what=what, path=path)
    if not (math.isfinite(value) and 0 <= value <= 1000):
        raise InputError(
            "The {what} in {path} is {value:g}, and must be 0 to 1000.",
            what=what,
            path=path,
            value=value,
        )
    return float(value)
