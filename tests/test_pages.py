"""What the pages for developers point to is there; the manual's own links are `make manual`'s."""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
DECISIONS = ROOT / "docs" / "decisions"
FOLDERS = ("app", "benchmarks", "docs", "drivers", "insole_core", "packaging", "tests", "training")
PLACES = (
    ROOT,
    *(
        ROOT / folder
        for folder in (
            "app",
            "app/insole_studio",
            "drivers/kinect",
            "drivers/realsense",
            "insole_core",
        )
    ),
)
"""Where a path that a page names may begin."""
MADE = ("benchmarks/results", "insole_core/_resources", "resources/manual")
"""Folders that are made when they are needed, or in a package."""
BEGINNINGS = (*FOLDERS, "features", "insole_studio", "kinect_v1", "resources")
"""Of paths that lead into this repository, of whatever kind."""

LINK = re.compile(r"\]\((?!\w+:|#)([^)\s#]+)")
DECISION = re.compile(r"\bdecisions?[ /](\d{4}(?:(?:, | and )\d{4})*)")
BENCHMARK = re.compile(r"python -m benchmarks[ .]([a-z_]+)")
STEP = re.compile(r"`([\w.]+)`\s*\(`([\w/]+\.py)`\)")
NAMED_PATH = re.compile(r"`((?:[\w.-]+/)+[\w.-]*)`")


def pages() -> list[Path]:
    below = [page for folder in FOLDERS for page in (ROOT / folder).rglob("*.md")]
    return [*ROOT.glob("*.md"), *(ROOT / ".github").rglob("*.md"), *below]


def sources() -> list[Path]:
    code = [page for folder in FOLDERS for page in (ROOT / folder).rglob("*.py")]
    return [*pages(), *code, *ROOT.glob("*.toml")]


def test_every_link_leads_somewhere() -> None:
    broken = [
        (page.relative_to(ROOT).as_posix(), target)
        for page in pages()
        for target in LINK.findall(page.read_text("utf-8"))
        if not (page.parent / target).exists()
    ]
    assert broken == []


def test_every_decision_that_is_named_has_a_page() -> None:
    known = {page.name[:4] for page in DECISIONS.glob("0*.md")}
    lost = [
        (path.relative_to(ROOT).as_posix(), number)
        for path in sources()
        for numbers in DECISION.findall(path.read_text("utf-8"))
        for number in re.findall(r"\d{4}", numbers)
        if number not in known
    ]
    assert lost == []


def test_the_index_has_every_decision_and_no_number_twice() -> None:
    rows = re.findall(
        r"^\| \[(\d{4})\]\((.+?)\) \|.*?\| ([\d, ]*)\|$",
        (DECISIONS / "README.md").read_text("utf-8"),
        re.MULTILINE,
    )
    assert sorted(name for _, name, _ in rows) == sorted(p.name for p in DECISIONS.glob("0*.md"))
    assert all(name.startswith(number) for number, name, _ in rows)
    merged = [number for *_, was in rows for number in re.findall(r"\d{4}", was)]
    numbers = [*merged, *(number for number, *_ in rows)]
    assert len(set(numbers)) == len(numbers)


def test_numbers_within_decisions_are_those_of_pages() -> None:
    """A decision names another one by its number in brackets."""
    known = {page.name[:4] for page in DECISIONS.glob("0*.md")}
    named = {
        (page.name, number)
        for page in DECISIONS.glob("0*.md")
        for number in re.findall(r"(?<![\w.%−-])(00\d\d)(?![\w.-])", page.read_text("utf-8"))
    }
    assert {one for one in named if one[1] not in known} == set()


def test_every_path_that_is_named_exists() -> None:
    """A module that moves takes its name in ARCHITECTURE and decisions along."""
    written = [page for page in pages() if page.name != "CHANGELOG.md"]
    gone = [
        (page.relative_to(ROOT).as_posix(), name)
        for page in written
        for name in NAMED_PATH.findall(page.read_text("utf-8"))
        if name.endswith(".py") or name.startswith(BEGINNINGS)
        if not name.startswith(MADE)
        if not any((place / name).exists() for place in (*PLACES, page.parent))
    ]
    assert gone == []


def test_every_benchmark_that_is_named_exists() -> None:
    named = {name for page in pages() for name in BENCHMARK.findall(page.read_text("utf-8"))}
    assert {name for name in named if not (ROOT / "benchmarks" / f"{name}.py").exists()} == set()


def test_the_walk_can_be_walked() -> None:
    """Each function that ARCHITECTURE names with its module is defined there."""
    steps = STEP.findall((ROOT / "ARCHITECTURE.md").read_text("utf-8"))
    assert len(steps) > 10
    lost = [
        (name, path)
        for name, path in steps
        for part in name.split(".")
        if not any(
            re.search(
                rf"^ *(?:def|class) {part}\b", (place / path).read_text("utf-8"), re.MULTILINE
            )
            for place in PLACES
            if (place / path).exists()
        )
    ]
    assert lost == []
