import copy
import json
import logging
import pickle
from pathlib import PurePosixPath

import pytest

from insole_core.errors import InputError
from insole_core.json_object import JsonObject
from insole_core.messages import Message, joined
from insole_core.progress import Progress
from insole_core.visible_text import LONGEST, VisibleRecord, visible, visible_line

UNSEEN = {
    "escape": "\x1b",
    "bell": "\x07",
    "return": "\r",
    "nul": "\x00",
    "delete": "\x7f",
    "C1 introducer": "\x9b",
    "next line": "\x85",
    "line separator": "\u2028",
    "paragraph separator": "\u2029",
    "right to left override": "\u202e",
    "isolate": "\u2066",
    "half of a letter": "\udcff",
}


@pytest.mark.parametrize("character", UNSEEN.values(), ids=UNSEEN)
def test_it_is_written_out_wherever_a_text_is_shown(character):
    text, shown = f"a{character}b", f"a\\u{ord(character):04x}b"
    assert visible(text) == visible_line(text) == shown
    assert Message("{path} is flat.", path=PurePosixPath(text)) == f"{shown} is flat."
    assert Message(f"{text} is flat.") == f"{shown} is flat."
    assert str(InputError("{what}", what=text)) == shown
    assert joined([text, "c"]) == f"{shown}, c"
    assert JsonObject("f", {"name": text}).text("name") == shown
    said = []
    Progress(lambda _done, step: said.append(step)).step(0.5, "Reading {name}", name=text)
    assert said == [f"Reading {shown}"]
    record = VisibleRecord("n", logging.WARNING, "f", 1, "%s is gone", (text,), None)
    assert record.getMessage() == f"{shown} is gone"
    assert json.loads(f'"{shown}"') == text  # as JSON that passes through a guarded stream


def test_lines_stay_where_a_text_may_have_them():
    assert visible("first\r\nsecond\tthird\n") == "first\nsecond\tthird\n"
    assert visible_line("first\nsecond") == "first\\u000asecond"
    assert Message("{name}", name="a\n100%  Done") == "a\\u000a100%  Done"


@pytest.mark.parametrize(
    "text", ["Åsa Öberg", "محمد", "נועה\u200f", "क्\u200dष", "zu\u00adletzt", "👩\u200d🦰"]
)
def test_what_can_be_read_stays_as_it_is(text):
    assert visible(text) == visible_line(text) == text


def test_a_long_value_keeps_its_ends():
    text = str(Message("{name} is flat.", name="a" * 10**6 + ".stl"))
    assert len(text) < LONGEST + 20
    assert text.startswith("aaa")
    assert text.endswith("a.stl is flat.")


def test_a_message_stays_itself_when_it_is_copied():
    message = Message("{name}: {inner}", name="a\x1b", inner=Message("{x}", x="\x9b"))
    for other in (copy.copy(message), pickle.loads(pickle.dumps(message)), Message(message)):
        assert other == message == "a\\u001b: \\u009b"
        assert other.values == message.values
