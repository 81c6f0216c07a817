"""Where the frozen program begins."""

import multiprocessing
import os
import sys

BROWSER_VARIABLES = ("QT_PLUGIN_PATH", "QML2_IMPORT_PATH")
"""Set by PyInstaller for the Qt of the bundle, which finds its plugins without them."""


def spare_other_programs() -> None:
    """Start the browser and others with the libraries of the system, not with those of the bundle.

    This process has its libraries by now; one of its own program gets the path anew.
    """
    before = os.environ.pop("LD_LIBRARY_PATH_ORIG", None)
    os.environ.pop("LD_LIBRARY_PATH", None)
    if before is not None:
        os.environ["LD_LIBRARY_PATH"] = before
    for name in BROWSER_VARIABLES:
        os.environ.pop(name, None)


if __name__ == "__main__":
    if sys.platform.startswith("linux"):
        spare_other_programs()
    multiprocessing.freeze_support()  # the process of the sensors is this program again
    from insole_studio.__main__ import main

    sys.exit(main())
