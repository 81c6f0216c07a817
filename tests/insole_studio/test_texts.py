"""Every text of the window can be read in Swedish."""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple, get_args
from xml.etree import ElementTree

import pytest
from dialog_pictures import REASONS
from pictures import VARIANT
from PySide6.QtCore import QCoreApplication
from PySide6.QtWidgets import QApplication
from varied_designs import DRAWN, FROM_FOOT, OTHERS, varied

import insole_studio
from insole_core.export.paper import paper_texts
from insole_core.geometry.side import Side
from insole_core.insole.elements import (
    ArchRaise,
    ForefootTwist,
    HeelLift,
    HeelSkive,
    Pelott,
    Posting,
)
from insole_core.insole.fields import Part
from insole_core.insole.prescription.design import InsoleDesign
from insole_core.insole.prescription.design_differences import design_differences
from insole_core.insole.prescription.finish import Finish
from insole_core.insole.prescription.prescription_lines import correction_lines, make_facts
from insole_core.insole.prescription.shell import Shell
from insole_core.messages import Message
from insole_core.resources import resource_path
from insole_studio.features.design.parameters.correction_fields import editables, field_specs
from insole_studio.languages import LANGUAGES, Language
from insole_studio.texts import (
    CONTEXT,
    fill,
    language_code,
    load_language,
    localised,
    tr,
    translate_core_message,
    translation_into,
)
from insole_studio.widgets.number_field import NumberField

_NUMBER = re.compile(r":[+,]?\.?\d*[fgeE%]\b|:[+,]?\.\d+[fgeE%]")
SWEDISH = resource_path("translations/sv")
MANUAL = Path(__file__).parents[2] / "docs" / "manual"


class Code(NamedTuple):
    """What is looked for in the code of the window."""

    texts: set[str]
    """What it says, by `tr`."""
    numbers: tuple[str, ...]
    """Places where the window itself writes a number."""


@cache
def code() -> Code:
    """Read all files of the window, once."""
    root = Path(insole_studio.__file__).parent
    texts: set[str] = set()
    numbers: list[str] = []
    for path in root.rglob("*.py"):
        below = path.relative_to(root)
        is_window = not {"cli", "acquisition"} & set(below.parts)
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "tr":
                (text,) = node.args
                assert isinstance(text, ast.Constant), f"{path}:{node.lineno}"
                texts.add(str(text.value))
            elif is_window and _formats_a_number(node):
                numbers.append(f"{below}:{node.lineno}")
    return Code(texts, tuple(numbers))


def translations(pattern: str = "*.ts") -> Iterator[tuple[str, str]]:
    """Give each English text and its Swedish one, as often as they stand in the catalogues."""
    for path in SWEDISH.glob(pattern):
        for message in ElementTree.parse(path).iter("message"):
            yield message.findtext("source", ""), message.findtext("translation", "")


def catalogue() -> dict[str, str]:
    """Give the Swedish texts by the English ones."""
    return dict(translations())


def test_every_text_has_a_swedish_one() -> None:
    translated, texts = catalogue(), code().texts
    assert len(texts) > 400
    assert [text for text in texts if not translated.get(text)] == []


def test_every_language_has_its_texts_its_manual_and_words_for_its_pictures() -> None:
    codes = set(LANGUAGES)
    assert get_args(Language) == ("system", *LANGUAGES)
    assert {path.parent.name for path in SWEDISH.parent.glob("*/core.ts")} == codes - {"en"}
    assert {code for code in codes if not (MANUAL / code).is_dir()} == {"en"}
    assert VARIANT.keys() == REASONS.keys() == codes


def test_no_swedish_text_is_left_of_one_that_nobody_says() -> None:
    of_the_core = dict(translations("core.ts"))
    assert catalogue().keys() - of_the_core.keys() - code().texts == set()


def test_a_text_has_one_translation_whoever_says_it() -> None:
    counts = Counter(source for source, _ in translations())
    assert [source for source, count in counts.items() if count > 1] == []


def test_names_in_braces_stay_what_they_are() -> None:
    for source, translation in translations():
        for part in source.replace("{{", "").split("{")[1:]:
            assert "{" + part.split("}")[0] + "}" in translation


def test_the_compiled_catalogues_are_those_of_the_texts(qapp: QApplication) -> None:
    load_language(qapp, "sv")
    texts = catalogue()
    wrong = {text for text in texts if qapp.translate(CONTEXT, text) != texts[text]}
    load_language(qapp, "en")
    assert texts
    assert wrong == set()


@pytest.mark.parametrize(("language", "text"), [("sv", "Häl"), ("en", "Heel")])
def test_the_window_speaks_the_language(qapp: QApplication, language: str, text: str) -> None:
    load_language(qapp, language)
    assert tr("Heel") == text
    load_language(qapp, "en")


def test_numbers_are_written_as_the_language_does(qapp: QApplication) -> None:
    load_language(qapp, "sv")
    try:
        assert localised(241.25, ".1f") == "241,2"
        assert fill("{a:.2f} mm, {name}, {n}", a=0.5, name="v1.2", n=3) == "0,50 mm, v1.2, 3"
        far = Message("{mm:.1f} mm off", mm=1.5)
        assert translate_core_message(far) == "1,5 mm off"
        field = NumberField("mm", least=0, greatest=9, step=0.1)
        field.setValue(2.5)
        assert field.text() == "2,5 mm"
    finally:
        load_language(qapp, "en")
    assert localised(241.25, ".1f") == "241.2"


def test_numbers_are_written_by_this_module_only() -> None:
    assert code().numbers == ()


