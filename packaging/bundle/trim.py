"""Which of the files that PyInstaller finds the program does not need.

Every rule works on the place of a file in the bundle, so the tests need no build.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from fnmatch import fnmatchcase
from pathlib import Path, PurePosixPath

TocEntry = tuple[str, str, str]
"""Of PyInstaller: place in the bundle, file, kind."""

UNUSED = (
    # Qt: screens without a window system, network state, GTK (the desktop portal has its dialogs),
    # shells of car displays
    "PySide6/*plugins/egldeviceintegrations/*",
    "PySide6/*plugins/generic/*",
    "PySide6/*plugins/networkinformation/*",
    "PySide6/*plugins/platforms/*eglfs*",
    "PySide6/*plugins/platforms/*linuxfb*",
    "PySide6/*plugins/platforms/*minimalegl*",
    "PySide6/*plugins/platforms/*vkkhrdisplay*",
    "PySide6/*plugins/platforms/*vnc*",
    "PySide6/*plugins/platformthemes/*gtk3*",
    "PySide6/*plugins/wayland-shell-integration/*ivi*",
    "PySide6/*plugins/wayland-shell-integration/*fullscreen*",
    "PySide6/*Qt6Egl*",
    # tests and sources of libraries
    "*/tests/*",
    "*.pyi",
    "*.pxd",
    "matplotlib/mpl-data/sample_data/*",
    "matplotlib/mpl-data/images/*",
    "cv2/data/*",
    "cv2/*ffmpeg*",
    # cvista: readers and writers, of which only the half is there
    "cvista/*DomainsChemistry*",
    "cvista/*IOChemistry*",
    "cvista/*IOExport*",
    "cvista/*IOImport*",
    "cvista/*IOInfovis*",
    "cvista/*IOMINC*",
    "cvista/*Web*",
    "cvista/*WrappingTools*",
    "cvista/libvtkDICOMParser*",
    "cvista/libvtkexpat*",
    "cvista/libvtklz4*",
    "cvista/libvtklzma*",
    "cvista/libvtkmetaio*",
    "cvista/libvtktiff*",
    # Pillow and Qt: picture formats that no scanner writes, and letters
    "PIL/_avif*",
    "PIL/_imagingcms*",
    "PIL/_imagingft*",
    "PIL/_webp*",
    "PySide6/*plugins/imageformats/*gif*",
    "PySide6/*plugins/imageformats/*icns*",
    "PySide6/*plugins/imageformats/*tga*",
    "PySide6/*plugins/imageformats/*tiff*",
    "PySide6/*plugins/imageformats/*wbmp*",
    "PySide6/*plugins/imageformats/*webp*",
    "pillow.libs/libavif*",
    "pillow.libs/libbrotli*",
    "pillow.libs/libfreetype*",
    "pillow.libs/libharfbuzz*",
    "pillow.libs/liblcms*",
    "pillow.libs/libsharpyuv*",
    "pillow.libs/libwebp*",
    # families of icons that are not used
    "qtawesome/fonts/[!m]*",
    "qtawesome/fonts/materialdesignicons5*",
    # fonts of PostScript, which the product does not write
    "matplotlib/mpl-data/fonts/afm/*",
    "matplotlib/mpl-data/fonts/pdfcorefonts/*",
    # letters of mathematical formulas
    "matplotlib/mpl-data/fonts/ttf/DejaVuSerif*",
    "matplotlib/mpl-data/fonts/ttf/STIX*.ttf",
    "PySide6/*plugins/tls/*",
    "PySide6/*Qt6Network*",
    # scripts and styles of the manual before they were made small
    "insole_core/_resources/manual/*.map",
    "scipy/special/cython_special*",
    "scipy/stats/*",
    "setuptools*",
)

QT_TRANSLATIONS = ("qtbase_sv.qm", "qtbase_en.qm")
"""Of Qt's own texts, those of the languages that the product has."""

BUNDLED_SYSTEM_LIBRARIES = (
    "libpython3*",
    "libbz2.so*",
    "libcrypto.so*",
    "libffi.so*",
    "liblzma.so*",
    "libsqlite3.so*",
    "libssl.so*",
    "libxcb-cursor.so*",
    "libxcb-icccm.so*",
    "libxcb-image.so*",
    "libxcb-keysyms.so*",
    "libxcb-render-util.so*",
    "libxcb-util.so*",
)
"""Linux: what Python itself was built with, and small libraries of X that few systems have.

All others come from the system, because drivers of the graphics card use them too: a process cannot
hold an older libstdc++ of ours and a driver that wants a newer one.
"""


def is_needed(place: str, *, is_system_library: bool) -> bool:
    """Say whether a file belongs into the bundle.

    Parameters
    ----------
    place
        Of the file in the bundle, with slashes.
    is_system_library
        Whether it is a library of the Linux system on which the bundle is built.
    """
    path = PurePosixPath(place)
    if any(fnmatchcase(place, pattern) for pattern in UNUSED):
        return False
    if re.match(r"PySide6/.*translations/", place):
        return path.name in QT_TRANSLATIONS
    if is_system_library:
        return any(fnmatchcase(path.name, pattern) for pattern in BUNDLED_SYSTEM_LIBRARIES)
    return True


def trimmed(entries: Iterable[TocEntry], system_folders: Iterable[Path]) -> list[TocEntry]:
    """Return the entries that the program needs.

    Parameters
    ----------
    entries
        What PyInstaller found.
    system_folders
        Where the libraries of the system lie; empty on systems whose bundles bring all of them.
    """
    folders = [folder.resolve() for folder in system_folders]

    def is_of_system(source: str) -> bool:
        return any(Path(source).resolve().is_relative_to(folder) for folder in folders)

    kept = [
        (place, source, kind)
        for place, source, kind in entries
        if is_needed(
            place.replace("\\", "/"),
            is_system_library=kind == "BINARY" and is_of_system(source),
        )
    ]
    places = {PurePosixPath(place) for place, _, _ in kept}
    return [
        (place, source, kind)
        for place, source, kind in kept
        if kind != "SYMLINK" or PurePosixPath(place).parent / source in places
    ]
