from __future__ import annotations

import json
import logging
from pathlib import Path

import pytest

from insole_core.messages import Message
from insole_studio.document.record_location import location_of_window
from insole_studio.settings import RECENT_COUNT, Settings, load_settings, save_settings
from insole_studio.user_paths import UserPaths


def test_what_is_saved_comes_back(tmp_path: Path) -> None:
    settings = Settings(theme="dark", linked_views=False, recent=["a"])
    save_settings(settings, tmp_path / "new" / "settings.json")
    assert load_settings(tmp_path / "new" / "settings.json") == settings


def test_absent_settings_are_the_defaults(tmp_path: Path) -> None:
    assert load_settings(tmp_path / "none.json") == Settings()


@pytest.mark.parametrize("text", ["", "{", "[1]", "\x00", "[" * 100_000])
def test_unreadable_settings_are_the_defaults(tmp_path: Path, text: str) -> None:
    (tmp_path / "settings.json").write_text(text)
    assert load_settings(tmp_path / "settings.json") == Settings()


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("theme", "pink"),
        ("theme", ["dark"]),
        ("touch", 1),
        ("author", None),
        ("recent", [1]),
        ("largest_residual_mm", True),
        ("largest_residual_mm", "3"),
        ("largest_residual_mm", float("nan")),
        ("largest_residual_mm", 10**400),
    ],
)
def test_a_bad_entry_costs_a_warning(
    tmp_path: Path, caplog: pytest.LogCaptureFixture, key: str, value: object
) -> None:
    stored = {key: value, "linked_views": False, "unknown": 1}
    (tmp_path / "settings.json").write_text(json.dumps(stored))
    with caplog.at_level(logging.WARNING):
        settings = load_settings(tmp_path / "settings.json")
    assert settings == Settings(linked_views=False)
    assert key in caplog.text
    assert "unknown" not in caplog.text


def test_settings_of_an_earlier_program_are_kept(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    stored = {"version": 1, "theme": "dark", "largest_residual_mm": 4}
    (tmp_path / "settings.json").write_text(json.dumps(stored))
    assert load_settings(tmp_path / "settings.json") == Settings(
        theme="dark", largest_residual_mm=4.0
    )
    assert caplog.text == ""


def test_settings_of_a_newer_program_outlive_an_older_one(tmp_path: Path) -> None:
    path = tmp_path / "settings.json"
    path.write_text('{"theme": "dark", "of_next_year": [1, 2]}', encoding="utf-8")
    settings = load_settings(path)
    settings.language = "sv"
    save_settings(settings, path)
    stored = json.loads(path.read_text(encoding="utf-8"))
    assert (stored["theme"], stored["language"], stored["of_next_year"]) == ("dark", "sv", [1, 2])


def test_recent_files_are_few_and_newest_first() -> None:
    settings = Settings()
    for number in range(RECENT_COUNT + 3):
        settings.remember(Path(f"/case-{number}"))
    settings.remember(Path("/case-5"))
    assert settings.recent[0] == str(Path("/case-5"))
    assert len(settings.recent) == len(set(settings.recent)) == RECENT_COUNT


@pytest.mark.parametrize("page", ["stations.md", "sv/stations.md"])
def test_what_the_manual_lets_an_administrator_preset_is_the_record_of_the_window(
    tmp_path: Path, page: str
) -> None:
    manual = Path(__file__).parents[2] / "docs" / "manual" / page
    preset = manual.read_text("utf-8").partition("```json\n")[2].partition("```")[0]
    paths = UserPaths(tmp_path / "settings.json", tmp_path / "autosave")
    paths.settings_file.write_text(preset, "utf-8")
    complaints: list[Message] = []
    load_settings(paths.settings_file, complaints.append)
    assert complaints == []
    place = location_of_window(paths).place()
    assert place.name == "server/records"
    assert place.contents == Path("/mnt/insole")
