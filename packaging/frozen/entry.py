"""Where the frozen program begins."""

import multiprocessing
import sys

if __name__ == "__main__":
    multiprocessing.freeze_support()  # the process of the sensors is this program again
    from insole_studio.__main__ import main

    sys.exit(main())
