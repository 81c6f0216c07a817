"""What tests take for the same, so that its result is found once."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from found_once import SharedResults, share_results

from insole_core.reconstruct import reconstruction
from insole_core.reconstruct.fusion.infrared_evidence import InfraredView
from insole_core.reconstruct.fusion.prepared_view import PreparedView


def test_a_view_with_its_infrared_picture_is_another_one(monkeypatch: pytest.MonkeyPatch) -> None:
    nothing: Any = None
    plain = PreparedView(nothing, nothing, nothing, nothing, nothing)
    pictures = (np.zeros((2, 2), np.float32), np.ones((2, 2), np.float32))
    views = [plain, *(replace(plain, infrared=InfraredView(one, nothing)) for one in pictures)]
    monkeypatch.setattr(reconstruction, "fuse", lambda view: [view])
    share_results(SharedResults(), monkeypatch)
    fuse: Any = reconstruction.fuse
    assert [fuse(view)[0] for view in views] == views
    assert fuse(replace(plain)) is fuse(plain)
