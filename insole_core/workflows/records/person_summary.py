"""The record of a person to read and to print, without any program of ours."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from matplotlib.figure import Figure

from insole_core.cases.case_record import Variant
from insole_core.evaluation.report import Plot, Report, ReportSection, Table
from insole_core.export.paper import paper_texts
from insole_core.foot.measures import DEFINITIONS
from insole_core.foot.spread import Spread, explained, number_text, spread_text
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.height_map import HeightMap
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.messages import Message, Translate
from insole_core.records.author import program_version, utc_now
from insole_core.records.capture import Capture
from insole_core.records.order import Order
from insole_core.records.person import Person
from insole_core.records.photo import Photo
from insole_core.records.prescription import VersionSummary
from insole_core.records.record_field import told_fields
from insole_core.records.visit import Visit
from insole_core.records.visit_measures import StoredMeasure, stored_measures
from insole_core.solids.checks import survey_side
from insole_core.workflows.records.person_dossier import PersonDossier, VisitDossier

_SOLE_MM = 40.0
"""What is higher of a foot is no longer the sole."""


@dataclass(frozen=True)
class Wording:
    """The language of a summary.

    Parameters
    ----------
    language
        Such as "en".
    translate
        Into that language.
    """

    language: str = "en"
    translate: Translate = str


ENGLISH: Final = Wording()


@dataclass(frozen=True)
class _Texts:
    """The texts of the summary in its language; what a person has typed is never translated."""

    texts: Mapping[str, str]
    translate: Translate

    def __getitem__(self, key: str) -> str:
        return self.texts[key]


@dataclass(frozen=True, eq=False)
class Relief:
    """One side of a surface.

    Parameters
    ----------
    heights_mm : (ny, nx) float64
        On pixels of 1 mm; NaN beside the surface.
    first_mm
        x and y of the centre of the pixel [0, 0].
    """

    heights_mm: FloatArray
    first_mm: tuple[float, float]

    @property
    def extent_mm(self) -> tuple[float, float, float, float]:
        """Left, right, lower and upper edge, as plots take them."""
        return HeightMap(self.heights_mm, self.heights_mm, self.first_mm).extent_mm


def relief_of(mesh: TriangleMesh, *, from_above: bool) -> Relief:
    """Return one side of a surface, from a view along z."""
    return Relief(*survey_side(mesh, from_above=from_above))


@dataclass(frozen=True, eq=False)
class FootPicture:
    """What is told and drawn of one foot on one visit, without its surface, which is large.

    Parameters
    ----------
    variant
        The chosen one of the newest version.
    sole
        The foot from below.
    insole
        The solid from above; None where it cannot be made.
    """

    side: Side
    variant: Variant
    sole: Relief
    insole: Relief | None


def person_report(
    dossier: PersonDossier,
    pictures: Mapping[str, Sequence[FootPicture]],
    files: Sequence[str],
    left_out: Sequence[str],
    wording: Wording = ENGLISH,
) -> Report:
    """Return the record of a person as a report, the newest visit first.

    Parameters
    ----------
    pictures
        By the id of a visit, the left foot first.
    files
        Paths within the folder, with what tells the files apart.
    left_out
        A sentence for each thing that could not be exported.
    wording
        The language of the report.

    Raises
    ------
    InputError
        When the texts of the paper cannot be read.
    """
    translate = wording.translate
    texts = _Texts(paper_texts("person_summary", translate), translate)
    visits = [
        _visit_section(visit, pictures.get(visit.visit.id, ()), texts)
        for visit in reversed(dossier.visits)
    ]
    orders = [line for order in dossier.orders for line in _order_lines(order, texts)]
    follow_ups = [
        line
        for follow_up in dossier.follow_ups
        for line in _lines(f"{follow_up.on_date}: {follow_up.outcome}", follow_up.notes)
    ]
    not_there = list(map(translate, left_out))
    lists = {"orders": orders, "follow_ups": follow_ups, "left_out": not_there, "files": files}
    sections = [_section("person", texts["person"], _field_lines(dossier.person, texts)), *visits]
    sections += [_section(key, texts[key], lines) for key, lines in lists.items() if lines]
    sections.append(_section("program", texts["program"], [f"Insole Studio {program_version()}"]))
    return Report(texts["title"], "", utc_now(), tuple(sections), wording.language, texts["page"])


def _section(key: str, title: str, lines: Iterable[str]) -> ReportSection:
    return ReportSection(key, title, sentences=tuple(lines))


def _field_lines(value: Person | Visit, texts: _Texts) -> list[str]:
    """Return what was filled in, each field with its label in front."""
    lines: list[str] = []
    for field, said in told_fields(value):
        first, *others = (texts.translate(said) if isinstance(said, Message) else said).splitlines()
        lines += [f"{texts.translate(field.label)}: {first}", *others]
    return lines


def _visit_section(
    dossier: VisitDossier, pictures: Sequence[FootPicture], texts: _Texts
) -> ReportSection:
    visit = dossier.visit
    day = visit.visited_on.isoformat()
    lines = _field_lines(visit, texts)
    for picture in pictures:
        version = dossier.newest(picture.side)
        if version is not None:
            lines += _prescription_lines(picture.variant, version, dossier, texts)
    lines += [line for capture in dossier.captures for line in _capture_lines(capture, texts)]
    lines += [line for photo in dossier.photos for line in _photo_lines(photo, texts)]
    measures = stored_measures(visit.measures)
    rows = tuple((_measure_name(one, texts), _measure_text(one, texts)) for one in measures)
    lines += [texts.translate(said) for said in explained(_spreads(measures))]
    tables = (Table(texts["measures"], (texts["measure"], texts["value"]), rows),) if rows else ()
    plots = (_plot(pictures, texts),) if pictures else ()
    title = texts["visit"].replace("{day}", day)
    return ReportSection(visit.id, title, sentences=tuple(lines), tables=tables, plots=plots)


def _capture_lines(capture: Capture, texts: _Texts) -> list[str]:
    facts = capture.facts
    day = (facts.recorded_at or capture.created_at)[:16].replace("T", " ")
    head = f"{texts['captures']}: {capture.file_name}, {day} UTC"
    stored = f"– SHA-256 {capture.content_sha256}"
    if not facts.sensor_serials:
        return [head, stored]
    calibrated = facts.calibrated_on[:10] or texts["not recorded"]
    return [
        head,
        stored,
        f"– {texts['sensors']}: {', '.join(facts.sensor_serials)}",
        f"– {texts['calibrated']}: {calibrated}",
        *(f"– {texts.translate(line)}" for line in facts.residual_lines),
    ]


def _photo_lines(photo: Photo, texts: _Texts) -> list[str]:
    head = f"{texts['photo']} {photo.number}"
    marks = enumerate(photo.marks, start=1)
    return [
        ": ".join(filter(None, (head, photo.caption))),
        *(f"– {n}: {' '.join(mark.text.split())}" for n, mark in marks if mark.text),
    ]


def _prescription_lines(
    variant: Variant, version: VersionSummary, dossier: VisitDossier, texts: _Texts
) -> list[str]:
    head = [_filled(texts["variant"], name=variant.name), _version_text(version, texts)]
    scans = (c.file_name for c in dossier.captures if c.id == version.capture_id)
    made = [_filled(texts["version_program"], version=version.program_version)]
    made += [_filled(texts["version_scan"], name=name) for name in scans]
    made += [_filled(texts["signature"], signature=version.signature)] if version.signature else []
    facts = (
        f"{texts.translate(name)} {texts.translate(value)}"
        for name, value in make_facts(variant.design).items()
    )
    return [
        f"{texts[str(version.side)]}: {', '.join(head)}",
        *(f"– {texts.translate(line)}" for line in correction_lines(variant.design)),
        f"– {'; '.join(facts)}",
        f"– {', '.join(made)}",
        *(f"– {line}" for line in _earlier_lines(version, dossier, texts)),
    ]


def _earlier_lines(newest: VersionSummary, dossier: VisitDossier, texts: _Texts) -> Iterator[str]:
    """Yield who made the versions before, when, and why they were changed."""
    for version in dossier.versions:
        if version.side is newest.side and version.id != newest.id:
            yield ": ".join(filter(None, (_version_text(version, texts), version.reason)))


def _version_text(version: VersionSummary, texts: _Texts) -> str:
    day = version.changed_at[:10]
    text = _filled(texts["version"], number=str(version.number), day=day, author=version.author)
    if version.signed_by and version.signed_at:
        signed = _filled(texts["signed"], name=version.signed_by, day=version.signed_at[:10])
        return f"{text}, {signed}"
    return text


def _order_lines(order: Order, texts: _Texts) -> list[str]:
    due = [] if order.due_on is None else [_filled(texts["due"], day=order.due_on.isoformat())]
    state = texts.translate(str(order.state))
    head = [order.number, state, order.shop, *due, order.remarks]
    events = (
        _lines(
            f"– {event.at[:10]}: {texts.translate(str(event.to_state))}, {event.author}",
            event.remarks,
        )
        for event in order.events
    )
    return [", ".join(filter(None, head)), *(line for lines in events for line in lines)]


def _measure_name(measure: StoredMeasure, texts: _Texts) -> str:
    """Return the name of a measure such as ``left_foot_length_mm``."""
    unit = ", mm" if measure.key.endswith("_mm") else ""
    name = texts.translate(measure.key.removesuffix("_mm").replace("_", " "))
    side = "" if measure.side is None else f"{texts.translate(str(measure.side))}, "
    return f"{side}{name}{unit}"


def _spreads(measures: Iterable[StoredMeasure]) -> Iterator[Spread]:
    """Yield the ± that are written: what the clinic measured in its own way has none."""
    return (one.spread for one in measures if one.name in DEFINITIONS)


def _measure_text(measure: StoredMeasure, texts: _Texts) -> str:
    if measure.name not in DEFINITIONS:
        return texts.translate(Message("{value:g}", value=measure.value))
    value = number_text(measure.name, measure.value)
    limits = spread_text(measure.name, measure.spread.limits_95)
    return texts.translate(Message("{value} {limits}", value=value, limits=limits))


def _lines(head: str, text: str) -> list[str]:
    return [head, *text.splitlines()]


def _filled(text: str, **values: str) -> str:
    """Replace names in braces; other braces of the clinic's text stay."""
    for key, value in values.items():
        text = text.replace(f"{{{key}}}", value)
    return text