def _formats_a_number(node: ast.AST) -> bool:
    """Return whether `node` is an f-string or a call of `format` with a number's specification."""
    if isinstance(node, ast.FormattedValue) and node.format_spec is not None:
        return _NUMBER.search(":" + ast.unparse(node.format_spec).strip("f'\"")) is not None
    if not (isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)):
        return False
    return node.func.attr == "format" and bool(_NUMBER.search(ast.unparse(node.func.value)))


@pytest.mark.parametrize(
    "word", ["boll", "trampan", "hälkopp", "skive", "förskriv", "regist", "upptagning"]
)
def test_one_thing_has_one_swedish_word(word: str) -> None:
    """The words are: trampdyna, hälskål, hälskivning, ordination, journal, avbildning."""
    assert [text for text in catalogue().values() if word in text.lower()] == []


@pytest.mark.usefixtures("swedish")
def test_the_dialogs_of_qt_speak_the_language_too() -> None:
    assert QCoreApplication.translate("QPlatformTheme", "Cancel") == "Avbryt"


@pytest.mark.parametrize("paper", ["person_summary", "prescription", "words"])
def test_the_papers_of_the_record_have_swedish_texts(paper: str) -> None:
    texts, translated = paper_texts(paper).values(), catalogue()
    assert [text for text in texts if not translated.get(text)] == []


def test_the_core_speaks_a_language_whatever_that_of_the_window_is(qapp: QApplication) -> None:
    facts = make_facts(InsoleDesign(Side.LEFT, shell=Shell(), thickness_mm=2.5))
    for language, window in (("sv", "en"), ("en", "sv")):
        load_language(qapp, window)
        translate = translation_into(language)
        said = {translate(name): translate(value) for name, value in facts.items()}
        load_language(qapp, "en")
        if language == "sv":
            assert said["ordinerad tjocklek"] == "2,5 mm"
            assert "Lutning medialt 0°" in said["skal"]
        else:
            assert said == facts
    assert language_code("xx") == "en"


def test_all_that_a_prescription_says_has_swedish_words() -> None:
    translated = catalogue()
    corrections = (
        Pelott(centre_mm=(0, 150)),
        Pelott(centre_mm=(0, 20), kind="heel_spur_recess"),
        Posting(rearfoot_deg=3, forefoot_deg=-2),
        *(kind() for kind in (HeelLift, HeelSkive, ArchRaise, ForefootTwist)),
    )
    designs = [
        InsoleDesign(side, corrections, finish=Finish(), shell=Shell(body_weight_kg=80.5))
        for side in Side
    ]
    said = [*map(_words_of, [m for d in designs for m in correction_lines(d)])]
    said += [{name, *_words_of(value)} for d in designs for name, value in make_facts(d).items()]
    missing = {word for words in said for word in words if not translated.get(word)}
    assert missing == set()


def test_all_that_differences_say_has_swedish_words() -> None:
    translated, plain = catalogue(), InsoleDesign(Side.LEFT)
    pairs = [(plain, design) for design in (FROM_FOOT, OTHERS, DRAWN)]
    pairs += [(before, other) for _, before in pairs for *_, other in varied(before)]
    said = [
        line
        for old, new in pairs
        for a, b in ((old, new), (new, old))
        for line in design_differences(a, b)
    ]
    missing = {word for line in said for word in _words_of(line) if not translated.get(word)}
    assert missing == {"Boot", "Other", "felt", "felt pad"}  # names that somebody gave


@pytest.mark.parametrize("language", ["en", "sv"])
def test_the_papers_say_the_words_of_the_window(qapp: QApplication, language: str) -> None:
    """What is told of each part of a design begins with the label of its field."""
    load_language(qapp, language)
    unsaid = [
        (type(part).__name__, label)
        for design in designs_on_paper()
        for part, said in parts_on_paper(design)
        for label in labels_of(part, design.side)
        if not re.search(f"(^|[;:,] ){re.escape(label)} ", translate_core_message(said))
    ]
    load_language(qapp, "en")
    assert unsaid == []


def designs_on_paper() -> list[InsoleDesign]:
    """Designs of every field, also of those that are usually not set."""
    whole = (FROM_FOOT, OTHERS, DRAWN)
    unset = (found for design in whole for found in varied(design))
    return [*whole, *(other for _, name, part, other in unset if getattr(part, name) is None)]


def parts_on_paper(design: InsoleDesign) -> Iterator[tuple[Part, str]]:
    """The parts of a design that the window has fields for, and what a paper says of each."""
    yield from zip(design.corrections, correction_lines(design), strict=True)
    facts, finish, shell = make_facts(design), design.finish, design.shell
    assert finish is not None
    assert shell is not None
    parts = {
        "insole": design, "outline": design.outline, "layers": design.layers, "finish": finish,
        "shell": shell, "rearfoot post": shell.posts[0], "medial rim": finish.rim[0],
    }  # fmt: skip
    yield from ((part, facts[name]) for name, part in parts.items())


def labels_of(part: Part, side: Side) -> list[str]:
    """The labels of a part's fields, those for experts too; a place and a pair are told at once."""
    keys = {
        editable.key
        for editable in editables(part)
        if editable.number is None
        and part.acts(editable.name)
        and getattr(part, editable.name) is not None
    }
    specs = [s for expert in (False, True) for s in field_specs(part, "p", side, expert=expert)]
    return [spec.label for spec in specs if spec.key.removeprefix("p.") in keys]


def _words_of(text: str) -> set[str]:
    """Return all words and templates of a message that are to be translated."""
    if not isinstance(text, Message) or not text.values:
        return {text} if re.search(r"[a-z]", text) else set()
    within = (_words_of(value) for value in text.values.values() if isinstance(value, str))
    template = re.sub(r"\{.*?\}", "", text.template)
    return {text.template for _ in [0] if re.search(r"[a-z]{3}", template)}.union(*within)
