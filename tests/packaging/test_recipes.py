"""The recipes of the three systems name the same things, though only one can be run here."""

import configparser
import plistlib
import re
import shlex
import sys
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import pytest

from build import FORMATS
from bundle import deb, elf, product
from bundle.debian_packages import packages_for
from bundle.trim import is_needed
from insole_studio.cli import window
from insole_studio.cli.main import command_parser
from realsense_d400.usb_places import PRODUCTS

LINUX = product.PACKAGING / "linux"
WINDOWS = product.PACKAGING / "windows"
MACOS = product.PACKAGING / "macos"
WORKFLOW = product.ROOT / ".github" / "workflows" / "bundles.yml"


@pytest.fixture(scope="module")
def installer():
    return (WINDOWS / "insole-studio.iss").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def workflow():
    return WORKFLOW.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def menu_entry():
    parser = configparser.ConfigParser(interpolation=None)
    parser.optionxform = str
    parser.read(LINUX / f"{product.COMMAND}.desktop", encoding="utf-8")
    return parser["Desktop Entry"]


@pytest.fixture(scope="module")
def application():
    return plistlib.loads((MACOS / "info.plist").read_bytes())


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux packages name what they depend on")
def test_the_library_of_the_realsense_asks_for_what_debian_has():
    found = pytest.importorskip("pyrealsense2", reason="pyrealsense2 is missing").__file__
    folder = Path(found).parent
    files = [elf.read_elf(path) for path in elf.elf_files(folder) if "debug" not in path.name]
    packages, unknown = packages_for(elf.of_the_system(files, folder))
    assert (unknown, elf.too_new(files)) == ([], [])
    assert "libusb-1.0-0" in packages


def test_all_give_the_same_program(installer, menu_entry, application, workflow):
    assert '#define Frozen "..\\..\\dist\\insole-studio"' in installer
    assert f'#define Command "{product.COMMAND}"' in installer
    assert f'#define AppName "{product.NAME}"' in installer
    assert menu_entry["Exec"].split()[0] == product.COMMAND
    assert menu_entry["Name"] == application["CFBundleDisplayName"] == product.NAME
    for program in (
        f"dist/{product.COMMAND}/{product.COMMAND}",
        f"dist/{product.COMMAND}/{product.COMMAND}.exe",
        f"dist/{product.NAME}.app/Contents/MacOS/{product.COMMAND}",
    ):
        assert f"program: {program}\n" in workflow


def test_all_open_the_same_case_files(installer, menu_entry, application):
    assert f"Software\\Classes\\{product.CASE_SUFFIX}" in installer
    assert product.CASE_MIME_TYPE in installer
    assert menu_entry["MimeType"].strip(";") == product.CASE_MIME_TYPE
    mime = ElementTree.parse(LINUX / f"{product.COMMAND}.mime.xml").getroot()[0]
    assert mime.attrib["type"] == product.CASE_MIME_TYPE
    assert [glob.attrib["pattern"] for glob in mime if glob.tag.endswith("glob")] == [
        f"*{product.CASE_SUFFIX}"
    ]
    exported = application["UTExportedTypeDeclarations"][0]
    tags = exported["UTTypeTagSpecification"]
    assert tags["public.filename-extension"] == [product.CASE_SUFFIX.removeprefix(".")]
    assert tags["public.mime-type"] == product.CASE_MIME_TYPE
    assert application["CFBundleDocumentTypes"][0]["LSItemContentTypes"] == [
        exported["UTTypeIdentifier"]
    ]


def test_a_double_click_opens_the_case(installer, menu_entry):
    (windows,) = re.findall(r'open\\command"; .*ValueData: "(.*)"$', installer, re.MULTILINE)
    for command, place in ((menu_entry["Exec"], "%f"), (windows.replace('""', '"'), "%1")):
        arguments = shlex.split(command)[1:]
        parsed = command_parser().parse_args([{place: "a b.insole"}.get(a, a) for a in arguments])
        assert parsed.command is window
        assert parsed.path == Path("a b.insole")


