"""Windows has no fcntl and the like: all of the product can be imported without them."""

import subprocess
import sys

from bundle import product

IMPORT_EVERYTHING = """
import importlib, pkgutil, signal, sys

import insole_core.files.file_lock  # chooses between fcntl and msvcrt by the system

HIDDEN = {"fcntl", "grp", "posix_ipc", "pwd", "readline", "resource", "syslog", "termios", "tty"}
for name in HIDDEN:
    sys.modules[name] = None  # importing it fails, as on Windows
for name in ("SIGHUP", "SIGPIPE", "SIGUSR1", "SIGUSR2", "SIGALRM", "SIGQUIT", "SIGKILL"):
    delattr(signal, name)

for name in sys.argv[1:]:
    package = importlib.import_module(name)
    for module in pkgutil.walk_packages(package.__path__, name + "."):
        if not module.name.endswith((".__main__", "migrations.env")):
            importlib.import_module(module.name)
            print(module.name)
"""


PACKAGES = ("insole_core", "insole_studio", "kinect_v1")


def test_every_module_can_be_imported():
    folders = (product.ROOT / "app", product.ROOT / "drivers" / "kinect", product.ROOT)
    call = [sys.executable, "-c", IMPORT_EVERYTHING, *PACKAGES]
    done = subprocess.run(
        call,
        capture_output=True,
        text=True,
        check=False,
        env={"PYTHONPATH": ":".join(map(str, folders)), "QT_QPA_PLATFORM": "offscreen"},
    )
    assert done.returncode == 0, done.stderr
    imported = [name.split(".")[0] for name in done.stdout.splitlines()]
    assert all(imported.count(package) > 10 for package in PACKAGES)
