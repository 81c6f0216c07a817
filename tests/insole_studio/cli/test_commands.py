"""The commands without a screen, as another program calls them."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.spatial import cKDTree

from insole_core.formats.ply import write_ply
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import rigid, rotation_about
from insole_core.recording.hand_edits import HandEdits, ViewEdits
from insole_core.recording.hand_edits_file import write_edits
from insole_core.simulate import FootShape, build_foot
from insole_studio.cli.main import run
from tests.patience import PATIENCE_S

SMALL_SESSION = Path(__file__).parents[2] / "data" / "sessions" / "left_small.zip"


def last_line(capsys: pytest.CaptureFixture[str]) -> str:
    return capsys.readouterr().err.strip().splitlines()[-1]


@pytest.fixture(scope="module")
def right_foot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A right foot as a scanner might hand it over: metres, turned, somewhere."""
    mesh = build_foot(FootShape(side=Side.RIGHT), np.random.default_rng(1), cell_mm=3.0).mesh
    turned = mesh.transformed(
        rigid(rotation_about(np.array([1.0, 2, 0.5]), 130), np.array([300.0, -80, 1000]))
    )
    path = tmp_path_factory.mktemp("scan") / "scan.ply"
    write_ply(TriangleMesh(turned.vertices / 1000, turned.triangles), path)
    return path


def test_session_becomes_a_foot_with_a_report(tmp_path: Path) -> None:
    out, report = tmp_path / "foot.ply", tmp_path / "report.json"
    assert run(["reconstruct", str(SMALL_SESSION), "--out", str(out), "--report", str(report)]) == 0
    foot = trimesh.load(out, process=False)
    values = json.loads(report.read_text())
    assert len(foot.vertices) == values["vertices"]
    assert len(foot.faces) == values["triangles"]
    assert [view["name"] for view in values["views"]] == ["left", "right", "top"]
    for view in values["views"]:
        assert view["used"]
        assert view["markers_found"] >= view["markers_used"] >= 6
        assert 0 < view["residual_mm"]["mean"] <= view["residual_mm"]["max"]
        assert np.shape(view["sensor2reference"]) == (4, 4)
    assert values["seconds"]["total"] > 0
    assert values["warnings"] == []


@pytest.mark.fine
def test_a_session_becomes_a_closed_insole(tmp_path: Path) -> None:
    out = tmp_path / "insole.stl"
    assert run(["design", str(SMALL_SESSION), "--out", str(out)]) == 0
    insole = trimesh.load(out)
    assert insole.is_watertight
    assert insole.is_winding_consistent
    assert insole.volume > 1e5
    assert len(insole.faces) > 80_000, "of the coarse grid there are half as many"


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["insole", "block", "positive"])
def test_every_kind_stands_on_its_base_plane(kind: str, right_foot: Path, tmp_path: Path) -> None:
    out = tmp_path / "solid.stl"
    call = ["design", str(right_foot), "--side", "right", "--kind", kind, "--out", str(out)]
    assert run(call) == 0
    solid = trimesh.load(out)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert solid.volume > 1e5
    assert solid.bounds[0, 2] == pytest.approx(0, abs=1e-4)
    # The big toe lies at -x in the insole frame of a right foot, at +x in the turned mould.
    front = solid.vertices[solid.vertices[:, 1] > 0.98 * solid.bounds[1, 1]]
    if kind != "block":
        assert np.sign(front[:, 0].mean()) == (1 if kind == "positive" else -1)


def designed_volume(right_foot: Path, out: Path) -> float:
    assert run(["design", str(right_foot), "--side", "right", "--out", str(out)]) == 0
    return float(trimesh.load_mesh(out, process=False).volume)


@pytest.fixture(scope="module")
def stl_volume(right_foot: Path, tmp_path_factory: pytest.TempPathFactory) -> float:
    return designed_volume(right_foot, tmp_path_factory.mktemp("stl") / "insole.stl")


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".3mf", ".ply", ".obj"])
def test_every_format_holds_the_same_insole(
    suffix: str, right_foot: Path, stl_volume: float, tmp_path: Path
) -> None:
    volume = designed_volume(right_foot, tmp_path / f"insole{suffix}")
    assert volume == pytest.approx(stl_volume, rel=1e-4)


