"""Read USDZ archives, as phones write them, by Pixar's library behind a door of our own.

The library is foreign to what is bounded here: so it gets the scene of the archive alone, in a
folder of its own, and nothing that refers to other files. Textures are read from the archive and
decoded by us. What it returns passes the checks of every scan.
"""

from __future__ import annotations

import re
import tempfile
from pathlib import Path, PurePosixPath
from typing import Any, Final

import numpy as np
from pxr import Sdf, Tf, Usd, UsdGeom, UsdShade

from insole_core.errors import InputError
from insole_core.formats.raw_surface import RawSurface, fans, join_placed
from insole_core.formats.scan_content import ScanContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    colors_of_shares,
    decode_texture,
    mean_colors,
    missing_texture,
    sampled,
)
from insole_core.formats.units import Unit
from insole_core.geometry.arrays import ByteArray, FloatArray, IntArray
from insole_core.messages import Message
from insole_core.zip_archive import ZipArchive

_MOST_SCENE_BYTES = 300 * 2**20
_MOST_PARTS = 10_000
_SCENES = (".usdc", ".usda", ".usd")
_UNITS: Final[dict[float, Unit]] = {1.0: "m", 0.01: "cm", 0.001: "mm", 0.0254: "inch"}
_IN_ARCHIVE = re.compile(r"\[([^\[\]]+)\]$")
"""How the library names a file of an archive."""


def read_usdz(source: ScanContent) -> RawSurface:
    """Read all meshes of the scene that are not hidden, at their places.

    Raises
    ------
    InputError
        When the archive is damaged or refers to other files.
    ValueError, LookupError, TypeError
        When the scene is damaged.
    """
    archive = ZipArchive(str(source.path), source.content)
    scenes = [name for name in archive.names if name.lower().endswith(_SCENES)]
    if not scenes:
        raise ValueError(Message("it holds no scene"))
    with tempfile.TemporaryDirectory() as folder:
        # The first one is the scene that is shown.
        path = Path(folder) / f"scene{PurePosixPath(scenes[0]).suffix.lower()}"
        path.write_bytes(archive.read(scenes[0], _MOST_SCENE_BYTES))
        try:
            layer = Sdf.Layer.FindOrOpen(str(path))
            if layer is None:
                raise ValueError(Message("its scene cannot be read"))
            if layer.GetCompositionAssetDependencies():
                raise InputError(
                    "{path} is put together from other files; export it again as one whole.",
                    path=source.path,
                )
            return _Scene(Usd.Stage.Open(layer), archive).surface()
        except Tf.ErrorException as error:
            raise ValueError(Message("its scene cannot be read")) from error


