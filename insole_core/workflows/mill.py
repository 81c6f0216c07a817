"""From ordered parts to the program of a router, which lies beside the file of the solids."""

from __future__ import annotations

import glob
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from insole_core.errors import InputError, OutputError, UsageError
from insole_core.files.atomic import write_text
from insole_core.formats.file_formats import PIN_HOLES, PROGRAM
from insole_core.geometry.mesh import TriangleMesh
from insole_core.insole.prescription.item_name import key_of
from insole_core.messages import Translate
from insole_core.milling.gcode import Station, head_of, is_named_in, programs, stations
from insole_core.milling.machine import Machine, read_machine, write_machine
from insole_core.milling.plan import FootInBlock, MillingPlan, plan_milling
from insole_core.milling.spoil_board import spoil_board_plan
from insole_core.progress import SILENT, Progress
from insole_core.regular_file import open_regular
from insole_core.resources import resource_path
from insole_core.solids.export_job import ExportJob, ExportPaths
from insole_core.solids.shop import Block
from insole_core.workflows.named_files import NamedFiles

_HEAD_BYTES = 2000


@dataclass(frozen=True)
class MillingChoice:
    """What is chosen for a router.

    Parameters
    ----------
    both_sides
        Whether the block is turned, so that the underside is milled too.
    """

    machine: Machine
    both_sides: bool = False


def program_paths(path: Path, how: MillingChoice) -> tuple[Path, ...]:
    """Return the names of the files of a program, in the order in which they are run."""
    if how.machine.program_files == "one":
        return (path,)
    count = len(stations(how.machine, both_sides=how.both_sides))
    return tuple(path.with_name(f"{path.stem}-{n}{path.suffix}") for n in range(1, count + 1))


def clinic_machines(folder: Path) -> NamedFiles[Machine]:
    """Return the storage of machines: those of the product, and the clinic's own.

    Parameters
    ----------
    folder
        Of the clinic's settings.
    """
    return NamedFiles(resource_path("milling"), folder / "milling", read_machine, write_machine)


def find_machine(named: str, folder: Path) -> Machine:
    """Return a machine by its name, or from a machine file.

    Parameters
    ----------
    folder
        Of the clinic's settings.

    Raises
    ------
    InputError
        Naming the machines that there are, or what is wrong in the file.
    """
    if named.lower().endswith(".json"):
        return read_machine(Path(named))
    machines = clinic_machines(folder).load().items
    machine = machines.get(key_of(named))
    if machine is None:
        known = ", ".join(machine.name for machine in machines.values())
        if Path(named).is_file():
            raise InputError(
                "{name} is no machine file: these end in .json. Name one, or a machine: {known}.",
                name=named,
                known=known,
            )
        raise InputError(
            "There is no machine {name}; there are {known}. Choose one, or name a machine file.",
            name=named,
            known=known,
        )
    return machine


def check_program_suffix(path: Path) -> None:
    """Check that a name is one of a program.

    Raises
    ------
    UsageError
        When its suffix is none that controllers open.
    """
    if path.suffix.lower() not in PROGRAM.endings:
        raise UsageError(
            "{path} is no name of a program; choose {suffixes}.",
            path=path,
            suffixes=", ".join(PROGRAM.endings),
        )


def plan_job(
    job: ExportJob,
    block: Block,
    machine: Machine,
    *,
    both_sides: bool = False,
    progress: Progress = SILENT,
) -> MillingPlan:
    """Compute the tool paths of a job.

    Parameters
    ----------
    block
        From which all its parts are milled; they lie in its middle.

    Raises
    ------
    DesignError
        When block, machine or a cutter is too small.
    Cancelled
    """
    length, width, height = block.sides_mm
    block_mm = (width, length, height)
    placed = job.placed()
    solids = [each.part.solid.transformed(each.insole2file) for each in placed]
    feet = [FootInBlock(each.part.side, bool(each.insole2file[1, 1] < 0)) for each in placed]
    return plan_milling(
        _in_the_middle(solids, block_mm), block_mm, machine,
        both_sides=both_sides, feet=feet, progress=progress,
    )  # fmt: skip