@pytest.mark.slow
def test_prescription_raises_its_pelott(right_foot: Path, tmp_path: Path) -> None:
    pelott = {
        "type": "pelott", "shape": "egg", "centre_mm": [-8.3, 140.4],
        "length_mm": 60, "width_mm": 40, "height_mm": 6, "turn_deg": 10,
    }  # fmt: skip
    tops = {}
    for name, corrections in {"with": [pelott], "without": []}.items():
        prescription = tmp_path / f"{name}.json"
        prescription.write_text(
            json.dumps({"format": "insole-design", "version": 1, "side": "right",
                        "corrections": corrections, "thickness_mm": 3, "grid_mm": 1.0})
        )  # fmt: skip
        out = tmp_path / f"{name}.stl"
        call = ["design", str(right_foot), "--side", "right", "--out", str(out)]
        assert run([*call, "--prescription", str(prescription)]) == 0
        vertices = trimesh.load(out).vertices
        tops[name] = np.asarray(vertices[vertices[:, 2] > 0])
    # Both tops stand on the same grid.
    _, plain = cKDTree(tops["without"][:, :2]).query(tops["with"][:, :2])
    raised = tops["with"][:, 2] - tops["without"][plain, 2]
    # The top is so flat that rounding decides which of its vertices is the highest.
    apex = tops["with"][raised > raised.max() - 0.02].mean(axis=0)
    assert raised.max() == pytest.approx(6, abs=0.2)
    assert np.hypot(apex[0] + 8.3, apex[1] - 140.4) <= 0.5
    assert raised.min() == pytest.approx(0, abs=1e-3)


