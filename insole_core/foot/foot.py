"""A foot, ready for design: its surface in the insole frame."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from insole_core.foot.display_surface import DisplaySurface, display_surface
from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.mesh_graph import without_noise
from insole_core.geometry.sampling import EvenSurface
from insole_core.geometry.side import Side
from insole_core.geometry.transforms import MIRROR, inverse
from insole_core.imprints.form import Form
from insole_core.memo import Memo

DISPLAY = "display"
"""Kind of the surface for display in the cache of a foot."""
_KEPT, _LEAST_KEPT, _MOST_BYTES = 8, 2, 96_000_000
"""Results of a kind: enough to change between a clinic's devices, on fine grids between two."""


def _cache() -> Memo:
    return Memo(_KEPT, most_bytes=_MOST_BYTES, least=_LEAST_KEPT)


@dataclass(frozen=True, eq=False)
class Foot:
    """One foot surface, sole towards -z, toes towards +y, x = 0 on the foot axis.

    Parameters
    ----------
    side
    mesh : mm, insole frame
        y = 0 at the rearmost point of the heel, z = 0 at the lowest point of the sole.
    source2insole : (4, 4) float64, mm
        From the surface's original frame (of a session the reference frame) to the insole frame.
    length_mm
        Heel to the tip of the longest toe, along the foot axis.
    notes
        How pose and side were decided, a sentence each.
    form
        What was scanned: the foot itself, or what was pressed by it or cast of it under load.
    mirrored
        Whether it is the mirror image of the other foot, because this one was not scanned.
    scanned_on
        Day (ISO 8601) of the earlier visit that the scan is of; empty for one of its own visit.
    derived
        Cache of recent results for this foot: landmarks, border, outline, sole, display.
    """

    side: Side
    mesh: TriangleMesh
    source2insole: FloatArray
    length_mm: float
    notes: tuple[str, ...] = ()
    form: Form = Form.FOOT
    mirrored: bool = False
    scanned_on: str = ""
    derived: Memo = field(default_factory=_cache, init=False, repr=False)

    @property
    def even(self) -> EvenSurface:
        """Evenly spread points of the surface, mm, insole frame.

        They are the same points of the surface in whatever pose the foot is.
        """
        return self.derived.get("even", (), self._spread)

    @property
    def measured(self) -> TriangleMesh:
        """The surface without the noise of its scan, insole frame, to be measured.

        It is the mesh itself where that has little.
        """
        return self.derived.get("measured", (), lambda: without_noise(self.mesh))

    def mirror_image(self) -> Foot:
        """Return the foot of the other side as the mirror image of this one, marked as such.

        What it is measured by is mirrored with it, so that nothing that is found on it differs.
        """
        mesh, measured, even = self.mesh.mirrored(), self.measured, self.even.mirrored()
        steady = mesh if measured is self.mesh else measured.mirrored()
        mirror = np.diag([*MIRROR, 1.0])  # in the plane that holds the foot axis
        foot = Foot(
            self.side.other,
            mesh,
            mirror @ self.source2insole @ mirror,  # that of the mirrored scan
            self.length_mm,
            form=self.form,
            mirrored=not self.mirrored,
            scanned_on=self.scanned_on,
        )
        foot.derived.get("measured", (), lambda: steady)
        foot.derived.get("even", (), lambda: even)
        return foot

    def display_surface(self) -> DisplaySurface:
        """Return the surface to be shown, with an even border; computed once, in about 0.3 s."""
        return self.derived.get(DISPLAY, (), lambda: display_surface(self.mesh))

    def _spread(self) -> EvenSurface:
        scan = self.measured.transformed(inverse(self.source2insole))
        return EvenSurface.of(scan).transformed(self.source2insole)
