"""The holes in the spoil board for the dowels on which a block is turned: a program of its own."""

from __future__ import annotations

from dataclasses import replace

from insole_core.milling.contours import bored_at_dowels
from insole_core.milling.machine import Machine
from insole_core.milling.plan import MillingPlan


def spoil_board_plan(machine: Machine, block_mm: tuple[float, float, float]) -> MillingPlan:
    """Plan the boring of the holes below the dowels of a block.

    Parameters
    ----------
    block_mm
        Width, length, height of the block that will lie on the board.

    Returns
    -------
    MillingPlan
        Its zero has the place of the block's along x and y, and lies on the surface of the board.

    Raises
    ------
    DesignError
        When a hole is narrower than the cutter, or deeper than it reaches.
    """
    on_the_board = replace(machine, origin=replace(machine.origin, height="top"))
    layer_mm = (*block_mm[:2], machine.both_sides.board_depth_mm)
    bored = bored_at_dowels(on_the_board, layer_mm, "spoil board")
    return MillingPlan(on_the_board, layer_mm, (), (bored,), (), ())
