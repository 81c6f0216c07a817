import pytest

from bundle.trim import is_needed, trimmed


@pytest.mark.parametrize(
    "place",
    [
        "PySide6/Qt/plugins/platforms/libqxcb.so",
        "PySide6/Qt/plugins/platforms/libqoffscreen.so",
        "PySide6/Qt/plugins/platforms/libqwayland.so",
        "PySide6/plugins/platforms/qwindows.dll",
        "PySide6/Qt/plugins/platforms/libqcocoa.dylib",
        "PySide6/Qt/plugins/printsupport/libcupsprintersupport.so",
        "PySide6/Qt/plugins/platformthemes/libqxdgdesktopportal.so",
        "PySide6/Qt/translations/qtbase_sv.qm",
        "insole_core/_resources/translations/sv/design.qm",
        "matplotlib/mpl-data/fonts/ttf/DejaVuSans.ttf",
        "cvista/libvtkRendering-cvista.so",
        "qtawesome/fonts/materialdesignicons6-webfont-6.9.96.ttf",
        "libusb_package/libusb-1.0.so",
        "PySide6/Qt/plugins/imageformats/libqjpeg.so",
        "PySide6/Qt/plugins/imageformats/libqsvg.so",
        "PySide6/Qt/plugins/iconengines/libqsvgicon.so",
    ],
)
def test_what_the_program_needs_stays(place):
    assert is_needed(place, is_system_library=False)


@pytest.mark.parametrize(
    "place",
    [
        "PySide6/Qt/plugins/platforms/libqeglfs.so",
        "PySide6/Qt/plugins/platformthemes/libqgtk3.so",
        "PySide6/Qt/translations/qtbase_de.qm",
        "PySide6/translations/qt_help_sv.qm",
        "scipy/io/tests/data/test.mat",
        "qtawesome/fonts/phosphor-1.3.0.ttf",
        "scipy/stats/_stats.so",
        "insole_core/_resources/manual/en/_static/styles/furo.css.map",
    ],
)
def test_what_it_does_not_need_goes(place):
    assert not is_needed(place, is_system_library=False)


def test_a_graphics_driver_never_meets_our_copy_of_a_library_it_uses():
    for name in ("libstdc++.so.6", "libX11.so.6", "libdrm.so.2", "libexpat.so.1", "libz.so.1"):
        assert not is_needed(name, is_system_library=True)
    assert is_needed("libpython3.11.so.1.0", is_system_library=True)


def test_only_libraries_of_the_system_are_left_to_it(tmp_path):
    system, wheel = tmp_path / "system", tmp_path / "wheel"
    ours = ("libz-1234abcd.so.1", str(wheel / "libz.so.1"), "BINARY")
    theirs = ("libz.so.1", str(system / "libz.so.1"), "BINARY")
    module = ("_zoneinfo.so", str(system / "_zoneinfo.so"), "EXTENSION")
    assert trimmed([ours, theirs, module], [system]) == [ours, module]


def test_no_link_is_left_without_its_file(tmp_path):
    dropped = ("PySide6/Qt/lib/libQt6EglFs.so.6", str(tmp_path / "libQt6EglFs.so.6"), "BINARY")
    kept = ("PySide6/Qt/lib/libQt6Gui.so.6", str(tmp_path / "libQt6Gui.so.6"), "BINARY")
    links = [(f"{place.split('/')[-1]}", place, "SYMLINK") for place, _, _ in (dropped, kept)]
    assert trimmed([dropped, kept, *links], []) == [kept, links[1]]
