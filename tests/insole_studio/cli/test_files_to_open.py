"""A file in the place of a command is opened in the window."""

from __future__ import annotations

from pathlib import Path

import pytest

from insole_studio.cli.main import run


@pytest.mark.parametrize(
    "words", [["anna.insole"], ["open", "anna.insole"], ["session"], ["gone.insole"], ["a b.stl"]]
)
def test_it_is_handed_to_the_window(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given: list[Path] = []

    def window(paths: list[Path], **_more: object) -> int:
        given.extend(paths)
        return 0

    monkeypatch.chdir(tmp_path)
    (tmp_path / "session").mkdir()
    monkeypatch.setattr("insole_studio.app.bootstrap.run_application", window)
    monkeypatch.setattr("insole_studio.app.screen.check_screen", lambda: None)
    with pytest.raises(SystemExit) as ended:
        run(words)
    assert ended.value.code == 0
    assert given == [Path(words[-1])]


def test_a_word_that_is_neither_is_no_file(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        run(["measur"])
    assert ended.value.code == 2
    assert "invalid choice: 'measur'" in capsys.readouterr().err


def test_days_are_taken_as_they_are_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for day in ("24.12.2026", "24/12/2026", "2026-12-24"):
        assert run(["records", "list", "--visits", day, "--record", str(tmp_path)]) == 2
        assert "does not exist; name the folder of a record" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        run(["records", "list", "--visits", "03/04/2026"])
    assert "write it as 2026-11-20" in capsys.readouterr().err
