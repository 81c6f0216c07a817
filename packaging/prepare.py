"""Make the environment that bundles are built from: ``python packaging/prepare.py``.

It lies in ``build/package-venv`` and holds what the bundle contains, and PyInstaller. It differs
from that of developers in two libraries that are much smaller there; see docs/decisions/0060.
"""

from __future__ import annotations

import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ENVIRONMENT = ROOT / "build" / "package-venv"
WHEELS = ROOT / "build" / "wheels"
OPENCV = "opencv-python-headless"
OPENCV_MODULES = (
    "core", "imgproc", "imgcodecs", "geometry", "flann", "features", "stereo", "calib", "objdetect",
    "python3",
)  # fmt: skip
OPENCV_LEFT_OUT = (
    "WITH_IPP", "WITH_OPENCL", "WITH_ITT", "WITH_FFMPEG", "WITH_AVIF", "WITH_JASPER",
    "WITH_OPENJPEG", "WITH_OPENEXR", "BUILD_OPENEXR", "WITH_PROTOBUF",
    "WITH_FLATBUFFERS", "WITH_EIGEN", "WITH_VA",
)  # fmt: skip
"""Video, neural networks and rare picture formats; and IPP, which is fetched while it is built."""


def main() -> int:
    """Make the environment; return the exit code."""
    venv.create(ENVIRONMENT, with_pip=True, clear=True)
    constraints = ["--constraint", str(ROOT / "constraints.txt")]
    _pip("install", *constraints, "--editable", f"{ROOT}[package]")
    _pip("uninstall", "--yes", "vtk")  # pyvista takes cvista in its place
    if sys.platform.startswith("linux"):
        _pip("install", "--no-deps", "--force-reinstall", str(_small_opencv()))
    return 0


def _small_opencv() -> Path:
    """Return a wheel of OpenCV with only the modules that the program uses; built if there is none.

    That takes about 20 minutes on two processors.
    """
    version = _pinned(OPENCV)
    name = f"{OPENCV.replace('-', '_')}-{version}-*.whl"
    if not list(WHEELS.glob(name)):
        switches = [
            f"-DBUILD_LIST={','.join(OPENCV_MODULES)}",
            "-DOPENCV_FORCE_3RDPARTY_BUILD=ON",
            "-DCPU_DISPATCH=AVX2",
            *(f"-D{switch}=OFF" for switch in OPENCV_LEFT_OUT),
        ]
        os.environ["CMAKE_ARGS"] = " ".join(switches)
        source = ["--no-binary", OPENCV, f"{OPENCV}=={version}"]
        _pip("wheel", "--no-deps", "--no-cache-dir", "--wheel-dir", str(WHEELS), *source)
    return next(WHEELS.glob(name))


def _pinned(name: str) -> str:
    lines = (ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    return dict(line.split("==") for line in lines if "==" in line)[name]


def _pip(*arguments: str) -> None:
    folder = "Scripts" if sys.platform == "win32" else "bin"
    python = ENVIRONMENT / folder / "python"
    call = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", *arguments]
    subprocess.run(call, check=True)


if __name__ == "__main__":
    sys.exit(main())
