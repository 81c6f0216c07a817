"""Other programs are started with the user's environment, not with that of the bundle."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

from insole_studio.services.other_programs import open_file, outside_bundle

BUNDLE = Path("/opt/insole studio/_internal")
HERS = os.pathsep.join(["/usr/bin", "/bin"])


def test_the_bundles_libraries_and_plugins_are_left_out() -> None:
    inside = {
        "LD_LIBRARY_PATH": str(BUNDLE),
        "QT_PLUGIN_PATH": str(BUNDLE / "PySide6" / "Qt" / "plugins"),
        "QML2_IMPORT_PATH": str(BUNDLE / "PySide6" / "Qt" / "qml"),
        "_PYI_ARCHIVE_FILE": "/opt/insole studio/insole-studio",
        "_PYI_PARENT_PROCESS_LEVEL": "1",
    }
    users = {"HOME": "/home/ann", "LANG": "sv_SE.UTF-8", "EMPTY": ""}
    path = os.pathsep.join([str(BUNDLE), HERS])
    assert outside_bundle({**inside, **users, "PATH": path}, BUNDLE) == {**users, "PATH": HERS}


def test_what_the_user_had_set_is_restored() -> None:
    set_by_loader = {
        "LD_LIBRARY_PATH": os.pathsep.join([str(BUNDLE), "/opt/hers"]),
        "LD_LIBRARY_PATH_ORIG": "/opt/hers",
        "OTHER_ORIG": "of somebody else",
    }
    assert outside_bundle(set_by_loader, BUNDLE) == {
        "LD_LIBRARY_PATH": "/opt/hers",
        "OTHER_ORIG": "of somebody else",
    }


def test_a_started_program_sees_it_and_this_one_keeps_its_own(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    seen: list[str] = []

    def start(url: QUrl) -> bool:
        code = "import os; print(os.environ.get('QT_PLUGIN_PATH'), os.environ['LIBPATH'])"
        call = [sys.executable, "-c", code]
        seen.append(subprocess.run(call, capture_output=True, text=True, check=True).stdout.strip())
        return url.toLocalFile() == str(tmp_path)

    monkeypatch.setattr(QDesktopServices, "openUrl", start)
    monkeypatch.setattr(sys, "_MEIPASS", str(BUNDLE), raising=False)
    monkeypatch.setenv("QT_PLUGIN_PATH", str(BUNDLE / "plugins"))
    monkeypatch.setenv("LIBPATH", str(BUNDLE))
    monkeypatch.setenv("LIBPATH_ORIG", "/opt/hers")
    before = dict(os.environ)
    assert open_file(tmp_path)
    assert seen == ["None /opt/hers"]
    assert dict(os.environ) == before
