import json
import sys
from pathlib import Path

import numpy as np
import PySide6
import pytest
import scipy

from bundle.components import components_of, unlisted
from bundle.licences import BILL_OF_MATERIALS, LICENCES, write_both


def place_and_file(package, pattern):
    folder = Path(package.__file__).parent
    file = next(folder.glob(pattern))
    return (f"{folder.name}/{file.name}", str(file))


@pytest.fixture(scope="module")
def components():
    files = [
        place_and_file(np, "__init__.py"),
        place_and_file(scipy, "__init__.py"),
        place_and_file(PySide6, "QtCore*"),
        ("base_library.zip", "base_library.zip"),
    ]
    return components_of(files)


def test_every_file_has_a_work_with_version_licence_and_text(components):
    assert [one.name for one in components] == ["numpy", "pyside6-essentials", "python", "scipy"]
    for one in components:
        assert one.version
        assert one.licence
        assert all(len(text) > 200 for _, text in one.texts), one.name


def test_libraries_within_a_wheel_are_named():
    place, file = place_and_file(np, "__init__.py")
    inner = "numpy.libs/libgfortran-040039e1-0352e75f.so.5.0.0"
    # only the place in the bundle tells the name
    (numpy, *_) = components_of([(place, file), (inner, file)])
    assert ("gfortran", "5.0.0") in numpy.libraries


def test_nothing_is_passed_on_of_which_nobody_knows_whose_it_is(tmp_path):
    stray = tmp_path / "libstray.so"
    stray.write_bytes(b"")
    with pytest.raises(LookupError, match=r"libstray\.so"):
        components_of([("libstray.so", str(stray))])


def test_bill_and_texts_name_the_same_works(components, tmp_path):
    write_both(components, "1.2.0", tmp_path)
    texts = json.loads((tmp_path / LICENCES).read_text(encoding="utf-8"))
    bill = json.loads((tmp_path / BILL_OF_MATERIALS).read_text(encoding="utf-8"))
    assert (bill["bomFormat"], bill["specVersion"]) == ("CycloneDX", "1.6")
    named = {(one["name"], one["version"]) for one in texts["components"]}
    assert named == {(one["name"], one["version"]) for one in bill["components"]}
    assert {one["purl"] for one in bill["components"]} >= {f"pkg:pypi/numpy@{np.__version__}"}
    assert "PySide6" in texts["replacing_qt"]
    lgpl = next(one for one in texts["components"] if one["name"] == "pyside6-essentials")
    assert any("GNU LESSER GENERAL PUBLIC LICENSE" in text["text"] for text in lgpl["texts"])
    python = next(one for one in texts["components"] if one["name"] == "python")
    assert python["version"] == ".".join(map(str, sys.version_info[:3]))


def test_scripts_of_the_manual_are_those_of_its_theme(tmp_path):
    static = "insole_core/_resources/manual/sv/_static"
    made = ("scripts/furo.js", "styles/furo.css", "swedish-stemmer.js", "searchtools.js")
    others = ("pygments.css", "skeleton.css", "basic.css")
    files = [(f"{static}/{name}", str(tmp_path / name)) for name in (*made, *others)]
    found = {one.name: one for one in components_of(files)}
    assert set(found) - {"python"} == {
        "furo", "pygments", "snowballstemmer", "sphinx", "sphinx-basic-ng",
    }  # fmt: skip
    assert found["furo"].files == (f"{static}/scripts/furo.js", f"{static}/styles/furo.css")
    assert ("gumshoejs", "5.1.2") in found["furo"].libraries
    assert any("gumshoe" in text for _, text in found["furo"].texts)


def test_the_dots_of_the_sensor_name_their_authors():
    place = "insole_core/_resources/dot_pattern/dots.npz"
    found = {one.name: one for one in components_of([(place, place)])}
    dots = found["connecting-the-dots"]
    assert (dots.licence, dots.files) == ("MIT", (place,))
    assert "autonomousvision" in dots.texts[0][1]


def test_a_file_that_came_in_unseen_is_found(tmp_path):
    for name in ("seen.so", "inner/unseen.so"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    assert unlisted(tmp_path, {"seen.so"}) == ["inner/unseen.so"]
