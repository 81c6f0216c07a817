"""What a slicer really lays down: the density of the infill in a box, from its G-code.

Written without the code that makes the zones. In PrusaSlicer a line of infill of length l fills
the volume that its plastic has, so the share of a box that is filled is its density.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import numpy.typing as npt

from benchmarks._witnesses import PRUSA

_FILAMENT_MM2 = np.pi / 4 * 1.75**2
_PIECE_MM = 0.5
BED_MM = 400.0


@dataclass(frozen=True, eq=False)
class Sliced:
    """Moves (n, 2, 3) in mm, their plastic (n,) in mm³, their kinds (n,), and complaints."""

    moves: npt.NDArray[np.float64]
    plastic_mm3: npt.NDArray[np.float64]
    kinds: npt.NDArray[np.str_]
    complaints: tuple[str, ...]

    def of(self, kind: str) -> Sliced:
        """Return the moves of the kinds whose names end alike."""
        chosen = np.char.endswith(self.kinds, kind)
        return replace(
            self,
            moves=self.moves[chosen],
            plastic_mm3=self.plastic_mm3[chosen],
            kinds=self.kinds[chosen],
        )

    def density_percent(self, low: Sequence[float], high: Sequence[float]) -> float:
        """Return the share of a box that is filled with infill; corners in mm, frame of the bed."""
        places, plastic_mm3 = self.of("Internal infill").pieces()
        inside = ((places > low) & (places < high)).all(axis=1)
        plastic = plastic_mm3[inside].sum()
        layers = np.unique(places[inside, 2])
        if len(layers) < 2:
            return 0.0
        height = layers[-1] - layers[0] + np.diff(layers).min()
        area = (high[0] - low[0]) * (high[1] - low[1])
        return float(100 * plastic / (area * height))

    def pieces(self) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]:
        """Return the middles (n, 3) of short pieces of the moves, and the plastic (n,) of each."""
        start, end = self.moves[:, 0], self.moves[:, 1]
        lengths = np.linalg.norm(end - start, axis=1)
        counts = np.maximum(1, np.ceil(lengths / _PIECE_MM)).astype(int)
        move = np.repeat(np.arange(len(counts)), counts)
        first = np.repeat(np.cumsum(counts) - counts, counts)
        share = (np.arange(len(move)) - first + 0.5) / counts[move]
        return start[move] + share[:, None] * (end - start)[move], (self.plastic_mm3 / counts)[move]


def sliced(path: Path, folder: Path, layer_mm: float = 0.3) -> Sliced | None:
    """Slice a file with one neutral profile; None where PrusaSlicer is not installed."""
    if shutil.which(PRUSA) is None:
        return None
    out = folder / f"{path.stem}.gcode"
    bed = f"0x0,{BED_MM:g}x0,{BED_MM:g}x{BED_MM:g},0x{BED_MM:g}"
    call = subprocess.run(
        [PRUSA, "--export-gcode", "--dont-arrange", "--bed-shape", bed, "--center",
         f"{BED_MM / 2:g},{BED_MM / 2:g}", "--filament-diameter", "1.75", "--layer-height",
         f"{layer_mm:g}", "--first-layer-height", f"{layer_mm:g}", "--skirts", "0",
         "--output", str(out), str(path)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    said = (call.stdout + call.stderr).splitlines()
    wrong = [line for line in said if re.search(r"error|repair|empty layer|fault", line, re.I)]
    if call.returncode != 0 or not out.exists():
        return Sliced(
            np.zeros((0, 2, 3)), np.zeros(0), np.zeros(0, "U1"), (*wrong, f"exit {call.returncode}")
        )
    listed, kinds = zip(*_moves(out), strict=True)
    moves = np.array([row[:6] for row in listed], float).reshape(-1, 2, 3)
    plastic = np.array([row[6] for row in listed], float) * _FILAMENT_MM2
    return Sliced(moves, plastic, np.array(kinds), tuple(wrong))


def _moves(path: Path) -> Iterator[tuple[tuple[float, ...], str]]:
    """Yield start, end and length of filament of each move that prints, and its kind."""
    at = {"X": 0.0, "Y": 0.0, "Z": 0.0, "E": 0.0}
    kind = ""
    for line in path.read_text().splitlines():
        if line.startswith(";TYPE:"):
            kind = line.removeprefix(";TYPE:")
        elif line.startswith(("G1 ", "G92 ")):
            before = dict(at)
            words = line.split(";")[0].split()[1:]
            at |= {word[0]: float(word[1:]) for word in words if word[0] in at}
            moved = (before["X"], before["Y"]) != (at["X"], at["Y"])
            if moved and at["E"] > before["E"]:
                laid = at["E"] - before["E"]
                yield (*(before[a] for a in "XYZ"), *(at[a] for a in "XYZ"), laid), kind
