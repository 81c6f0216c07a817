"""Which of the two to use for a set of sensors: with the learnt correction, or without."""

from __future__ import annotations

from dataclasses import dataclass

from insole_core.evaluation.chain import ChainErrors, ChainEvaluation, Correction

WORSE_MEAN_MM, WORSE_95_MM, WORSE_SIZE = 0.02, 0.1, 0.005
"""By more than this a correction may not be worse, in the mean, at 95 %, and in the size."""


@dataclass(frozen=True)
class Verdict:
    """A decision for a set of sensors.

    Parameters
    ----------
    use
        The one to use.
    is_clear
        Whether the object told the two apart; if it did not, the correction stays on.
    reason
        One sentence.
    """

    use: Correction
    is_clear: bool
    reason: str


def judge(evaluation: ChainEvaluation) -> Verdict:
    """Decide by what the correction did to the mean, to the 95 %, and to the size."""
    without, learnt = evaluation.results["none"], evaluation.results["learnt"]
    change = {
        "mean": (_mean(without), _mean(learnt), WORSE_MEAN_MM),
        "95 %": (_p95(without), _p95(learnt), WORSE_95_MM),
        "size": (
            abs(without.size_error_mm),
            abs(learnt.size_error_mm),
            WORSE_SIZE * without.size_mm,
        ),
    }
    said = ", ".join(f"{name} {a:.2f} to {b:.2f} mm" for name, (a, b, _) in change.items())
    worse = [name for name, (a, b, limit) in change.items() if b - a > limit]
    better = [name for name, (a, b, limit) in change.items() if a - b > limit]
    if worse:
        return Verdict(
            "none",
            True,
            f"The correction makes it worse ({' and '.join(worse)}: {said}), so it is better off.",
        )
    if better:
        return Verdict("learnt", True, f"The correction makes it better ({said}), so it stays on.")
    return Verdict(
        "learnt",
        False,
        f"The correction changes hardly anything on this object ({said}), so it stays on; a cast "
        "of a foot says more.",
    )


def _mean(result: ChainErrors) -> float:
    return result.surface.all.mean_abs_mm


def _p95(result: ChainErrors) -> float:
    return result.surface.all.p95_mm
