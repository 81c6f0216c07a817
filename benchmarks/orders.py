"""An order of many pairs of random designs: seconds to write, size, and whether it verifies.

python -m benchmarks.orders [number of pairs] [zip|folder] [stl|3mf|obj|ply]
"""

from __future__ import annotations

import sys
import tempfile
import time
from datetime import datetime
from pathlib import Path

import numpy as np

from benchmarks._random_designs import DESIGNS_PER_FOOT, random_design, random_foot
from insole_core.cases.case_record import Patient
from insole_core.errors import InsoleError
from insole_core.export.order_verification import verify_order
from insole_core.export.shop_order import OrderTerms
from insole_core.foot.foot import Foot
from insole_core.geometry.side import Side
from insole_core.insole.build import build_insole
from insole_core.solids.export_rules import read_rules
from insole_core.solids.order import Order, Part, make_part
from insole_core.solids.shop import read_shop
from insole_core.workflows.make_order import OrderChoice
from insole_core.workflows.order_package import PackedItem, write_package


def main() -> None:
    """Make the pairs, write them as one order, open it again, and print how long each took."""
    pairs = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    ending = "" if "folder" in sys.argv else ".zip"
    suffix = f".{sys.argv[3]}" if len(sys.argv) > 3 else ".stl"
    begun = time.perf_counter()
    items = [_item(number, suffix) for number in range(pairs)]
    made = time.perf_counter()
    print(f"{pairs} pairs made in {made - begun:.1f} s")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"order{ending}"
        begun, cpu = time.perf_counter(), time.process_time()
        write_package(items, path, number="B-1", shop=read_shop(), now=datetime.now().astimezone())
        written, cpu = time.perf_counter(), time.process_time() - cpu
        files = [path] if path.is_file() else list(path.iterdir())
        size_mb = sum(file.stat().st_size for file in files) / 1e6
        verification = verify_order(path)
        verified = time.perf_counter()
    print(
        f"written in {written - begun:.1f} s ({cpu:.1f} s of processor): "
        f"{len(verification.order.files)} files, {size_mb:.1f} MB; "
        f"verified in {verified - written:.1f} s, {len(verification.problems)} problems"
    )
    if verification.problems:
        raise SystemExit("\n".join(verification.problems))


def _item(number: int, suffix: str) -> PackedItem:
    parts = tuple(_part(number, side) for side in Side)
    pseudonym = f"P-{number + 1}"
    terms = OrderTerms(quantity=1, colour="black", cover="Nora 2 mm")
    choice = OrderChoice(both=True, suffix=suffix, pseudonym=pseudonym, material="EVA", terms=terms)
    return PackedItem(parts, choice, Patient(pseudonym=pseudonym), {})


def _part(number: int, side: Side) -> Part:
    """Make the first of some random designs that can be made."""
    foot = _foot(number // DESIGNS_PER_FOOT, side)
    rng = np.random.default_rng([number, side is Side.LEFT])
    while True:
        try:
            insole = build_insole(foot, random_design(foot, rng))
            return make_part(insole, Order(most_triangles=40_000), read_rules())
        except InsoleError:
            continue


_FEET: dict[tuple[int, Side], Foot] = {}


def _foot(number: int, side: Side) -> Foot:
    """Return the random foot of a number and a side."""
    seed = 100 * number
    while (number, side) not in _FEET:
        foot = random_foot(seed)
        if foot.side is side:
            _FEET[number, side] = foot
        seed += 1
    return _FEET[number, side]


if __name__ == "__main__":
    main()
