"""Running families of trials of bad input, and the table of what became of them."""

from __future__ import annotations

import os
import random
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from benchmarks._fuzz_pool import Trial, preload, run_trials, stay_within
from benchmarks._measure import print_table

FAULTS = (
    "traceback",
    "hang",
    "memory",
    "wrongly accepted",
    "wrongly refused",
    "input changed",
    "not tried",
)
_MOST_S = 570.0

Families = Mapping[str, Callable[[random.Random], Iterator[Trial]]]


def run_families(families: Families, prepare: Callable[[], object]) -> None:
    """Run the families that ``FUZZ_ONLY`` names, all by default, and print what became of them.

    Parameters
    ----------
    prepare
        Makes what all processes share, before the first is forked.

    Raises
    ------
    SystemExit
        With 1 where there was a fault.
    """
    seed = int(os.environ.get("FUZZ_SEED", "1"))
    only = [name for name in os.environ.get("FUZZ_ONLY", "").split(",") if name]
    chosen = {name: family for name, family in families.items() if not only or name in only}
    sys.stdout.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]
    with tempfile.TemporaryDirectory(prefix="fuzz-") as root:
        stay_within(Path(root))
        _run_all(seed, chosen, prepare)


def _run_all(seed: int, families: Families, prepare: Callable[[], object]) -> None:
    start = time.monotonic()
    preload()
    prepare()
    counts: Counter[tuple[str, str]] = Counter()
    slowest: dict[str, float] = {}
    largest: dict[str, float] = {}
    for outcome in run_trials(_trials(seed, families), until=start + _MOST_S):
        family = outcome.trial.family
        if family not in slowest:
            print(f"{family}: begins after {time.monotonic() - start:.0f} s")
        counts[family, "inputs"] += 1
        counts[family, outcome.verdict] += 1
        slowest[family] = max(slowest.get(family, 0), outcome.seconds)
        largest[family] = max(largest.get(family, 0), outcome.peak_bytes / 2**20)
        for fault in outcome.faults:
            counts[family, fault] += 1
            if fault == "not tried":
                continue
            print(f"{fault}: {family}: {outcome.trial.name}: {outcome.sentence[-600:]}")
        if os.environ.get("FUZZ_SAY"):
            print(f"{family} | {outcome.trial.name} | {outcome.verdict} | {outcome.sentence[:200]}")
        sys.stdout.flush()
    told = list(dict.fromkeys(family for family, _ in counts))
    rows = [
        [
            family,
            counts[family, "inputs"],
            counts[family, "refused"],
            counts[family, "accepted"],
            *(counts[family, fault] for fault in FAULTS),
            f"{slowest[family]:.1f}",
            f"{max(largest[family], 0):.0f}",
        ]
        for family in told
    ]
    total = [
        "all",
        *(sum(int(str(row[column])) for row in rows) for column in range(1, 4 + len(FAULTS))),
        "",
        "",
    ]
    head = ["family", "inputs", "refused", "accepted", *FAULTS, "seconds", "MB"]
    print_table(head, [*rows, total])
    print(f"seed {seed}, {time.monotonic() - start:.0f} s")
    if any(counts[family, fault] for family in told for fault in FAULTS):
        raise SystemExit(1)


def _trials(seed: int, families: Families) -> Iterator[Trial]:
    for name, family in families.items():
        yield from family(random.Random(f"{seed} {name}"))
