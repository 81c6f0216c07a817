"""Arguments that choose which camera parameters are fitted."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from insole_core.calibration.boards.intrinsics import IntrinsicsOptions


def add_lens_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the parameters that are fixed by default."""
    parser.add_argument("--fit-k3", action="store_true", help="free the sixth order of the lens")
    parser.add_argument("--fit-skew", action="store_true", help="free the skew of the axes")


def options_of(arguments: argparse.Namespace) -> IntrinsicsOptions:
    """Return the options that the arguments select."""
    from insole_core.calibration.boards.intrinsics import IntrinsicsOptions

    return IntrinsicsOptions(fit_k3=arguments.fit_k3, fit_skew=arguments.fit_skew)
