"""What a start loads: nothing that the call has no use for."""

from __future__ import annotations

import json
import subprocess
import sys

HEAVY = {"numpy", "scipy", "PySide6", "pyvista", "vtkmodules", "cv2", "matplotlib", "trimesh"}
SCIPY = {f"scipy.{part}" for part in ("interpolate", "linalg", "ndimage", "sparse", "spatial")}
LATER = {"pyvista", "pyvistaqt", "vtkmodules", "trimesh", "sqlalchemy", "PIL", *SCIPY}
TOLD = "print(json.dumps(sorted(sys.modules)))"


def loaded_by(*statements: str) -> set[str]:
    """Names of the modules that a fresh process holds after some statements."""
    code = "\n".join(("import json, sys", *statements, TOLD))
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return set(json.loads(done.stdout.splitlines()[-1]))


def test_help_loads_no_library_that_is_slow_to_load() -> None:
    loaded = loaded_by(
        "from insole_studio.cli.main import run",
        "try: run(['--help'])",
        "except SystemExit as end: assert end.code == 0",
    )
    assert "argparse" in loaded
    assert loaded & HEAVY == set()


def test_the_modules_of_the_window_leave_renderer_and_numerics_for_later() -> None:
    loaded = loaded_by("import insole_studio.app.bootstrap")
    assert "PySide6" in loaded
    assert loaded & {"matplotlib", *LATER} == set()


def test_the_empty_window_is_painted_before_renderer_and_numerics_are_loaded() -> None:
    loaded = loaded_by(
        "import os, pathlib, tempfile",
        "os.environ['QT_QPA_PLATFORM'] = 'offscreen'",
        "from insole_studio.app.bootstrap import build_application, qt_application",
        "from insole_studio.user_paths import UserPaths",
        "folder = pathlib.Path(tempfile.mkdtemp())",
        "places = UserPaths(folder / 'settings.json', folder / 'autosave')",
        "app = build_application(qt_application(), places)",
        "app.window.show()",
        "qt_application().processEvents()",
        "assert app.window.isVisible()",
        "app.close()",
    )
    assert loaded & LATER == set()
