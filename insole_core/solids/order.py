"""An order to the workshop, and the part made from it: solid, marked, reduced, checked."""

from __future__ import annotations

from dataclasses import dataclass, replace

from insole_core.errors import DesignError
from insole_core.export.lettering import missing_letters
from insole_core.foot.landmarks import Landmarks, find_landmarks
from insole_core.formats.solid_content import SolidPart
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.insole.build import Insole
from insole_core.insole.clinic_rules import load_rules
from insole_core.insole.prescription.materials import MaterialTable
from insole_core.insole.warnings.design_warnings import design_warnings
from insole_core.messages import Message
from insole_core.progress import SILENT, Progress
from insole_core.solids.checks import Finding, check_solid
from insole_core.solids.export_rules import CHECK_NAMES, CheckName, ExportRules, Policy
from insole_core.solids.layers import layer_parts
from insole_core.solids.marking import Relief, mark
from insole_core.solids.nesting import Nest, closest_nest, nest_pair
from insole_core.solids.shell_body import INSET_MM, least_thickness, post_length_mm
from insole_core.solids.shop import Shop
from insole_core.solids.simplification import Simplified, simplify
from insole_core.solids.solid import DEFAULT_OPTIONS, Kind, SolidOptions, edge_notes, make_solid

CHECKS_OF: dict[Kind, tuple[CheckName, ...]] = {
    "insole": CHECK_NAMES,
    "block": ("watertight", "thickness", "cutter", "step", "block", "grid"),
    "positive": ("watertight", "undercut", "grid"),
}
MARK_AT, MARK_ROOM = 0.35, (30.0, 0.5)
"""Under the heel, where every insole's bottom is wide and complete: shares of the length, mm. On a
cupped shell it is the rearfoot post."""


@dataclass(frozen=True)
class Order:
    """The order of one part: its kind, shape, marking and reduction.

    Parameters
    ----------
    mark
        Lines of identification; empty for none.
    relief
        "engraved" into the bottom, or "raised" from it.
    most_triangles, most_deviation_mm
        Target of the reduction, and its greatest distance from the surface; None for no reduction.
    layered
        Whether cover, middle layer and base are separate objects, where the format allows it.
    """

    kind: Kind = "insole"
    options: SolidOptions = DEFAULT_OPTIONS
    mark: tuple[str, ...] = ()
    relief: Relief = "engraved"
    most_triangles: int | None = None
    most_deviation_mm: float = 0.05
    layered: bool = False


@dataclass(frozen=True, eq=False)
class Part:
    """The finished solid of an order, with its checks.

    Parameters
    ----------
    insole, order
        From which it was made.
    solid : mm, insole frame
    deviation_mm
        Greatest measured deviation by the reduction; 0 without one.
    findings
        Of the checks.
    landmarks : insole frame
        Of the foot, with those that were set by hand.
    warnings
        What is unusual about the design, a sentence each: those that the design shows too.
    notes
        What the customer should know beyond the checks, one sentence each.
    told
        What was ticked to stand on the papers beside the design, one sentence each.
    """

    insole: Insole
    order: Order
    solid: TriangleMesh
    deviation_mm: float
    findings: tuple[Finding, ...]
    landmarks: Landmarks
    warnings: tuple[Message, ...] = ()
    notes: tuple[str, ...] = ()
    told: tuple[Message, ...] = ()

    @property
    def side(self) -> Side:
        """Which foot it is for."""
        return self.insole.design.side

    @property
    def name(self) -> str:
        """Name the object in a file: side and kind."""
        return f"{self.side} {self.order.kind}"

    def layers(self, shop: Shop) -> tuple[SolidPart, ...]:
        """Return the objects of the file."""
        if self.order.layered and self.order.kind == "insole":
            return layer_parts(self.insole, self.solid, shop.layers, self.name)
        return (SolidPart(self.solid, self.name),)