class _Scene:
    def __init__(self, stage: Any, archive: ZipArchive) -> None:
        self._stage, self._archive = stage, archive
        self._pictures: dict[str, ByteArray | None] = {}
        self._notes: list[Message] = []

    def surface(self) -> RawSurface:
        """Join the meshes; points count only where there is no surface."""
        places = UsdGeom.XformCache(Usd.TimeCode.EarliestTime())
        parts: list[tuple[FloatArray, IntArray, FloatArray]] = []
        colors: list[ByteArray | None] = []
        for prim in self._shown(UsdGeom.Mesh) or self._shown(UsdGeom.Points):
            if len(parts) == _MOST_PARTS:
                raise ValueError(Message("it has far more parts than a scan"))
            points, corners, triangles = _mesh(prim)
            # Places stand in rows there.
            parts.append((points, triangles, np.array(places.GetLocalToWorldTransform(prim)).T))
            colors.append(self._colors(prim, corners, len(points)))
        if not parts:
            raise ValueError(Message("it holds no mesh"))
        unit, factor = self._unit()
        vertices, joined = join_placed(parts)
        told = [one for one in colors if one is not None]
        return RawSurface(
            factor * vertices,
            joined,
            np.concatenate(told) if len(told) == len(colors) else None,
            unit=unit,
            notes=tuple(dict.fromkeys(self._notes)),
        )

    def _shown(self, kind: Any) -> list[Any]:
        return [
            prim
            for prim in self._stage.Traverse()
            if prim.IsA(kind)
            and UsdGeom.Imageable(prim).ComputeVisibility() != UsdGeom.Tokens.invisible
        ]

    def _unit(self) -> tuple[Unit | None, float]:
        if not UsdGeom.StageHasAuthoredMetersPerUnit(self._stage):
            return None, 1.0
        metres = float(UsdGeom.GetStageMetersPerUnit(self._stage))
        if not 0 < metres < np.inf:
            raise ValueError(Message("its unit is no length"))
        unit = next((unit for size, unit in _UNITS.items() if np.isclose(metres, size)), None)
        return (unit, 1.0) if unit is not None else ("m", metres)

    def _colors(self, prim: Any, corners: IntArray, count: int) -> ByteArray | None:
        """Return the colours (count, 3) of points: their own, or those of a texture."""
        primvars = UsdGeom.PrimvarsAPI(prim)
        own = _values(primvars.GetPrimvar("displayColor"), 3)
        if own is not None and len(own) == count:
            return colors_of_shares(own)
        if own is not None and len(own) == len(corners):
            return mean_colors(corners, colors_of_shares(own), count)
        picture = self._texture(prim)
        uv = None if picture is None else _values(primvars.GetPrimvar("st"), 2)
        if picture is None or uv is None:
            return None
        if len(uv) == count:
            return sampled(picture, uv)
        return (
            mean_colors(corners, sampled(picture, uv), count) if len(uv) == len(corners) else None
        )

    def _texture(self, prim: Any) -> ByteArray | None:
        """Return the picture of the base colour of a mesh's material."""
        material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()
        shader = material.ComputeSurfaceSource()[0] if material else None
        color = shader.GetInput("diffuseColor") if shader else None
        source = color.GetConnectedSource() if color else None
        file = UsdShade.Shader(source[0].GetPrim()).GetInput("file") if source else None
        asset = file.Get() if file else None
        if asset is None:
            return None
        within = _IN_ARCHIVE.search(asset.path)
        name = (within[1] if within else asset.path).removeprefix("./")
        if name not in self._pictures:
            picture = None
            if name in self._archive.names:
                picture = decode_texture(self._archive.read(name, MOST_TEXTURE_BYTES))
            if picture is None:
                self._notes.append(missing_texture(name))
            self._pictures[name] = picture
        return self._pictures[name]


def _mesh(prim: Any) -> tuple[FloatArray, IntArray, IntArray]:
    """Return points (n, 3), the corners (k,) of all polygons, and triangles (m, 3)."""
    when = Usd.TimeCode.EarliestTime()
    points = _numbers(UsdGeom.PointBased(prim).GetPointsAttr().Get(when)).reshape(-1, 3)
    mesh = UsdGeom.Mesh(prim)
    if not mesh:
        none = np.empty(0, np.int64)
        return points, none, none.reshape(0, 3)
    corners = _numbers(mesh.GetFaceVertexIndicesAttr().Get(when)).astype(np.int64)
    counts = _numbers(mesh.GetFaceVertexCountsAttr().Get(when)).astype(np.int64)
    if (counts < 0).any() or counts.sum() != len(corners):
        raise ValueError(Message("a triangle in it is incomplete"))
    if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
        raise ValueError(Message("a triangle in it names a corner that it does not hold"))
    triangles = corners[fans(corners, counts)]
    is_left = mesh.GetOrientationAttr().Get(when) == UsdGeom.Tokens.leftHanded
    return points, corners, triangles[:, ::-1] if is_left else triangles


def _values(primvar: Any, width: int) -> FloatArray | None:
    """Return the values (n, width) of a primvar, unfolded; None where there are none."""
    values = primvar.ComputeFlattened(Usd.TimeCode.EarliestTime()) if primvar.HasValue() else None
    numbers = _numbers(values)
    return numbers.reshape(-1, width) if len(numbers) and numbers.size % width == 0 else None


def _numbers(values: Any) -> FloatArray:
    return np.empty(0) if values is None else np.asarray(values, dtype=np.float64)
