"""The core's sentences in another language, recognised by their fixed words.

The core writes plain English with values in it and knows nothing of languages. The phrasebook
holds the sentences with numbered holes, "{0} is flat, which is no surface of a foot; …"; what
stands in a hole may itself be a sentence of the book, such as the reason within an error, or a list
of its words.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from pathlib import Path

_HOLE = re.compile(r"\{(\d+)\}")


class Phrasebook:
    """Says sentences in another language; one that it does not know stays as it is.

    Parameters
    ----------
    sentences
        The translations by the English sentence, both with the same holes.
    """

    def __init__(self, sentences: Mapping[str, str]) -> None:
        self._plain = {text: said for text, said in sentences.items() if not _HOLE.search(text)}
        holed = [text for text in sentences if text not in self._plain]
        # Those with most fixed letters first: the others would match nearly everything.
        holed.sort(key=lambda text: len(_HOLE.sub("", text)), reverse=True)
        self._holed = [(_pattern(text), sentences[text]) for text in holed]
        self.say = lru_cache(maxsize=512)(self._say)

    @classmethod
    def read(cls, path: Path) -> Phrasebook:
        """Read a book; a language without one is English."""
        if not path.exists():
            return cls({})
        return cls(json.loads(path.read_text("utf-8")))

    def _say(self, sentence: str) -> str:
        said = self._plain.get(sentence)
        if said is not None:
            return said
        for pattern, translation in self._holed:
            found = pattern.fullmatch(sentence)
            if found is not None:
                return _filled(translation, [self._say_value(value) for value in found.groups()])
        return sentence

    def _say_value(self, value: str) -> str:
        """Say what stands in a hole: a sentence, a word, or a list of which all is known."""
        listed = value.split(", ")
        said = [self._say(part) for part in listed]
        known = all(part != saying for part, saying in zip(listed, said, strict=True))
        return ", ".join(said) if known else self._say(value)


def _pattern(template: str) -> re.Pattern[str]:
    """Give the pattern of a sentence, its holes as groups in the order of their numbers."""
    fixed = [re.escape(part) for part in _HOLE.split(template)[::2]]
    return re.compile("(.*?)".join(fixed), re.DOTALL)


def _filled(template: str, values: Sequence[str]) -> str:
    return _HOLE.sub(lambda hole: values[int(hole[1])], template)
