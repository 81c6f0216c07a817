"""A captured ball goes through the whole chain, and says whether to use the learnt correction."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from insole_core.errors import UsageError
from insole_core.evaluation.chain import PARTS, ChainEvaluation
from insole_core.evaluation.chain_section import judge
from insole_core.evaluation.known_object import KnownRound
from insole_core.reconstruct.fusion import matching_error
from insole_core.recording.reader import read_session
from insole_core.recording.writer import write_session
from insole_core.sensing import sensor
from insole_core.simulate import SimulationOptions, simulate_session
from insole_core.simulate.known_bodies import ball
from insole_core.workflows.calibration.chain_proof import ChainProof, prove_chain
from insole_core.workflows.calibration.sensor_store import SensorStore
from insole_core.workflows.make_foot import open_session, reconstruct_session
from insole_studio.cli.main import run

BALL = KnownRound("ball", 120, 120)


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A ball of 120 mm, captured like a foot with emulated devices."""
    options = SimulationOptions(
        seed=3, body=ball(120), distance_mm=700, frames=2, color_size=(640, 480)
    )
    folder = tmp_path_factory.mktemp("chain")
    simulated, captured = folder / "simulated", folder / "ball"
    write_session(simulate_session(options).session, simulated)
    store = SensorStore(folder / "sensors")
    for view in read_session(simulated).views:
        store.save(view.sensor)
    words = ["capture", "--emulate", str(simulated), "--out", str(captured), "--frames", "2"]
    assert run([*words, "--sensors", str(folder / "sensors")]) == 0
    return captured


@pytest.fixture(scope="module")
def proof(session: Path) -> ChainProof:
    return prove_chain([session], BALL)


def test_a_good_correction_stays_on(proof: ChainProof) -> None:
    evaluation = proof.evaluation
    without, learnt = evaluation.results["none"], evaluation.results["learnt"]
    assert proof.verdict.use == "learnt"
    assert proof.verdict.is_clear
    assert learnt.surface.all.mean_abs_mm < without.surface.all.mean_abs_mm - 0.05
    assert abs(learnt.size_error_mm) < 0.6
    assert learnt.surface.all.p95_mm < 1.2
    assert learnt.missing_share < 0.15
    assert [sensor.view for sensor in learnt.sensors] == ["left", "right", "top"]
    assert all(sensor.off_mm < 2 for sensor in learnt.sensors)


def test_every_class_is_a_part_of_the_whole(proof: ChainProof) -> None:
    surface = proof.evaluation.results["learnt"].surface
    whole = surface.all
    parts = [surface.over(surface.parts == number) for number in range(len(PARTS))]
    found = [part for part in parts if part is not None]
    assert sum(part.share for part in found) == pytest.approx(1, abs=0.01)
    mean = sum(part.share * part.mean_abs_mm for part in found)
    assert mean == pytest.approx(whole.mean_abs_mm, rel=0.02)
    facing_the_sole = surface.places_mm[surface.parts == PARTS.index("sole side")]
    assert (facing_the_sole[:, 2] < 0).all()
    assert (surface.distances_mm > 500).all()
    assert (surface.distances_mm < 1000).all()


def test_a_wrong_correction_is_switched_off(
    session: Path,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    forget_results: Callable[[], None],
) -> None:
    """One that moves readings the wrong way; the decision is used from then on, and reported."""
    forget_results()
    model = matching_error.MatchingModel.load()
    *layers, last = model.network.weights
    wrong = replace(model.network, weights=(*layers, -last))
    monkeypatch.setattr(matching_error, "_model", lambda: replace(model, network=wrong))
    report = tmp_path / "chain.json"
    sensors = ["--sensors", str(tmp_path / "sensors")]
    call = ["evaluate", "chain", str(session), "--ball", "--circumference", "376.5", "377.5"]
    assert run([*call, "--report", str(report), "--apply", *sensors]) == 0
    section = json.loads(report.read_text())["sections"]["chain"]
    (verdict,) = section["tables"]["Verdict"]
    assert verdict["use"] == "none"
    assert "makes it worse" in verdict["why"]
    numbers = {key: number["value"] for key, number in section["numbers"].items()}
    assert numbers["mean_abs_mm"] == numbers["mean_abs_mm_none"] < numbers["mean_abs_mm_learnt"]
    opened = open_session(session, sensors=tmp_path / "sensors")
    assert not opened.correction.corrected
    assert opened.correction.reason == verdict["why"]
    made = reconstruct_session(opened)
    assert made.correction_mm is None
    assert "found it to do harm" in made.warnings[-1]
    forget_results()


