"""What can be chosen in the list of devices and findings, and how it is found by typing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial

from insole_core.folded_text import fold
from insole_core.foot.foot import Foot
from insole_core.insole.forms.form_surface import check_length
from insole_core.insole.prescription.base_form import BaseForm, Form
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.device import Device
from insole_core.workflows.findings import Finding
from insole_core.workflows.named_files import Listed
from insole_studio.texts import tr, translate_core_message


class Kind(Enum):
    """The groups of the list, in its order."""

    DEVICE = "device"
    FINDING = "finding"
    FORM = "form"


@dataclass(frozen=True, eq=False)
class Choice:
    """Something that can be applied to a design.

    Parameters
    ----------
    name
        In the language of the window.
    words
        Further words by which it is found.
    notes
        Sentences about it, the source last.
    apply
        Returns the changed design; raises a `DesignError` where it does not fit.
    is_own
        Whether it is the clinic's own.
    """

    kind: Kind
    key: str
    name: str
    words: tuple[str, ...]
    notes: tuple[str, ...]
    apply: Callable[[InsoleDesign], InsoleDesign]
    is_own: bool = False


def device_choices(
    devices: Listed[Device], apply: Callable[[Device, InsoleDesign], InsoleDesign]
) -> Iterator[Choice]:
    """Yield the devices.

    Parameters
    ----------
    apply
        Returns the design as one of a device.
    """
    for key, device in devices.items.items():
        yield Choice(
            Kind.DEVICE,
            f"device:{key}",
            translate_core_message(device.name),
            (device.name, *map(translate_core_message, device.keywords), *device.keywords),
            source_notes(device.source),
            partial(apply, device),
            key in devices.own,
        )


def form_choices(forms: Listed[Form], foot: Foot | None) -> Iterator[Choice]:
    """Yield the base forms, and the foot itself.

    Parameters
    ----------
    foot
        Whose insole is to start from a form.
    """
    yield Choice(
        Kind.FORM,
        "form:",
        tr("The foot itself"),
        (tr("total contact"),),
        (tr("The insole follows the sole of the foot everywhere: total contact."),),
        _on_foot,
    )
    kept = tr(
        "It holds the pads and corrections of the insole that it was kept from; those of this "
        "design come on top."
    )
    for key, form in forms.items.items():
        is_own = key in forms.own
        yield Choice(
            Kind.FORM,
            f"form:{key}",
            translate_core_message(form.name),
            (form.name,),
            (*((kept,) if is_own else ()), *source_notes(form.source)),
            partial(_on_form, form, foot),
            is_own,
        )


def finding_choices(
    findings: Listed[Finding], apply: Callable[[Finding, InsoleDesign], InsoleDesign]
) -> Iterator[Choice]:
    """Yield the findings.

    Parameters
    ----------
    apply
        Returns the design with what is proposed for a finding.
    """
    for key, finding in findings.items.items():
        advice = (translate_core_message(finding.advice),) if finding.advice else ()
        yield Choice(
            Kind.FINDING,
            f"finding:{key}",
            translate_core_message(finding.name),
            (finding.name, *map(translate_core_message, finding.keywords), *finding.keywords),
            (*advice, *source_notes(finding.source)),
            partial(apply, finding),
            key in findings.own,
        )


def matching(choices: Sequence[Choice], text: str) -> list[Choice]:
    """Return the choices that hold every typed word, those whose name begins with it first."""
    wanted = fold(text).split()
    found = [c for c in choices if all(word in _searched(c) for word in wanted)]
    kinds = list(Kind)
    return sorted(found, key=lambda c: (kinds.index(c.kind), not _begins(c, wanted)))


def source_notes(source: str) -> tuple[str, ...]:
    """Return the note that names a source; none without one."""
    said = translate_core_message(source)
    return (tr("Source: {source}").format(source=said),) if source else ()


def _on_foot(design: InsoleDesign) -> InsoleDesign:
    return replace(design, base=None)


def _on_form(form: Form, foot: Foot | None, design: InsoleDesign) -> InsoleDesign:
    """Return the design on a form, mixed with the foot as much as the one before."""
    if foot is not None:
        check_length(form, foot)
    base = BaseForm(form=form) if design.base is None else replace(design.base, form=form)
    return replace(design, base=base)


def _searched(choice: Choice) -> str:
    return fold(" ".join((choice.name, *choice.words)))


def _begins(choice: Choice, wanted: Sequence[str]) -> bool:
    return not wanted or fold(choice.name).startswith(wanted[0])
