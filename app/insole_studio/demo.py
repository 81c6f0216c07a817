"""``python -m insole_studio.demo``: try the product on a recorded session and the bundled case.

With a screen it opens the window on the case. Without one it does the same work in the real window
on a virtual screen (or, where there is none, in Qt's offscreen mode), writes the insoles and
pictures of the window, and says where.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

from insole_core.resources import resource_path
from insole_studio.app.recorded_session import record_simulated
from insole_studio.app.screen import has_screen

OUTPUT = Path("demo-output")
SESSION = OUTPUT / "session.zip"
EXAMPLE = "example/example.insole"
_VIRTUAL = "INSOLE_STUDIO_DEMO_VIRTUAL"


def main() -> int:
    """Demonstrate the product; return the exit code."""
    OUTPUT.mkdir(exist_ok=True)
    if not SESSION.exists():
        print("Simulating a recorded session of three views …", flush=True)
        record_simulated(SESSION)
    if os.environ.get(_VIRTUAL):
        return _scripted()
    if has_screen():
        print(f"Opening the window on the bundled case; {SESSION} is a scan to import.", flush=True)
        return _interactive()
    print("There is no screen: doing the same off-screen.", flush=True)
    return _virtual()


def _interactive() -> int:
    from insole_studio.app.bootstrap import run_application

    case = OUTPUT / "example.insole"
    shutil.copyfile(resource_path(EXAMPLE), case)  # what is tried is saved here
    return run_application([case])


def _virtual() -> int:
    """Start this module again on a virtual screen."""
    call = [sys.executable, "-m", "insole_studio.demo"]
    environment = {**os.environ, _VIRTUAL: "1"}
    if shutil.which("xvfb-run"):
        call = ["xvfb-run", "-a", "-s", "-screen 0 1920x1200x24", *call]
        environment["QT_QPA_PLATFORM"] = "xcb"
    else:
        environment["QT_QPA_PLATFORM"] = "offscreen"
    return subprocess.run(call, env=environment, check=False).returncode


def _scripted() -> int:
    from insole_studio.app.scripted import ScriptedAnswers, ScriptedWindow
    from insole_studio.user_paths import UserPaths

    paths = UserPaths(OUTPUT / "settings.json", OUTPUT / "autosave")
    answers = ScriptedAnswers(replace=True)  # written by an earlier demonstration
    written = [OUTPUT / "session.png", OUTPUT / "case.png"]
    with ScriptedWindow(paths, answers=answers) as studio:
        studio.open(SESSION)
        studio.place_pelott(0.0, 140.0)
        studio.screenshot(OUTPUT / "session.png")
        written += studio.export(OUTPUT / "session-insole.stl")
    with ScriptedWindow(paths, answers=answers) as studio:
        studio.open(resource_path(EXAMPLE))
        studio.screenshot(OUTPUT / "case.png")
        written += studio.export(OUTPUT / "case-insole.stl")
    print(f"Written to {OUTPUT.resolve()}:")
    for path in written:
        print(f"  {path.name}  {path.stat().st_size // 1024} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