def make_part(
    insole: Insole,
    order: Order,
    rules: ExportRules,
    progress: Progress = SILENT,
    *,
    landmarks: Landmarks | None = None,
    materials: MaterialTable | None = None,
) -> Part:
    """Make the solid of an insole, mark it, reduce its triangles, and check it.

    Parameters
    ----------
    rules
        Only the checks in `CHECKS_OF` for this kind are made. An insole with a shell is at least as
        thick as its material needs, too.
    landmarks
        By default those that are found on the foot.
    materials
        Of the clinic, for the warnings; by default those of the product.

    Returns
    -------
    Part
        Its solid is in mm; failed checks are among its findings and do not raise.

    Raises
    ------
    DesignError
        If the solid, its lettering, or the target of triangles is impossible.
    """
    plain = make_solid(insole, order.kind, order.options, progress.part(0.0, 0.3))
    _require_known_letters(order)
    progress.step(0.3, "Writing the identification")
    marked = _marked(plain, insole, order)
    progress.step(0.4, "Reducing the triangles")
    simple = _reduced(marked, order)
    shell = insole.design.shell if order.kind == "insole" else None
    findings = check_solid(
        simple.mesh,
        rules.only(CHECKS_OF[order.kind]),
        progress.part(0.7, 1.0),
        unmarked=plain,
        grid_mm=insole.design.grid_mm,
        least_thickness=None if shell is None else least_thickness(insole, shell),
    )
    landmarks = landmarks or find_landmarks(insole.foot)
    unusual = design_warnings(insole, landmarks, load_rules(), materials)
    return Part(
        insole,
        order,
        simple.mesh,
        simple.deviation_mm,
        findings,
        landmarks,
        tuple(warning.sentence for warning in unusual),
        _notes(insole, order),
    )


def nest_parts(left: Part, right: Part, block_mm: tuple[float, float, float]) -> Nest:
    """Place a left and a right part in one block.

    Parameters
    ----------
    block_mm
        Length, width, height.

    Raises
    ------
    DesignError
        If the block is too small.
    """
    return nest_pair(left.solid, right.solid, block_mm)


def checked_together(
    left: Part, right: Part, block_mm: tuple[float, float, float], policy: Policy
) -> tuple[Part, Part]:
    """Check whether both parts fit into one block, in place of each alone.

    Parameters
    ----------
    block_mm
        Length, width, height.
    policy
        Of the check while it is passed. A pair that does not fit cannot be nested, so that then
        the check is blocking.

    Returns
    -------
    tuple of Part
        With the same finding "block".
    """
    nest = closest_nest(left.solid, right.solid)
    over = nest.excess_mm(block_mm)
    sentence = nest.sentence(block_mm)
    fits = over <= 0
    finding = Finding(
        "block", policy if fits else "blocking", fits, round(over, 2), 0.0, "mm too large", sentence
    )
    return _with_block(left, finding), _with_block(right, finding)


def _with_block(part: Part, finding: Finding) -> Part:
    others = tuple(f for f in part.findings if f.name != finding.name)
    kept = () if finding.policy == "off" else (finding,)
    return replace(part, findings=(*others, *kept))


def _marked(solid: TriangleMesh, insole: Insole, order: Order) -> TriangleMesh:
    if not order.mark:
        return solid
    length = insole.foot.length_mm
    sign = -1.0 if order.kind == "positive" else 1.0
    centre = (sign * float(insole.contact.x_mm.mean()), MARK_AT * length)
    room = (MARK_ROOM[0], MARK_ROOM[1] * length)
    post_mm = _rearfoot_post_mm(insole) if order.kind == "insole" else 0.0
    if post_mm > 0:
        centre, room = (centre[0], post_mm / 2), (MARK_ROOM[0], post_mm - 2 * INSET_MM)
    return mark(solid, order.mark, centre_mm=centre, room_mm=room, relief=order.relief)


def _rearfoot_post_mm(insole: Insole) -> float:
    """Return the length of the post that carries the lettering of a cupped shell; 0 for none."""
    design = insole.design
    if design.shell is None or design.bottom == "flat":
        return 0.0
    posts = (post for post in design.shell.posts if post.region == "rearfoot")
    return max((post_length_mm(post, insole.foot.length_mm) for post in posts), default=0.0)


def _reduced(solid: TriangleMesh, order: Order) -> Simplified:
    if order.most_triangles is None:
        return Simplified(solid, 0.0)
    return simplify(solid, order.most_triangles, order.most_deviation_mm)


def _notes(insole: Insole, order: Order) -> tuple[str, ...]:
    notes = [*edge_notes(insole)] if order.kind == "insole" else []
    missing = missing_letters("".join(order.mark))
    if missing:
        notes.append(
            Message(
                "The font has no letters {missing}; the identification shows a likeness or “?” "
                "instead.",
                missing=missing,
            )
        )
    walls, usual = order.options, DEFAULT_OPTIONS
    is_asked = (walls.draft_deg, walls.chamfer_mm) != (usual.draft_deg, usual.chamfer_mm)
    if is_asked and order.kind == "insole" and insole.design.shell is not None:
        notes.append(
            Message(
                "Draft and chamfer of the walls are those of the prescription's shell; those of "
                "the order are not used."
            )
        )
    return tuple(notes)


def _require_known_letters(order: Order) -> None:
    """Refuse an identification that would be written with "?" only."""
    text = "".join(order.mark).strip()
    if text and not set(text) - set(missing_letters(text)):
        raise DesignError(
            "The font has none of the letters of “{text}”; write the identification in other "
            "letters, such as a number.",
            text=text,
        )
