"""Reading of pressure maps: real exports, tables of other programs, and what is none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from insole_core.errors import InputError
from insole_core.geometry.side import Side
from insole_core.pressure.read_pressure import read_pressure
from insole_core.pressure.recording import Answers, PressureUnit, Question, SeenFrom

_XSENSOR = """File:,"walk.XSN",,
,,,
Units:,mmHg,,
,,,
FRAME,1,,
,,,
{sensors}
GROUP,1,,
,,,
Name,Left Heel,,
,,,
SENSELS,,,
,,,
1,2,3,4
,,,
"""
_SENSOR = """SENSOR,HX210-{name} S0073,,
,,,
Rows,2,,
,,,
Columns,3,,
,,,
Sensel Width (cm),0.86,,
,,,
Sensel Height (cm),0.86,,
,,,
SENSELS,,,
,,,
0,100,{peak},
,,,
0,0,50.5,
,,,
"""


def _written(path: Path, text: str, encoding: str = "utf-8") -> Path:
    path.write_text(text, encoding=encoding)
    return path


def _table(rows: list[str]) -> str:
    return "\n".join(rows * 4) + "\n"


@pytest.mark.shared
def test_emed_is_read_and_agrees_with_the_forces_it_states(shared_data: Path) -> None:
    (recording,) = read_pressure(shared_data / "pressure" / "emed_test.lst")
    assert recording.values.shape == (106, 54, 22)
    assert (recording.pitch_mm, recording.unit) == ((5.0, 5.0), PressureUnit.KPA)
    assert recording.questions == (Question.SIDE,)
    (step,) = recording.steps()
    assert recording.peak(step).max() == pytest.approx(370)
    assert recording.mean(step).max() < 370


@pytest.mark.shared
def test_a_damaged_emed_file_is_refused(shared_data: Path, tmp_path: Path) -> None:
    text = (shared_data / "pressure" / "emed_test.lst").read_text("latin-1")
    with pytest.raises(InputError, match="do not make up the force"):
        read_pressure(_written(tmp_path / "a.lst", text.replace("\t35.00", "\t95.00"), "latin-1"))
    for share in (0.3, 0.71, 0.99):
        with pytest.raises(InputError):
            read_pressure(_written(tmp_path / "b.lst", text[: int(share * len(text))], "latin-1"))


@pytest.mark.shared
def test_f_scan_is_read_with_the_outline_of_its_sensor(shared_data: Path, tmp_path: Path) -> None:
    path = shared_data / "pressure" / "fscan_testL.asf"
    (recording,) = read_pressure(path)
    assert recording.values.shape == (205, 60, 21)
    assert recording.pitch_mm == (5.08, 5.08)
    assert np.isnan(recording.values[0, 0, 0])
    assert recording.values[0, 20, 5] == 18
    assert len(recording.steps()) == 6
    text = path.read_text()
    with pytest.raises(InputError, match="cut off"):
        read_pressure(_written(tmp_path / "cut.asf", text[: len(text) // 2]))
    with pytest.raises(InputError, match="unit"):
        read_pressure(_written(tmp_path / "raw.asf", text.replace("UNITS KPa", "UNITS RAW")))
    for rows in ("0", "-1"):
        changed = _written(tmp_path / "rows.asf", text.replace("ROWS 60", f"ROWS {rows}"))
        with pytest.raises(InputError, match="holds no frame"):
            read_pressure(changed)


@pytest.mark.shared
def test_pedar_asks_which_insole_is_the_left_one_and_how_long_it_is(shared_data: Path) -> None:
    first, second = read_pressure(shared_data / "pressure" / "pedar_example.asc")
    assert first.questions == second.questions == (Question.LENGTH, Question.SIDE)
    left = first.answered(Answers(side=Side.LEFT, length_mm=270))
    right = first.answered(Answers(side=Side.RIGHT, length_mm=270))
    assert left.pitch_mm == (5.0, 5.0)
    assert np.array_equal(left.peak(), right.peak()[:, ::-1], equal_nan=True)
    # The lateral border of the midfoot carries; it is at the left of a left insole.
    midfoot = np.nan_to_num(left.mean()[24:32])
    assert midfoot[:, :3].mean() > 1.5 * midfoot[:, 5:8].mean()


def test_xsensor_tells_the_feet_and_leaves_out_its_groups(tmp_path: Path) -> None:
    sensors = "".join(
        _SENSOR.format(name=name, peak=peak) for name, peak in (("LF", 2000), ("RF", 300))
    )
    path = _written(tmp_path / "walk.csv", _XSENSOR.format(sensors=sensors))
    left, right = read_pressure(path)
    assert (left.side, right.side) == (Side.LEFT, Side.RIGHT)
    assert left.questions == ()
    assert left.pitch_mm == pytest.approx((8.6, 8.6))
    assert left.peak() == pytest.approx(np.array([[0, 13.33, 266.6], [0, 0, 6.73]]), rel=1e-3)
    assert right.peak().max() == pytest.approx(40.0, rel=1e-3)


FOOTSCAN = "Entire plate roll off\n" + "".join(
    f"Frame {number} ({8 * number} ms)\n0\t0\t1,9\n" + "0\t{heel}\t0\n" + "0\t0\t0\n" * 5
    for number in range(2)
)


def test_a_table_of_footscan_says_what_its_numbers_are(tmp_path: Path) -> None:
    text = FOOTSCAN.format(heel="3,87096")
    (recording,) = read_pressure(_written(tmp_path / "roll off.txt", text))
    assert (recording.device, recording.questions) == ("footscan", (Question.SIDE,))
    assert recording.values.shape == (2, 7, 3)
    # 3.87 N on 5.08 x 7.62 mm are 100 kPa.
    assert recording.peak()[1, 1] == pytest.approx(100.05, abs=0.1)


@pytest.mark.parametrize(
    "row",
    ["0;12,5;200,25;3", "0\t12.5\t200.25\t3", "0,12.5,200.25,3,", "0 12.5 200.25 3",
     '0; 12,5 ;200,25;3;'],
)  # fmt: skip
def test_a_table_is_read_whatever_separates_its_numbers(tmp_path: Path, row: str) -> None:
    text = "Clinic X\nunit: kPa\npitch_mm: 5 x 7,5\n" + _table([row, row])
    (recording,) = read_pressure(_written(tmp_path / "map.csv", text))
    assert recording.values.shape == (1, 8, 4)
    assert recording.pitch_mm == (5.0, 7.5)
    assert recording.questions == (Question.SIDE, Question.SEEN_FROM)
    assert recording.peak()[0] == pytest.approx([0, 12.5, 200.25, 3])


def test_what_a_table_does_not_say_is_asked(tmp_path: Path) -> None:
    text = "Frame 0\n" + _table(["0;1;2"] * 2) + "\nFrame 1\n" + _table(["0;3;1"] * 2)
    (recording,) = read_pressure(_written(tmp_path / "map.txt", text))
    assert recording.values.shape == (2, 8, 3)
    assert set(recording.questions) == {
        Question.PITCH, Question.UNIT, Question.SIDE, Question.SEEN_FROM,
    }  # fmt: skip
    with pytest.raises(InputError, match="unit"):
        recording.peak()
    newton = Answers(Side.LEFT, (5.08, 7.62), unit=PressureUnit.NEWTON, seen_from=SeenFrom.ABOVE)
    known = recording.answered(newton)
    assert known.questions == ()
    assert known.peak().max() == pytest.approx(3 / (5.08 * 7.62) * 1000)
    assert known.frame(0).max() == pytest.approx(2 / (5.08 * 7.62) * 1000)
    with pytest.raises(InputError, match="no frame 3"):
        known.frame(2)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "no table"),
        (b"hello;world;again\n" * 20, "no table"),
        (b"1;2;3\n" * 8 + b"1;2;3;4\n" * 8, "differ in length"),
        (b"1;2;3\n" * 8 + b"\n" + b"1;2;3\n" * 9, "frames differ"),
        (b"1;-2;3\n" * 8, "below 0"),
        (b"1;1e308;3\n" * 8, "no device measures"),
        (b"1;1e30;3\n" * 8, "no device measures"),
        (b"PK\x03\x04" + b"x" * 99, "no text"),
        (b"1;2;3\n\0" * 8, "no text"),
        ((b";".join([b"1"] * 600) + b"\n") * 8, "more sensors"),
        (b"pitch_mm: five\n" + b"1;2;3\n" * 8, "no distance"),
        (b"pitch_mm: 80\n" + b"1;2;3\n" * 8, "80 mm apart"),
    ],
)
def test_what_is_no_map_is_refused_in_words(tmp_path: Path, content: bytes, reason: str) -> None:
    path = tmp_path / "map.csv"
    path.write_bytes(content)
    with pytest.raises(InputError, match=reason):
        read_pressure(path)


def test_pressures_that_no_foot_makes_are_refused(tmp_path: Path) -> None:
    path = _written(tmp_path / "map.csv", "unit: N/cm2\npitch_mm: 5\n" + _table(["0;900;1"] * 2))
    (recording,) = read_pressure(path)
    with pytest.raises(InputError, match="check the unit"):
        recording.peak()
    with pytest.raises(InputError, match="must be 1 to 30"):
        recording.answered(Answers(pitch_mm=(0.5, 5)))


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("a.asc", "mat type s2160_001\npressure values in kPa\ntime[secs] 4 5\n", "of pliance"),
        ("a.csv", "timestamp,sole_id,corrupt,pressure_01,pressure_02\n1,1,0,3,4\n", "of StappOne"),
        ("a.lst", "version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "Git LFS"),
    ],
)
def test_a_device_that_is_not_read_is_named(
    tmp_path: Path, name: str, text: str, reason: str
) -> None:
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match=reason):
        read_pressure(path)
