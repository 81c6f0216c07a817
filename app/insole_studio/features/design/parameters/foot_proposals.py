"""Parameters that concern the foot: its pose, pen marks, a proposed posting."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from weakref import WeakKeyDictionary

from insole_core.cases.case_record import Annotations, KeyPoint
from insole_core.errors import InputError
from insole_core.foot.alignment import PoseAngles, pose_angles
from insole_core.foot.foot import Foot
from insole_core.foot.measures import measure
from insole_core.insole.clinic_rules import ClinicRules, proposed_post_deg
from insole_core.insole.elements import Pelott, Posting, new_id
from insole_core.insole.fields import Range
from insole_core.workflows.foot_landmarks import (
    PenMark,
    PenMarks,
    landmarks_of,
    levelled_record,
    quarter_turned_record,
    turned_record,
)
from insole_studio.document.case import Case
from insole_studio.features.design.correction_names import name_of, place_text
from insole_studio.features.design.rows import FieldGroup, FieldSpec, Proposal
from insole_studio.features.design.tools.key_point_tool import point_text
from insole_studio.features.design.tools.posting_tool import posting_of
from insole_studio.texts import localised, tr, translate_core_message

_ANGLE = Range(-45, 45, "degrees")


class FootProposals:
    """The field groups of the landmark and posting tools, and the actions of their buttons."""

    def __init__(self, case: Case, rules: ClinicRules, pelott: Pelott) -> None:
        self._case = case
        self._rules = rules
        self._pelott = pelott
        self._marks = PenMarks()
        self._measured: WeakKeyDictionary[Foot, tuple[Annotations, float | None]] = (
            WeakKeyDictionary()
        )

    def landmark_groups(self) -> list[FieldGroup]:
        """Return the pose of the foot, and each pen mark with the landmarks it may stand for."""
        marks = self._marks.of(self._case.record)
        groups = (self._mark_group(number, mark) for number, mark in enumerate(marks))
        return [_confirm_group(), self._pose_group(), *groups]

    def pose_groups(self) -> list[FieldGroup]:
        """Return the groups of the pose of the foot, small angles and right ones."""
        return [self._pose_group(), _quarter_group()]

    def posting_note(self) -> str:
        """Return the angle of the Achilles axis to the sole as text; empty if not scanned."""
        lean = self._eversion_deg()
        if lean is None:
            return ""
        kind = tr("valgus") if lean > 0 else tr("varus")
        return tr("Achilles axis {angle}° {kind} to the sole").format(
            angle=localised(abs(lean)), kind=kind
        )

    def posting_offers(self) -> tuple[Proposal, ...]:
        """Return the posting suggested by the clinic's rule, unless it is already prescribed."""
        proposed, design = self._proposed_deg(), self._case.record.design
        posting = None if design is None else posting_of(design)
        if not proposed or (posting is not None and posting.rearfoot_deg == proposed):
            return ()
        text = tr("Propose {angle}° medial").format(angle=localised(proposed, "g"))
        tip = tr("Post the rearfoot as the rule of the clinic suggests for this axis")
        return (Proposal("propose.post", text, tip),)

    def choose(self, kind: str, name: str) -> bool:
        """Run a button's action; return False if the button belongs to another presenter."""
        act = _ACTS.get(kind)
        if act is not None:
            act(self, name)
        return act is not None

    def turn(self, name: str, value: float) -> None:
        """Set one pose angle of the foot, degrees."""
        record = self._case.record
        if record.foot is not None:
            angles = pose_angles(record.foot, landmarks_of(record))
            self._lay(replace(angles, **{name: value}), tr("Turn the foot"), f"pose:{name}")

    def _align(self, _name: str) -> None:
        self._lay(PoseAngles(), tr("Align the foot by the landmarks"))

    def _lay(self, angles: PoseAngles, sentence: str, merge_key: str = "") -> None:
        """Set the pose angles of the foot.

        Parameters
        ----------
        angles
            The new pose angles.
        sentence
            Description of the undo step.
        merge_key
            Consecutive steps with the same key become one; empty for never.
        """
        if self._case.foot is not None:
            self._case.apply(turned_record(self._case.record, angles), sentence, merge_key)

    def _quarter(self, name: str) -> None:
        axis, quarters = (int(number) for number in name.split("."))
        if self._case.foot is not None:
            foot = quarter_turned_record(self._case.record, axis, quarters)
            self._case.apply(foot, tr("Turn the foot by 90°"))

    def _level(self, _name: str) -> None:
        if self._case.foot is not None:
            self._case.apply(levelled_record(self._case.record), tr("Level the sole"))

    def _propose(self, _name: str) -> None:
        design = self._case.record.design
        if design is not None:
            before = posting_of(design) or self._case.stamped(Posting())
            posting = replace(before, rearfoot_deg=self._proposed_deg(), enabled=True)
            self._case.apply(design.with_set(posting), tr("Take the proposed posting"))

    def _use_mark(self, name: str) -> None:
        number, _, meaning = name.partition(".")
        point = self._marks.of(self._case.record)[int(number)].mark.point
        place = (round(float(point[0]), 2), round(float(point[1]), 2), round(float(point[2]), 2))
        marked = self._case.record.annotations.with_key_point(KeyPoint(meaning, place))
        sentence = tr("Use a pen mark as: {name}").format(name=point_text(meaning))
        self._case.apply(marked, sentence)

    def _pad_at_mark(self, name: str) -> None:
        design = self._case.record.design
        if design is None:
            return
        point = self._marks.of(self._case.record)[int(name)].mark.point
        centre = (round(float(point[0]), 1), round(float(point[1]), 1))
        pad = self._case.stamped(replace(self._pelott, id=new_id(), centre_mm=centre))
        self._case.apply(design.with_added(pad), tr("Place: {name}").format(name=name_of(pad)))
        self._case.select(pad.id)

    def _pose_group(self) -> FieldGroup:
        title, record = tr("Foot against its landmarks"), self._case.record
        assert record.foot is not None
        try:
            angles = pose_angles(record.foot, landmarks_of(record))
        except InputError as error:
            return FieldGroup(title, note=translate_core_message(str(error)))
        fields = (
            _field(
                "pose.roll_deg", tr("Medial edge up"), angles.roll_deg,
                tr("How far the foot is rolled onto its lateral edge"),
            ),
            _field(
                "pose.pitch_deg", tr("Toe end up"), angles.pitch_deg,
                tr("How far the ball lies higher than the heel"),
            ),
            _field(
                "pose.yaw_deg", tr("Toes medially"), angles.yaw_deg,
                tr("How far the foot is turned on the ground, the toes to the medial side"),
            ),
        )  # fmt: skip
        tip = tr("Level the sole and lay the foot axis along the insole by the landmarks")
        return FieldGroup(title, fields, (Proposal("align.", tr("Align"), tip),))

    def _mark_group(self, number: int, found: PenMark) -> FieldGroup:
        side = self._case.shown.side
        assert side is not None, "marks are found on a foot"
        x, y, _ = found.mark.point
        title = tr("Pen mark: {place}").format(place=place_text(side, x, y))
        uses = [
            Proposal(f"mark.{number}.{name}", tr("Use as {name}").format(name=point_text(name)))
            for name in found.meanings
        ]
        return FieldGroup(title, offers=(*uses, Proposal(f"mark_pad.{number}", tr("Pelott here"))))

    def _eversion_deg(self) -> float | None:
        record = self._case.record
        if record.foot is None:
            return None
        kept = self._measured.get(record.foot)
        if kept is None or kept[0] != record.annotations:
            angle = measure(record.foot, landmarks_of(record))["achilles_angle_deg"]
            kept = self._measured[record.foot] = record.annotations, angle
        return kept[1]

    def _proposed_deg(self) -> float:
        eversion = self._eversion_deg()
        return 0.0 if eversion is None else proposed_post_deg(eversion, self._rules.pronation)