def _plot(pictures: Sequence[FootPicture], texts: _Texts) -> Plot:
    return Plot(texts["feet and insoles"], partial(_draw, pictures=tuple(pictures), texts=texts))


def _draw(figure: Figure, *, pictures: Sequence[FootPicture], texts: _Texts) -> None:
    """Draw the feet and then the insoles, the left one on the left, both to one scale."""
    insoles = [(p.side, p.insole) for p in pictures if p.insole is not None]
    highest_mm = max((float(np.nanmax(i.heights_mm)) for _, i in insoles), default=0.0)
    reliefs = [(f"{p.side} foot", p.sole, _SOLE_MM) for p in pictures]
    reliefs += [(f"{side} insole", insole, highest_mm) for side, insole in insoles]
    for axes, (title, relief, most_mm) in zip(
        figure.subplots(1, len(reliefs), squeeze=False)[0], reliefs, strict=True
    ):
        image = axes.imshow(
            relief.heights_mm,
            origin="lower",
            cmap="viridis",
            extent=relief.extent_mm,
            vmin=0,
            vmax=most_mm,
        )
        axes.set_title(texts[title], fontsize=8)
        axes.tick_params(labelsize=6)
        figure.colorbar(image, ax=axes, shrink=0.7).ax.tick_params(labelsize=6)