def test_linux_and_windows_give_access_to_the_same_sensors():
    kinects, realsenses = product.UDEV_RULES
    rules = kinects.read_text(encoding="utf-8")
    driver = (WINDOWS / "kinect-v1.inf").read_text(encoding="utf-8")
    instructions = (WINDOWS / "DRIVER.txt").read_text(encoding="utf-8").lower()
    allowed = set(re.findall(r'ATTR{idProduct}=="(\w{4})", MODE', rules))
    hub = {"02c2"}  # Windows' own driver
    given = {product_id.lower() for product_id in re.findall(r"PID_(\w{4})", driver)}
    assert given == allowed - hub
    assert all(product_id in instructions for product_id in given)
    # Windows has a driver for these
    (cameras, streams) = re.findall(r'idProduct}=="([\w|]+)", MODE', realsenses.read_text())[:2]
    assert {int(product_id, 16) for product_id in cameras.split("|")} == PRODUCTS
    assert cameras == streams


def test_every_system_is_built_and_lets_its_bundle_test_itself(workflow):
    systems = set(re.findall(r"- system: (\w+)", workflow))
    assert systems == {"linux", "windows", "macos"}
    assert len(FORMATS) == len(systems)
    assert workflow.count("packaging/build.py") == 2  # Windows, and the other two
    assert workflow.count("self-test") >= 2
    for pattern in ("*.deb", "*.tar.xz", "*-setup.exe", "*.dmg", "*.cdx.json", "SHA256SUMS"):
        assert f"dist/{pattern}\n" in workflow


def test_files_that_recipes_name_are_there(installer):
    named = [
        *(WINDOWS / name for name in re.findall(r'^Source: "([\w.-]+)"', installer, re.MULTILINE)),
        MACOS / "entitlements.plist",
        MACOS / "sign-and-pack.sh",
        product.PACKAGING / "insole-studio.spec",
        product.PACKAGING / "frozen" / "entry.py",
        product.ROOT / "resources" / "icons" / f"{product.COMMAND}.svg",
    ]
    made_by_signing = WINDOWS / "kinect-v1.cat"
    assert [path for path in named if not path.exists() and path != made_by_signing] == []


def test_every_resource_goes_into_the_bundle():
    resources = [
        path
        for path in (product.ROOT / "resources").rglob("*")
        if path.is_file() and path.suffix not in {".py", ".pyc", ".ts", ".map"}
    ]
    assert len(resources) > 30
    for path in resources:
        place = "insole_core/_resources/" + path.relative_to(product.ROOT / "resources").as_posix()
        assert is_needed(place, is_system_library=False), place


def test_versions_of_what_is_frozen_are_pinned():
    project = tomllib.loads((product.ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    wanted = project["project"]["optional-dependencies"]["package"]
    constraints = (product.ROOT / "constraints.txt").read_text(encoding="utf-8").splitlines()
    pinned = {line.split("==")[0].lower() for line in constraints}
    assert {re.split(r"[><=]", name)[0] for name in wanted} <= pinned


def test_removing_the_package_leaves_the_homes_alone():
    for name in ("postinst", "postrm"):
        script = (LINUX / name).read_text(encoding="utf-8")
        commands = [line for line in script.splitlines() if not line.lstrip().startswith("#")]
        assert not re.search(r"\brm\b|/home|HOME", "\n".join(commands))


def test_the_package_of_linux_puts_the_manual_where_a_browser_may_read(tmp_path: Path) -> None:
    bundled = tmp_path / "usr/lib/insole-studio/_internal/insole_core/_resources/manual"
    (bundled / "en").mkdir(parents=True)
    (bundled / "en" / "page.html").touch()
    documents = tmp_path / "usr/share/doc/insole-studio"
    documents.mkdir(parents=True)
    deb.put_manual(tmp_path / "usr/lib/insole-studio", documents / "manual")
    assert (bundled / "en" / "page.html").resolve() == documents / "manual/en/page.html"
    assert not bundled.readlink().is_absolute()
