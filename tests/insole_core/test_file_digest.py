"""Files are recognised by their SHA-256."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from insole_core.given_file import sha256_of
from insole_core.progress import Cancelled, Progress


@pytest.fixture
def file(tmp_path: Path) -> Path:
    (tmp_path / "scan.ply").write_bytes(bytes(range(256)) * 10_000)
    return tmp_path / "scan.ply"


def test_it_is_that_of_the_whole_content(file: Path) -> None:
    assert sha256_of(file) == hashlib.sha256(bytes(range(256)) * 10_000).hexdigest()


def test_what_is_larger_than_expected_is_not_read(file: Path) -> None:
    assert sha256_of(file, 2_560_000)
    with pytest.raises(OSError, match="far larger"):
        sha256_of(file, 2_559_999)


def test_it_can_be_cancelled(file: Path) -> None:
    with pytest.raises(Cancelled):
        sha256_of(file, progress=Progress(is_cancelled=lambda: True))
