"""What nobody uses is not loaded, and is there all the same for whoever asks."""

from __future__ import annotations

import subprocess
import sys

SCRIPT = """
from insole_studio.lean_numpy import unlist_parts_on_demand
unlist_parts_on_demand()
import sys, numpy, scipy.sparse.linalg, scipy.spatial, scipy.ndimage
print([name for name in ("f2py", "testing", "ctypeslib") if f"numpy.{name}" in sys.modules])
numpy.testing.assert_allclose(scipy.sparse.eye_array(2).toarray(), numpy.eye(2))
print(numpy.f2py.__name__)
"""


def test_scipy_does_not_load_what_numpy_loads_on_demand() -> None:
    command = [sys.executable, "-c", SCRIPT]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert done.stdout.splitlines() == ["[]", "numpy.f2py"]
