"""What Debian's fakenect plays of a recording; the standard library only.

Usage: fakenect_client.py LIBRARY OUT, with FAKENECT_PATH naming the recording. fakenect ends the
process at the end of the recording, so every frame is written as it comes.
"""

from __future__ import annotations

import ctypes
import sys
from pathlib import Path
from typing import Any

from freenect_client import Callback, Mode


def play(library_file: str, out: Path) -> None:
    library: Any = ctypes.CDLL(library_file)
    context, device = ctypes.c_void_p(), ctypes.c_void_p()
    library.freenect_init(ctypes.byref(context), None)
    library.freenect_open_device(context, ctypes.byref(device), 0)
    sizes = {"depth": 640 * 480 * 2, "video": 640 * 480 * 3}
    counts = dict.fromkeys(sizes, 0)
    callbacks = []
    for kind, size in sizes.items():
        find = getattr(library, f"freenect_find_{kind}_mode")
        find.restype = Mode
        set_mode = getattr(library, f"freenect_set_{kind}_mode")
        set_mode.argtypes = [ctypes.c_void_p, Mode]
        set_mode(device, find(1, 0))

        def keep(_device: int, data: int, _time: int, kind: str = kind, size: int = size) -> None:
            (out / f"{kind}-{counts[kind]}").write_bytes(ctypes.string_at(data, size))
            counts[kind] += 1

        callbacks.append(Callback(keep))
        getattr(library, f"freenect_set_{kind}_callback")(device, callbacks[-1])
        getattr(library, f"freenect_start_{kind}")(device)
    while library.freenect_process_events(context) == 0:
        continue


if __name__ == "__main__":
    play(sys.argv[1], Path(sys.argv[2]))