def _in_the_middle(
    solids: Sequence[TriangleMesh], block_mm: tuple[float, float, float]
) -> list[TriangleMesh]:
    low = np.min([solid.bounds_mm[0] for solid in solids], axis=0)
    high = np.max([solid.bounds_mm[1] for solid in solids], axis=0)
    shift = (np.array(block_mm) - low - high) / 2
    shift[2] = 0.0
    return [TriangleMesh(solid.vertices + shift, solid.triangles) for solid in solids]


def require_no_other_program(path: Path, how: MillingChoice, job: str) -> None:
    """Check that the files of a program do not come to lie beside others of an earlier one.

    The pin holes of a block that is turned are one of them.

    Another order may have a name of the same kind: earlier are those whose head names the same job,
    or is that of a file that is replaced.

    Parameters
    ----------
    path
        As for `program_paths`.
    job
        By which the program names the order.

    Raises
    ------
    OutputError
        Naming those files.
    """
    paths = program_paths(path, how)
    pin_holes = (path.with_name(path.stem + PIN_HOLES.ending),) if how.both_sides else ()
    others = earlier_programs(path, job, (*paths, *pin_holes))
    if others:
        raise OutputError(
            "Files of an earlier program ({files}) would lie beside {path}, and a shop could run "
            "both; remove them, or give the program another name.",
            files=", ".join(others),
            path=paths[0].name,
        )


def earlier_programs(path: Path, job: str, replaced: Collection[Path] = ()) -> list[str]:
    """Return the names of those files of an earlier program that nothing new replaces.

    Parameters
    ----------
    path, job
        As for `require_no_other_program`.
    replaced
        Files that are written now.
    """
    own_heads = {_head(own) for own in replaced} - {""}
    like = re.compile(
        rf"{re.escape(path.stem)}((-\d+)?{re.escape(path.suffix)}|{re.escape(PIN_HOLES.ending)})"
    )
    alike = {
        each for each in path.parent.glob(f"{glob.escape(path.stem)}*") if like.fullmatch(each.name)
    }
    heads = {each.name: _head(each) for each in alike.difference(replaced)}
    return sorted(
        name for name, head in heads.items() if head in own_heads or is_named_in(head, job)
    )


def _head(path: Path) -> str:
    """Return the head of a program; empty where there is none, or none that can be read."""
    try:
        with open_regular(path) as file:
            return head_of(file.read(_HEAD_BYTES).decode("ascii", "replace"))
    except OSError:
        return ""


def write_milling(
    plan: MillingPlan,
    block: Block,
    places: ExportPaths,
    beside: ExportPaths,
    *,
    identification: Mapping[str, str],
    translate: Translate = str,
    progress: Progress = SILENT,
) -> None:
    """Write the program of a plan, that of the spoil board, and the set-up sheet of both.

    Parameters
    ----------
    block
        From which `plan` was made.
    places, beside
        The final paths, and the temporary files to write, as for `run_export_job`; what is None is
        not written.
    identification
        Of the order, with its "pseudonym"; never the patient's name.
    translate
        Into the language of the sheet.

    Raises
    ------
    OutputError
        When a place cannot be written.
    """
    from insole_core.workflows.setup_sheet import RouterFile, write_setup_sheet

    if not beside.programs:
        return
    job, machine = identification["pseudonym"], plan.machine
    in_order = stations(machine, both_sides=plan.is_turned)
    texts = programs(plan, in_order, job, progress.part(0.0, 0.7))
    made = []
    for place, file, text in zip(places.programs, beside.programs, texts, strict=True):
        write_text(text.text, file)
        made.append(RouterFile(place.name, file, text.operations))
    pins = None
    if places.pin_holes is not None and beside.pin_holes is not None:
        board = spoil_board_plan(machine, plan.block_mm)
        boring = Station("spoil board", machine.contour.cutter)
        write_text(programs(board, [boring], job)[0].text, beside.pin_holes)
        pins = RouterFile(places.pin_holes.name, beside.pin_holes, board.operations)
    if beside.setup_sheet is not None:
        progress.step(0.8, "Writing the set-up sheet")
        write_setup_sheet(
            plan, made, beside.setup_sheet,
            block=block, identification=identification, pin_holes=pins, translate=translate,
        )  # fmt: skip