def _confirm_group() -> FieldGroup:
    tip = tr("Take all landmarks as they are shown")
    return FieldGroup(
        tr("Landmarks"), (), (Proposal("action.confirm_landmarks", tr("Confirm landmarks"), tip),)
    )


def _quarter_group() -> FieldGroup:
    """Return what helps a scan that was placed wrongly; the landmarks are found again."""
    turns = (
        ("0.1", tr("Toes up 90°"), tr("Tip the foot over its heel")),
        ("0.-1", tr("Toes down 90°"), tr("Tip the foot over its toes")),
        ("1.1", tr("Roll 90°"), tr("Roll the foot over its edge")),
        ("2.1", tr("Turn 90°"), tr("Turn the foot on the ground, to the left")),
    )
    offers = tuple(Proposal(f"quarter.{name}", text, tip) for name, text, tip in turns)
    tip = tr("Lay a foot that lies roughly right on its sole, and its axis along the insole")
    return FieldGroup(
        tr("If the scan lies wrongly"), (), (*offers, Proposal("level.", tr("Level the sole"), tip))
    )


def _field(key: str, label: str, value: float, tip: str) -> FieldSpec:
    shown = round(value, 1) + 0.0
    return FieldSpec(key, label, "°", shown, _ANGLE.least, _ANGLE.greatest, 0.5, tip=tip)


_ACTS: dict[str, Callable[[FootProposals, str], None]] = {
    "align": FootProposals._align,
    "level": FootProposals._level,
    "quarter": FootProposals._quarter,
    "propose": FootProposals._propose,
    "mark": FootProposals._use_mark,
    "mark_pad": FootProposals._pad_at_mark,
}
