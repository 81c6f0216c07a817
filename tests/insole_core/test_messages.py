"""A message is its English sentence, and keeps how it was made on every way it goes."""

from __future__ import annotations

import copy
import json
import pickle
from collections.abc import Callable
from pathlib import Path

import pytest

from insole_core.errors import InputError, InsoleError
from insole_core.messages import Message, counted, joined
from insole_core.progress import Progress

TEMPLATE = "The view {view} is off by {error_mm:.1f} mm: {reason}."
REASON = Message("{count} markers {{moved}}", count=3)
MESSAGE = Message(TEMPLATE, view="left", error_mm=2.34, reason=REASON)
SENTENCE = "The view left is off by 2.3 mm: 3 markers {moved}."


def test_a_message_is_its_finished_sentence() -> None:
    assert MESSAGE == SENTENCE
    assert f"{MESSAGE}" == SENTENCE
    assert {MESSAGE: 1}[SENTENCE] == 1
    assert json.loads(json.dumps([MESSAGE])) == [SENTENCE]


def test_template_and_values_stay_known() -> None:
    assert MESSAGE.template == TEMPLATE
    assert MESSAGE.values == {"view": "left", "error_mm": 2.34, "reason": REASON}


@pytest.mark.parametrize(
    "again",
    [str, Message, copy.copy, copy.deepcopy, lambda message: pickle.loads(pickle.dumps(message))],
)
def test_a_copy_is_still_a_message(again: Callable[[Message], str]) -> None:
    copied = again(MESSAGE)
    assert isinstance(copied, Message)
    assert (copied, copied.template, copied.values) == (SENTENCE, TEMPLATE, MESSAGE.values)
    inner = copied.values["reason"]
    assert isinstance(inner, Message)
    assert inner.template == REASON.template


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_it_goes_to_another_process_by_every_protocol(protocol: int) -> None:
    copied = pickle.loads(pickle.dumps(MESSAGE, protocol))
    assert (copied, copied.values["reason"].template) == (SENTENCE, REASON.template)


def test_without_values_braces_are_only_braces() -> None:
    message = Message("must be a list […] of {x}")
    assert message == message.template == "must be a list […] of {x}"
    assert pickle.loads(pickle.dumps(message)) == message


def test_a_value_with_braces_is_not_filled_again() -> None:
    message = Message("{path} is missing.", path=Path("a{b}"))
    assert message == "a{b} is missing."
    assert pickle.loads(pickle.dumps(message)) == message


def test_values_may_have_any_name() -> None:
    assert Message("{self} {template} {cls}", self=1, template=2, cls=3) == "1 2 3"


def test_a_hole_without_its_value_is_a_mistake() -> None:
    with pytest.raises(KeyError):
        Message("{path} is flat.", file="a.stl")


def test_joined_messages_keep_their_parts() -> None:
    sentences = joined([MESSAGE, "The heel is missing."], " ")
    assert sentences == f"{SENTENCE} The heel is missing."
    assert list(sentences.values.values()) == [MESSAGE, "The heel is missing."]
    assert joined([]) == ""
    assert joined(["a", "{b}"]) == "a, {b}"


@pytest.mark.parametrize("kind", [InsoleError, InputError])
def test_an_error_keeps_its_message(kind: type[InsoleError]) -> None:
    error = kind(TEMPLATE, view="left", error_mm=2.34, reason=REASON)
    for caught in (error, pickle.loads(pickle.dumps(error)), kind(error.message)):
        assert type(caught) is kind
        assert caught.message.template == TEMPLATE
        sentence = str(caught)
        assert isinstance(sentence, Message)
        assert (sentence, sentence.values) == (SENTENCE, MESSAGE.values)


def test_an_error_may_be_a_plain_sentence() -> None:
    assert str(InputError("Put values into { }.")) == "Put values into { }."


def test_progress_reports_messages() -> None:
    told: list[str] = []
    progress = Progress(lambda _fraction, text: told.append(text))
    progress.step(0.5, "Placing the view {view}", view="left")
    progress.step(1.0, MESSAGE)
    assert told == ["Placing the view left", SENTENCE]
    assert [text.template for text in told if isinstance(text, Message)] == [
        "Placing the view {view}",
        TEMPLATE,
    ]


@pytest.mark.parametrize(
    ("count", "said"), [(0, "0 files of A7"), (1, "1 file of A7"), (2, "2 files of A7")]
)
def test_one_thing_is_told_as_one(count: int, said: str) -> None:
    told = counted(count, "1 file of {order}", "{count} files of {order}", order="A7")
    assert told == said
    assert told.template == ("1 file of {order}" if count == 1 else "{count} files of {order}")