def test_where_nothing_is_learnt_there_is_nothing_to_choose(
    session: Path,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    forget_results: Callable[[], None],
    capsys: pytest.CaptureFixture[str],
) -> None:
    forget_results()
    monkeypatch.setattr(sensor, "KINECT_V1", replace(sensor.KINECT_V1, learnt=False))
    report, sensors = tmp_path / "report.json", tmp_path / "sensors"
    words = ["--report", str(report), "--sensors", str(sensors)]
    call = ["evaluate", "chain", str(session), "--ball", "--diameter", "120", "--apply"]
    assert run([*call, *words]) == 0
    (*_, told) = capsys.readouterr().err.splitlines()
    assert told.startswith("Warning: Nothing is stored. No correction is learnt for sensors of")
    assert not sensors.exists()
    tables = json.loads(report.read_text())["sections"]["chain"]["tables"]
    assert tables["Verdict"][0]["use"] == "none"
    for row in tables["Single readings of each sensor, in the place that fits it alone"]:
        assert row["mean without"] == row["mean learnt"]
    foot = ["reconstruct", str(session), "--out", str(tmp_path / "ball.ply")]
    sensors.mkdir()
    assert run([*foot, "--correction", "learnt", *words]) == 0
    assert "Warning: No correction is learnt for sensors of" in capsys.readouterr().err
    assert json.loads(report.read_text())["correction"]["used"] == "none"
    forget_results()


def with_size(evaluation: ChainEvaluation, key: str, error_mm: float) -> ChainEvaluation:
    results = dict(evaluation.results)
    result = results[key]  # type: ignore[index]
    results[key] = replace(result, size_mm=result.true_size_mm + error_mm)  # type: ignore[index]
    return replace(evaluation, results=results)


def test_verdict_by_size(proof: ChainProof) -> None:
    biased = with_size(with_size(proof.evaluation, "none", 0.1), "learnt", -0.9)
    assert judge(biased).use == "none"
    same = replace(
        proof.evaluation,
        results=dict.fromkeys(("none", "learnt"), proof.evaluation.results["none"]),
    )
    assert judge(same).use == "learnt"
    assert not judge(same).is_clear


def test_sessions_that_do_not_belong_together(session: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    other.mkdir()
    for path in session.rglob("*"):
        if path.is_file():
            copy = other / path.relative_to(session)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(path.read_bytes().replace(b"SIM000031", b"SIM000091"))
    with pytest.raises(UsageError, match="prove each set of sensors on its own"):
        prove_chain([session, other], BALL)


def test_no_session_counts_twice(session: Path) -> None:
    with pytest.raises(UsageError, match=r"ball is named twice; name each session once\."):
        prove_chain([session, session / ".." / session.name], BALL)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--ball"], "Give the size of the ball"),
        (["--ball", "--diameter", "12"], "must lie between 40 and 400"),
        (["--cylinder", "--diameter", "90", "95", "99"], "one number, or two"),
        (["--ball", "--diameter", "120", "--tolerance", "-1"], "tolerance"),
        (["--ball", "--diameter", "120", "--unit", "mm"], "--unit is that of a --scan"),
        (["--scan", "nowhere.stl", "--diameter", "120"], "tell the size themselves"),
        (["--ball", "--bar", "50", "50", "50"], "are of a printed body"),
        (["--scan", "nowhere.stl", "--bar", "50", "50", "50"], "Give both the drawn edges"),
    ],
)
def test_wrong_calls(words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "chain", "nowhere", *words]) == 2
    assert said in capsys.readouterr().err


def test_simulated_bodies_have_a_usual_size(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", str(tmp_path / "new"), "--ball", "12"]) == 2
    assert "from 40 to 400 mm" in capsys.readouterr().err
    assert run(["simulate", str(tmp_path / "new"), "--cylinder", "90", "--side", "both"]) == 2
    assert "takes the place of one foot" in capsys.readouterr().err


def test_missing_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    missing = str(tmp_path / "missing")
    assert run(["evaluate", "chain", missing, "--ball", "--diameter", "120"]) == 1
    assert "missing" in capsys.readouterr().err
    assert run(["evaluate", "chain", missing, "--scan", f"{missing}.stl"]) == 1
    assert "missing.stl" in capsys.readouterr().err


def test_both_feet() -> None:
    both = Path(__file__).parents[3] / "data" / "sessions" / "both_small.zip"
    with pytest.raises(UsageError, match="was recorded with both feet"):
        prove_chain([both], BALL)
