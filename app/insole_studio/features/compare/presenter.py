"""Presenter of the compare stage: reads two surfaces, aligns them and shows their difference."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from insole_core.cases.case_record import CaseRecord
from insole_core.compare.comparison import Alignment, ComparisonSource
from insole_core.compare.comparison_report import drawn_maps
from insole_core.compare.seen_surface import facing
from insole_core.errors import InsoleError
from insole_core.geometry.arrays import ByteArray, FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.progress import Progress
from insole_core.visible_text import visible_line
from insole_core.workflows.compare_case import (
    Compared,
    Wanted,
    compare_sources,
    surface_of,
    write_comparison,
)
from insole_core.workflows.overwriting import check_overwriting
from insole_studio.document.case import Case
from insole_studio.features.compare.rows import (
    FILE,
    FOLDER,
    MAPS,
    RESULT,
    SURFACES,
    CompareButtons,
    figure_rows,
)
from insole_studio.jobs import JobProgress, Jobs
from insole_studio.scene.coloring import Coloring
from insole_studio.scene.pointer import MarkedPoint
from insole_studio.texts import tr, translate_core_message

if TYPE_CHECKING:
    from insole_studio.features.compare.view import CompareView

READING, COMPARING, DRAWING, WRITING = "read", "compare", "draw", "write"
LEAST_POINTS = 3


class ComparePresenter:
    """Compares the surfaces a and b.

    Parameters
    ----------
    panel
        The compare panel.
    case
        Offers its feet and insoles.
    jobs
        Runs long computations.
    ask_source
        Lets the user choose a path, given "file" or "folder"; None if cancelled.
    ask_report
        Lets the user choose where to write the report.
    visits
        Two visits to begin with, the newer one first, each with its name.
    """

    def __init__(
        self,
        panel: CompareView,
        *,
        case: Case,
        jobs: Jobs,
        ask_source: Callable[[str], Path | None],
        ask_report: Callable[[], Path | None],
        visits: Sequence[tuple[str, CaseRecord]] = (),
    ) -> None:
        self._panel, self._case, self._jobs = panel, case, jobs
        self._visits = tuple(visits)
        self._ask_source, self._ask_report = ask_source, ask_report
        self._words: dict[str, str] = {}
        self._paths: list[Path] = []
        self._sources: dict[str, ComparisonSource] = {}
        self._laid: dict[str, ComparisonSource] = {}
        """The surfaces as they are compared and shown: the second mirrored if of the other foot."""
        self._points: dict[str, list[FloatArray]] = {"a": [], "b": []}
        self._alignment = "best"
        self._median = 1
        self._compared: Compared | None = None
        self._has_maps = False
        panel.source_chosen.connect(self.choose)
        panel.alignment_chosen.connect(self.align_by)
        panel.median_edited.connect(self.filter_by)
        panel.point_picked.connect(self.pick)
        panel.take_back_requested.connect(self.take_back)
        panel.save_requested.connect(self.ask_save)
        panel.cancel_requested.connect(self.cancel)
        panel.tab_shown.connect(self._show_maps)
        jobs.progressed.connect(self._show_progress)
        jobs.ended.connect(self._show_buttons)
        for which in "ab":
            panel.show_source(which, None, True)
        panel.show_has_result(False)
        panel.show_notes([])
        panel.show_error("")
        self._show_picking()
        self._show_buttons()
        self._show_choices()
        self._begin_with_the_case()

    def choose(self, which: str, word: str) -> None:
        """Choose a surface; for a file or a session the user is asked for the path.

        Parameters
        ----------
        which
            "a" or "b".
        word
            Key of the choice.
        """
        if word in (FILE, FOLDER):
            path = self._ask_source(word)
            if path is None:
                self._show_choices()
                return
            self.choose_path(which, path)
        else:
            self._words[which] = word
            self._read(which)

    def choose_path(self, which: str, path: Path) -> None:
        """Choose the surface in a file or session folder."""
        if path not in self._paths:
            self._paths.append(path)
        self._words[which] = str(path)
        self._show_choices()
        self._read(which)

    def align_by(self, word: str) -> None:
        """Choose the method that aligns b with a."""
        self._alignment = word
        if word == "picked":
            self._panel.show_tab(SURFACES)
        self._show_picking()
        self._compare()

    def filter_by(self, pixels: float) -> None:
        """Set the size of the median filter applied to both surfaces."""
        self._median = int(pixels)
        self._compare()

    def pick(self, which: str, place_mm: FloatArray) -> None:
        """Add a picked point (3,), mm; the n-th point of a corresponds to the n-th of b."""
        self._points[which].append(place_mm)
        self._show_picking()
        self._compare()

    def take_back(self) -> None:
        """Remove the last point of the surface with more points."""
        a, b = self._points["a"], self._points["b"]
        longer = a if len(a) > len(b) else b
        if longer:
            longer.pop()
        self._show_picking()
        self._compare()

    def ask_save(self) -> None:
        """Let the user choose where to write the report, and write it."""
        path = self._ask_report()
        if path is not None:
            self.save_to(path)

    def save_to(self, path: Path) -> None:
        """Write the report in the background."""
        compared, names = self._compared, (self._sources["a"].name, self._sources["b"].name)
        read = (*self._paths, *self._case.record.source_paths)
        if compared is None:
            return

        def write(progress: Progress) -> None:
            progress.step(0.1, tr("Writing the report"))
            check_overwriting([path], read)
            write_comparison(compared, names, path, translate_core_message)

        self._panel.show_error("")
        self._jobs.start(
            WRITING,
            write,
            lambda _nothing: self._panel.show_notes([tr("Written: {name}").format(name=path.name)]),
            self._show_failure,
        )
        self._show_buttons()

    def cancel(self) -> None:
        """Cancel the running job."""
        for channel in (READING + "a", READING + "b", COMPARING, DRAWING, WRITING):
            self._jobs.cancel(channel)

    def _show_choices(self) -> None:
        options = [("", tr("Choose…"))]
        for number, (name, record) in enumerate(self._records()):
            before = f"{name}: " if name else ""
            for foot in record.feet:
                left = foot.side is Side.LEFT
                foot_text = tr("Left foot") if left else tr("Right foot")
                insole_text = tr("Left insole") if left else tr("Right insole")
                options += [
                    (f"{number} foot {foot.side}", f"{before}{foot_text}"),
                    (f"{number} insole {foot.side}", f"{before}{insole_text}"),
                ]
        options += [(str(path), visible_line(path.name)) for path in self._paths]
        options += [(FILE, tr("Mesh or archive…")), (FOLDER, tr("Session, also of a mould…"))]
        self._panel.show_sources(options, self._words)

    def _records(self) -> Sequence[tuple[str, CaseRecord]]:
        """Return what can be compared besides files: two visits, or the open case."""
        return self._visits or (("", self._case.record),)

    def _begin_with_the_case(self) -> None:
        """Begin with the foot on both visits, or with insole and foot of the open case."""
        foot = self._case.record.current
        if self._visits:
            newer, older = (record for _name, record in self._visits)
            both = [foot.side for foot in newer.feet if older.of_side(foot.side) is not None]
            if not both:
                return
            self._words = {"a": f"0 foot {both[0]}", "b": f"1 foot {both[0]}"}
        elif foot is not None:
            self._words = {"a": f"0 insole {foot.side}", "b": f"0 foot {foot.side}"}
        else:
            return
        self._show_choices()
        for which in "ab":
            self._read(which)

    def _read(self, which: str) -> None:
        word = self._words[which]
        self._sources.pop(which, None)
        self._laid.pop(which, None)
        self._points = {"a": [], "b": []}
        self._forget_result()
        self._panel.show_source(which, None, True)
        self._show_picking()
        if not word:
            return
        number, wanted = _wanted(word)
        record = self._records()[number][1]

        def read(progress: Progress) -> ComparisonSource:
            return surface_of(record, wanted, progress)

        def take(source: ComparisonSource) -> None:
            self._sources[which] = source
            self._lay()
            self._compare()

        self._panel.show_error("")
        self._jobs.start(READING + which, read, take, self._show_failure)
        self._show_buttons()

    def _compare(self) -> None:
        self._forget_result()
        alignment = self._chosen_alignment()
        if alignment is None or len(self._sources) < 2:
            return
        a, b, median = self._laid["a"], self._laid["b"], self._median

        def compare(progress: Progress) -> Compared:
            return compare_sources(a, b, alignment, median, progress)

        self._panel.show_error("")
        self._jobs.start(COMPARING, compare, self._take, self._show_failure)
        self._show_buttons()

    def _lay(self) -> None:
        """Lay the surfaces as they are compared, and show those that lie otherwise than before."""
        before, self._laid = self._laid, dict(self._sources)
        if len(self._laid) == 2:
            self._laid["b"] = self._laid["b"].like(self._laid["a"])
        for which, laid in self._laid.items():
            if laid is not before.get(which):
                self._panel.show_source(which, laid.mesh, _from_above(laid.mesh))
        self._panel.show_notes([note for laid in self._laid.values() for note in laid.notes])

    def _chosen_alignment(self) -> Alignment | None:
        if self._alignment == "picked":
            return self._pairs() if self._is_paired else None
        words: dict[str, Alignment] = {"best": "best", "none": "none", "dots": "dots"}
        return words[self._alignment]

    @property
    def _is_paired(self) -> bool:
        a, b = (len(self._points[which]) for which in "ab")
        return a == b >= LEAST_POINTS

    def _pairs(self) -> tuple[FloatArray, FloatArray]:
        return np.array(self._points["a"]), np.array(self._points["b"])

    def _forget_result(self) -> None:
        self._jobs.cancel(COMPARING)
        self._jobs.cancel(DRAWING)
        self._compared, self._has_maps = None, False
        self._panel.show_no_picture()
        self._panel.show_has_result(False)
        self._panel.show_figures([])
        self._show_buttons()

    def _take(self, compared: Compared) -> None:
        self._compared = compared
        span = compared.span_mm
        coloring = Coloring(compared.signed_mm, (-span, span), tr("A over B"), signed=True)
        above = _from_above(self._sources["a"].mesh)
        self._panel.show_has_result(True)
        self._panel.show_result(compared.surface, coloring, above)
        self._panel.show_figures(figure_rows(compared.difference))
        self._panel.show_tab(RESULT)
        self._show_buttons()

    def _show_maps(self, tab: int) -> None:
        """Draw the difference maps once they are looked at: mostly only the surface is."""
        compared = self._compared
        if tab != MAPS or compared is None or self._has_maps:
            return
        names = self._laid["a"].name, self._laid["b"].name

        def draw(progress: Progress) -> ByteArray:
            progress.step(0.1, tr("Drawing the difference"))
            return drawn_maps(compared.difference, names, translate_core_message)

        def take(picture: ByteArray) -> None:
            self._has_maps = True
            self._panel.show_picture(picture)

        self._panel.show_error("")
        self._jobs.start(DRAWING, draw, take, self._show_failure)
        self._show_buttons()

    def _show_picking(self) -> None:
        on = self._alignment == "picked"
        for which, places in self._points.items():
            shown = [
                MarkedPoint(str(number + 1), (float(x), float(y), float(z)))
                for number, (x, y, z) in enumerate(places if on else [])
            ]
            self._panel.show_points(which, shown)
        counts = [len(self._points[which]) for which in "ab"]
        text = tr("Click the same places on A and B, three or more. Picked: {a} on A, {b} on B.")
        self._panel.show_picking(on, text.format(a=counts[0], b=counts[1]) if on else "")
        self._show_buttons()

    def _show_failure(self, error: Exception) -> None:
        sentence = tr("Something unexpected happened; nothing was changed. Please report it.")
        self._panel.show_error(str(error) if isinstance(error, InsoleError) else sentence)
        self._show_buttons()

    def _show_progress(self, news: JobProgress) -> None:
        self._panel.show_progress(news.fraction, news.text)

    def _show_buttons(self, _channel: str = COMPARING) -> None:
        busy = self._jobs.is_running()
        if not busy:
            self._panel.show_progress(0.0, "")
        self._panel.show_buttons(
            CompareButtons(
                save=not busy and self._compared is not None,
                cancel=busy,
                take_back=any(self._points.values()),
            )
        )


def _wanted(word: str) -> tuple[int, Wanted]:
    """Return the number of a record and what is wanted of it; of the first one for a file."""
    for number, side, kind in product((0, 1), Side, ("foot", "insole")):
        if word == f"{number} {kind} {side}":
            return number, Wanted(kind, side)
    return 0, Wanted("file", path=Path(word))


def _from_above(mesh: TriangleMesh) -> bool:
    return bool(facing(mesh)[2] > 0)
