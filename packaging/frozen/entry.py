"""Where the frozen program begins."""

import multiprocessing
import os
import sys

from platformdirs import user_cache_path

if __name__ == "__main__":
    multiprocessing.freeze_support()  # the process of the sensors is this program again
    # matplotlib keeps there which fonts it found; its usual folder is that of other programs' too.
    os.environ["MPLCONFIGDIR"] = str(user_cache_path("insole-studio", appauthor=False) / "fonts")
    from insole_studio.__main__ import main

    sys.exit(main())
