"""Rules of workshop and clinic for what may be exported: resources/rules/export.json."""

from __future__ import annotations

import json
from collections.abc import Collection
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args

from insole_core.errors import InputError
from insole_core.files.atomic import write_text
from insole_core.json_object import JsonObject
from insole_core.messages import joined
from insole_core.resources import resource_path

FORMAT, VERSION = "insole-export-rules", 1
Policy: TypeAlias = Literal["blocking", "warning", "off"]
CheckName: TypeAlias = Literal[
    "watertight", "thickness", "cutter", "undercut", "step", "block", "shoe_height", "grid"
]
LEAST_CUTTER_MM, GREATEST_CUTTER_MM = 1.0, 40.0
_GREATEST = 1000
CHECK_NAMES: tuple[CheckName, ...] = get_args(CheckName)
_WITHOUT_LIMIT = ("watertight", "block")


@dataclass(frozen=True)
class ExportRules:
    """Policy and limit of every check.

    Parameters
    ----------
    policies
        Checks that are not named are off.
    limits
        Thickness: least, mm. Cutter: most material left in hollows, mm. Undercut: most area, mm².
        Step: most rise over 1 mm, mm. Shoe height: greatest height of the insole, mm. Grid:
        greatest distance of the points that the surface is computed at, mm.
    cutter_diameter_mm
        Of the ball-nose cutter.
    block_mm
        Length, width, height of the stock; None where no block is chosen, so that none is checked.
    """

    policies: dict[CheckName, Policy] = field(default_factory=dict)
    limits: dict[CheckName, float] = field(default_factory=dict)
    cutter_diameter_mm: float = 10.0
    block_mm: tuple[float, float, float] | None = (340.0, 130.0, 40.0)

    def with_rule(self, name: CheckName, policy: Policy, limit: float | None = None) -> ExportRules:
        """Return the rules with another policy, and if given another limit, for one check.

        Parameters
        ----------
        limit
            In the unit of the check, see `limits`; None keeps the present one.
        """
        limits = self.limits if limit is None else {**self.limits, name: limit}
        return replace(self, policies={**self.policies, name: policy}, limits=limits)

    def for_maker(self, cutter_mm: float | None, *, is_printed: bool) -> ExportRules:
        """Return the rules for a printer, which leaves nothing in hollows, or for a router.

        Parameters
        ----------
        cutter_mm
            Diameter of the router's finishing cutter; None for the one of the rules.
        """
        if is_printed:
            return self.with_rule("cutter", "off")
        return self if cutter_mm is None else self.with_cutter(cutter_mm)

    def with_cutter(self, diameter_mm: float) -> ExportRules:
        """Return the rules for another ball-nose cutter.

        Raises
        ------
        InputError
            If the diameter is out of range.
        """
        if not LEAST_CUTTER_MM <= diameter_mm <= GREATEST_CUTTER_MM:
            raise InputError(
                "A cutter of {diameter_mm:g} mm is asked for, and must be {least_mm:g} to "
                "{most_mm:g} mm; give another diameter.",
                diameter_mm=diameter_mm,
                least_mm=LEAST_CUTTER_MM,
                most_mm=GREATEST_CUTTER_MM,
            )
        return replace(self, cutter_diameter_mm=diameter_mm)

    def only(self, names: Collection[CheckName]) -> ExportRules:
        """Return the rules with all other checks switched off."""
        return replace(self, policies={k: v for k, v in self.policies.items() if k in names})


def read_rules(path: Path | None = None) -> ExportRules:
    """Read rules, by default those shipped with the product.

    Raises
    ------
    InputError
        Naming the file and the key that is missing or wrong.
    """
    root = JsonObject.read(path or resource_path("rules/export.json"))
    root.check_format(FORMAT, VERSION)
    rules = root.object("rules")
    policies: dict[CheckName, Policy] = {}
    limits: dict[CheckName, float] = {}
    further: dict[str, Any] = {}
    for key in rules.values:
        if key not in CHECK_NAMES:
            raise rules.fail(
                key, "is no check; those are {check_names}", check_names=joined(CHECK_NAMES)
            )
    for name in filter(rules.has, CHECK_NAMES):
        rule = rules.object(name)
        policies[name] = rule.choice("policy", get_args(Policy))
        if name not in _WITHOUT_LIMIT:
            limits[name] = rule.number("limit", 0, _GREATEST)
        if name == "cutter" and rule.has("cutter_diameter_mm"):
            further["cutter_diameter_mm"] = rule.number("cutter_diameter_mm", 0, _GREATEST)
        if name == "block" and rule.has("size_mm"):
            further["block_mm"] = rule.numbers("size_mm", 3, 0, _GREATEST)
    return ExportRules(policies, limits, **further)


def write_rules(rules: ExportRules, path: Path) -> None:
    """Write rules in the format of `read_rules`.

    Raises
    ------
    OutputError
        If the path cannot be written.
    """
    content: dict[str, dict[str, Any]] = {
        name: {"policy": policy} for name, policy in rules.policies.items()
    }
    for name, limit in rules.limits.items():
        content.setdefault(name, {"policy": "off"})["limit"] = limit
    content.setdefault("cutter", {"policy": "off", "limit": 0.0})
    content["cutter"]["cutter_diameter_mm"] = rules.cutter_diameter_mm
    if rules.block_mm is not None:
        content.setdefault("block", {"policy": "off"})["size_mm"] = list(rules.block_mm)
    text = json.dumps({"format": FORMAT, "version": VERSION, "rules": content}, indent=1)
    write_text(text + "\n", path)
