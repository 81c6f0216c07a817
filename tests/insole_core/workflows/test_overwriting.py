"""No result takes the place of what it is made from."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from insole_core.errors import UsageError
from insole_core.workflows.overwriting import check_overwriting

SPELLINGS: dict[str, Callable[[Path], Path]] = {
    "same": lambda path: path,
    "other spelling": lambda path: path.parent / ".." / path.parent.name / path.name,
    "relative": lambda path: Path(os.path.relpath(path)),
    "symlink": lambda path: linked(path, os.symlink),
    "hard link": lambda path: linked(path, os.link),
}


def linked(path: Path, link: Callable[[Path, Path], None]) -> Path:
    other = path.parents[-2] / path.relative_to(path.parents[-2]).parent / f"link{path.suffix}"
    link(path, other)
    return other


@pytest.fixture
def session(tmp_path: Path) -> Path:
    view = tmp_path / "session" / "views" / "left"
    view.mkdir(parents=True)
    for path in (view / "color_000.png", view / "sensor.json", view.parents[1] / "manifest.json"):
        path.write_text("{}")
    return view.parents[1]


@pytest.mark.parametrize("spelling", SPELLINGS)
def test_an_input_is_refused_however_it_is_called(tmp_path: Path, spelling: str) -> None:
    scan = tmp_path / "scan.ply"
    scan.write_text("ply")
    with pytest.raises(UsageError, match="is read to make the result"):
        check_overwriting([tmp_path / "new.ply", SPELLINGS[spelling](scan)], [scan])


@pytest.mark.parametrize("spelling", SPELLINGS)
@pytest.mark.parametrize("part", ["manifest.json", "views/left/sensor.json"])
def test_a_part_of_an_input_is_refused(session: Path, part: str, spelling: str) -> None:
    with pytest.raises(UsageError, match="is read to make the result"):
        check_overwriting([SPELLINGS[spelling](session / part)], [session])


@pytest.mark.parametrize(
    "name", ["marker_edits.json", "truth.ply", "views/left/color_001.png", "../session"]
)
def test_what_would_become_a_part_of_an_input_is_refused(session: Path, name: str) -> None:
    with pytest.raises(UsageError, match="is read to make the result"):
        check_overwriting([session / name], [session])


def test_the_corrections_of_an_archive_are_part_of_it(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="is read to make the result"):
        check_overwriting([tmp_path / "a.marker_edits.json"], [tmp_path / "a.zip"])


def test_other_files_may_lie_with_the_input(session: Path) -> None:
    (session / "foot.ply").write_text("of yesterday")
    shutil.copy(session / "manifest.json", session.parent / "manifest.json")
    check_overwriting(
        [session / "foot.ply", session / "report.json", session.parent / "manifest.json"], [session]
    )
    check_overwriting([session.parent / "none.ply"], [session.parent / "None.ply"])


def test_a_name_that_is_too_long_for_a_file_is_left_to_its_reader(tmp_path: Path) -> None:
    check_overwriting([tmp_path / "insole.stl"], [Path("7" * 5000)])