@pytest.mark.slow
def test_side_that_contradicts_the_shape(
    right_foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call = ["design", str(right_foot), "--side", "left", "--out", str(tmp_path / "i.stl")]
    assert run(call) == 1
    assert "looks like a right foot" in last_line(capsys)
    assert list(tmp_path.iterdir()) == []
    assert run([*call, "--force"]) == 0


@pytest.mark.slow
def test_reconstruct_heeds_corrections_by_hand_and_limits(tmp_path: Path) -> None:
    session = tmp_path / "session.zip"
    shutil.copy(SMALL_SESSION, session)
    edits = HandEdits().with_view("left", ViewEdits(excluded=("S3",)))
    write_edits(edits, session)
    report, out = tmp_path / "report.json", tmp_path / "foot.ply"
    call = ["reconstruct", str(session), "--out", str(out), "--report", str(report)]
    assert run([*call, "--largest-displacement-mm", "0.7"]) == 0
    told = json.loads(report.read_text())
    assert [view["used"] for view in told["views"]] == [True, True, False]
    assert "mm uncertain at the foot, more than 0.7" in told["views"][2]["reason"]
    assert [m["id"] for m in told["views"][0]["markers"] if m["excluded"]] == ["S3"]
    assert any("markers of the view left were corrected by hand" in w for w in told["warnings"])


WRONG_CALLS = {
    "side against the manifest": (
        ["design", str(SMALL_SESSION), "--side", "right", "--out", "{tmp}/i.stl"],
        "was recorded as the left foot",
    ),
    "mesh without side": (["design", "{foot}", "--out", "{tmp}/i.stl"], "add --side"),
    "a limit of nothing": (
        ["reconstruct", str(SMALL_SESSION), "--out", "{tmp}/f.ply", "--largest-residual-mm", "0"],
        "--largest-residual-mm is 0, but must be above 0",
    ),
    "foot as STL": (["reconstruct", str(SMALL_SESSION), "--out", "{tmp}/f.stl"], "is written as"),
    "insole as picture": (
        ["design", "{foot}", "--side", "right", "--out", "{tmp}/i.png"],
        "choose .stl, .3mf, .ply, .obj",
    ),
}


@pytest.mark.parametrize("name", WRONG_CALLS)
def test_wrong_calls(
    name: str, right_foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call, expected = WRONG_CALLS[name]
    assert run([word.format(tmp=tmp_path, foot=right_foot) for word in call]) == 2
    assert expected in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


def test_unknown_command_is_a_wrong_call(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        run(["reconstrukt"])
    assert ended.value.code == 2


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (["design"], "the following arguments are required"),
        (["design", "f.ply", "--out", "i.stl", "--deviation", "nan"], "nan is no usual number"),
        (["design", "f.ply", "--out", "i.stl", "--draft", "-inf"], "expected one argument"),
        (["simulate", "s", "--distance", "1e308"], "1e308 is no usual number"),
        (["simulate", "s", "--seed", "7" * 400], "77… is no usual number"),
        (["simulate", "s", "--side", "x" * 5000], "invalid choice"),
        (["simulate", "s", "--disturbed", "rain"], "invalid choice"),
    ],
)
def test_wrong_arguments_name_a_remedy(
    call: list[str], words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        run(call)
    assert ended.value.code == 2
    said = last_line(capsys)
    assert words in said
    assert said.endswith(f"insole-studio {call[0]} --help says what can be given.")
    assert len(said) < 500


@pytest.mark.parametrize("option", ["--gap", "--margin"])
@pytest.mark.parametrize("value", ["-1", "101"])
def test_a_nest_with_impossible_distances_is_a_wrong_call(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], option: str, value: str
) -> None:
    call = ["order", "nest", str(tmp_path / "none.zip"), "--size", "1000x600x30"]
    assert run([*call, "--out", str(tmp_path / "n.3mf"), option, value]) == 2
    assert last_line(capsys) == f"{option} is {value}, and must be 0 to 100 mm."


FAILURES = {
    "no such session": (["reconstruct", "{tmp}/none", "--out", "{tmp}/f.ply"], "does not exist"),
    "mesh for a session": (["reconstruct", "{foot}", "--out", "{tmp}/f.ply"], "not a readable zip"),
    "no folder for the foot": (
        ["reconstruct", str(SMALL_SESSION), "--out", "{tmp}/no/f.ply"],
        "its folder does not exist",
    ),
    "no folder for the report": (
        ["reconstruct", str(SMALL_SESSION), "--out", "{tmp}/f.ply", "--report", "{tmp}/no/r.json"],
        "its folder does not exist",
    ),
    "no prescription": (
        [
            "design",
            "{foot}",
            "--side",
            "right",
            "--out",
            "{tmp}/i.stl",
            "--prescription",
            "{tmp}/x",
        ],
        "",
    ),
}


@pytest.mark.parametrize("name", FAILURES)
def test_failures_leave_nothing_behind(
    name: str, right_foot: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    call, expected = FAILURES[name]
    assert run([word.format(tmp=tmp_path, foot=right_foot) for word in call]) == 1
    assert expected in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("option", [["--walls", "w"], ["--learnt-from", "12"]])
def test_walls_are_for_infrared_pictures(
    option: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["simulate", str(tmp_path / "s"), *option]) == 2
    assert last_line(capsys).endswith("are for infrared pictures; add --infrared.")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (["simulate", "{tmp}/s", "--wall-count", "3"], "--wall-count is for the walls of --walls"),
        (["simulate", "{tmp}/s", "--infrared-frames", "3"], "--infrared-frames is for infrared"),
        (
            ["reconstruct", str(SMALL_SESSION), "--out", "{tmp}/f.ply", "--sensors", "{tmp}/no"],
            "no such folder is there",
        ),
    ],
)
def test_an_option_without_effect_is_refused(
    call: list[str], words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run([word.format(tmp=tmp_path) for word in call]) == 2
    assert words in last_line(capsys)
    assert list(tmp_path.iterdir()) == []


def test_existing_output_survives_a_failure(tmp_path: Path) -> None:
    out = tmp_path / "foot.ply"
    out.write_text("of yesterday")
    assert run(["reconstruct", str(tmp_path / "none"), "--out", str(out)]) == 1
    assert out.read_text() == "of yesterday"


@pytest.mark.slow
@pytest.mark.usefixtures("simulated_once")
def test_simulation_is_a_session_with_its_truth(tmp_path: Path) -> None:
    out = tmp_path / "session.zip"
    assert run(["simulate", str(out), "--ideal", "--color-size", "640x480"]) == 0
    assert run(["reconstruct", str(out), "--out", str(tmp_path / "foot.ply")]) == 0


# A shell starts what runs in its background deaf to SIGINT, and nohup deaf to SIGHUP; so are the
# tests that they start.
HEEDING_SIGNALS = ("env", "--default-signal=INT,HUP") if sys.platform == "linux" else ()


@pytest.mark.parametrize("end", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_stopped_process_leaves_nothing_behind(tmp_path: Path, end: signal.Signals) -> None:
    process = subprocess.Popen(
        [
            *HEEDING_SIGNALS,
            sys.executable,
            "-m",
            "insole_studio",
            "simulate",
            str(tmp_path / "session"),
        ],
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    )
    assert process.stderr is not None
    process.stderr.readline()
    process.send_signal(end)
    _, errors = process.communicate(timeout=PATIENCE_S)
    assert process.returncode == 128 + end
    assert errors.strip().splitlines()[-1] == "Stopped on request; nothing was written."
    assert list(tmp_path.iterdir()) == []


STOPPED_WHERE_ALL_IS_CAUGHT = """
import contextlib, os, signal, sys
from insole_studio.cli import main

def where_all_is_caught(*_):
    with contextlib.suppress(BaseException):
        os.kill(os.getpid(), signal.SIGTERM)

main.check_paths = where_all_is_caught
sys.exit(main.run(sys.argv[1:]))
"""


def test_signal_that_a_library_drops_still_stops_the_command(tmp_path: Path) -> None:
    call = [sys.executable, "-c", STOPPED_WHERE_ALL_IS_CAUGHT, "simulate", str(tmp_path / "out")]
    ended = subprocess.run(call, check=False, timeout=PATIENCE_S, stderr=subprocess.PIPE, text=True)
    assert ended.returncode == 128 + signal.SIGTERM
    assert ended.stderr.strip() == "Stopped on request; nothing was written."
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_killed_process_leaves_the_old_result(tmp_path: Path) -> None:
    out = tmp_path / "session.zip"
    out.write_text("of yesterday")
    process = subprocess.Popen(
        [
            sys.executable,
            "-m",
            "insole_studio",
            "simulate",
            str(out),
            "--ideal",
            "--color-size",
            "640x480",
        ],
        stderr=subprocess.PIPE,
        text=True,
    )
    assert process.stderr is not None
    while "Writing" not in process.stderr.readline():
        pass
    process.kill()
    process.communicate(timeout=PATIENCE_S)
    assert out.read_text() == "of yesterday"


@pytest.mark.slow
def test_both_feet_are_measured_with_their_asymmetry(right_foot: Path, tmp_path: Path) -> None:
    report, table = tmp_path / "measures.json", tmp_path / "measures.csv"
    call = ["measure", str(SMALL_SESSION), "--other", str(right_foot)]
    assert run([*call, "--report", str(report), "--csv", str(table)]) == 0
    content = json.loads(report.read_text())
    assert (content["side"], content["other"]["side"]) == ("left", "right")
    left, right = (c["measures"]["foot_length"] for c in (content, content["other"]))
    length = content["asymmetry"]["foot_length"]
    assert length["difference"] == pytest.approx(left - right, abs=2e-3)
    assert length["percent"] == pytest.approx(200 * (left - right) / (left + right), abs=0.01)
    assert content["limits_by"]["foot_length"] == "simulation"
    assert content["other"]["limits_by"]["foot_length"] == "another scanner"
    assert 0.5 < content["limits_95"]["foot_length"] < 3
    assert length["limits_95"] is length["within_error"] is None
    head, first, *_ = table.read_text().splitlines()
    assert head.startswith("measure,unit,left,right,difference,percent,positive,left_limits_95,")
    assert first == f"foot_length,mm,{left:.3f},{right:.3f},{first.split(',', 4)[4]}"


@pytest.mark.slow
def test_the_other_foot_must_be_the_other(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = tmp_path / "measures.json"
    call = ["measure", str(SMALL_SESSION), "--other", str(SMALL_SESSION)]
    assert run([*call, "--report", str(report)]) == 2
    assert "--other" in last_line(capsys)
    assert not report.exists()


def test_the_command_sets_the_threads_of_linear_algebra_before_numpy_reads_them() -> None:
    code = "import sys, insole_studio.__main__; print('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of Windows end without a signal")
def test_reader_that_has_read_enough_ends_a_command_without_a_complaint() -> None:
    read, write = os.pipe()
    os.close(read)
    code = "import sys; from insole_studio.cli.main import run; sys.exit(run(['devices']))"
    done = subprocess.run(
        [sys.executable, "-c", code], stdout=write, stderr=subprocess.PIPE, text=True, check=False
    )
    os.close(write)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, "")


def test_both_feet_of_a_session_are_written_beside_each_other(
    small_session: Path, tmp_path: Path
) -> None:
    out, report = tmp_path / "foot.ply", tmp_path / "report.json"
    both = str(small_session.with_name("both_small.zip"))
    call = ["reconstruct", both, "--method", "thesis", "--out", str(out), "--report", str(report)]
    assert run(call) == 0
    assert {path.name for path in tmp_path.glob("*.ply")} == {"foot_left.ply", "foot_right.ply"}
    reports = json.loads(report.read_text())["feet"]
    assert [len(reports[side]["views"]) for side in ("left", "right")] == [4, 4]
    lengths = [
        np.ptp(trimesh.load(tmp_path / f"foot_{side}.ply", process=False).vertices[:, 1])
        for side in ("left", "right")
    ]
    assert lengths[0] > lengths[1] + 10  # as simulated


def test_one_foot_of_both_is_named(
    small_session: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    both, report = str(small_session.with_name("both_small.zip")), tmp_path / "m.json"
    assert run(["measure", both, "--report", str(report)]) == 2
    assert "both feet; say which one, with --side left or --side right" in capsys.readouterr().err
    assert not report.exists()


@pytest.mark.slow
def test_both_feet_of_a_session_are_designed_in_one_go(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "insole.stl"
    assert run(["design", str(SMALL_SESSION.with_name("both_small.zip")), "--out", str(out)]) == 0
    told = capsys.readouterr().err
    assert told.count("Reading the session") == 1
    paths = [tmp_path / f"insole_{side}.stl" for side in ("left", "right")]
    written = [trimesh.load(path, process=False) for path in paths]
    left, right = (piece.extents[1] for piece in written)
    assert left > right + 10  # the simulated left foot is 15 mm longer
    assert [path.name for path in sorted(tmp_path.iterdir())] == [
        "insole_left.stl", "insole_right.stl",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["evaluate", "noise", "still", "--every", "0"], "--every: 0 is not above 0"),
        (["evaluate", "noise", "still", "--every", "-3"], "--every: -3 is not above 0"),
        (["design", "f.ply", "--out", "i.stl", "--triangles", "0"], "--triangles: 0 is less than"),
        (["order", "create", "c", "--out", "o", "--triangles", "0"], "--triangles: 0 is less than"),
        (["order", "create", "c", "--out", "o", "--quantity", "0"], "--quantity: 0 is less than 1"),
        (
            ["order", "create", "c", "--out", "o", "--quantity", "two"],
            "--quantity: two is no whole number of 1 or more;",
        ),
        (["records", "restore", "b", "--snapshot", "x"], "--snapshot: x is no whole number;"),
        (["simulate", "o.zip", "--seed", "1.5"], "--seed: 1.5 is no whole number;"),
        (
            ["order", "nest", "o", "--out", "n.3mf", "--size", "9x9x9", "--gap", "100,3"],
            "--gap: 100,3 is no number; write one with a point and no comma, such as 100.3;",
        ),
        (
            ["records", "accounts", "add", "e", "--full-name", "E", "--role", "king"],
            "--role: invalid choice: 'king' (choose from",
        ),
        (
            ["pressure-change", "a.insole", "b", "--weight-kg", "70", "--at", "12,x"],
            "'12,x' is no place; give x and y in mm",
        ),
        (["pressure", "m.csv", "--pitch", "a"], "'a' is no distance of sensors"),
        (["pressure", "m.csv", "--step", "one"], "--step: one is no whole number"),
    ],
)
def test_a_number_that_cannot_be_is_refused_before_anything_is_read(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        run(words)
    assert ended.value.code == 2
    assert told in capsys.readouterr().err
