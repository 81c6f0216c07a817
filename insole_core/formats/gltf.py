"""Read glTF 2.0 and GLB files: meshes in the scene's frame, with their colours and textures.

Khronos Group, glTF 2.0 specification (ISO/IEC 12113). The unit of the format is the metre.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from dataclasses import dataclass, field
from typing import Any
from urllib.parse import unquote

import numpy as np
import numpy.typing as npt
import scipy

from insole_core.errors import InputError
from insole_core.formats.raw_surface import RawSurface, join_placed
from insole_core.formats.scan_content import MOST_BYTES, ScanContent
from insole_core.formats.texture import (
    MOST_TEXTURE_BYTES,
    colors_of_shares,
    decode_texture,
    missing_texture,
    sampled,
)
from insole_core.geometry.arrays import ByteArray, FloatArray, IntArray
from insole_core.messages import Message

_MAGIC, _JSON_CHUNK, _BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
_MOST_JSON_BYTES = 16 * 2**20
_COMPONENTS = {
    5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32,
    5126: np.float32,
}  # fmt: skip
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
_POINTS, _TRIANGLES, _STRIP, _FAN = 0, 4, 5, 6
_MOST_DEPTH, _MOST_PARTS = 64, 10_000
_COMPRESSED = {
    "KHR_draco_mesh_compression": "Draco",
    "EXT_meshopt_compression": "meshopt",
    "KHR_meshopt_compression": "meshopt",
}


def read_gltf(source: ScanContent) -> RawSurface:
    """Read all meshes of the scene, moved to their nodes' places.

    Raises
    ------
    InputError
        When it is compressed in a way that is not read.
    ValueError, LookupError, TypeError
        When it is damaged.
    """
    document = _Document.parsed(source)
    names = set(document.root.get("extensionsRequired", ())) & set(_COMPRESSED)
    if names:
        raise InputError(
            "{path} is compressed with {method}, which is not read; export it again without "
            "compression.",
            path=source.path,
            method=_COMPRESSED[min(names)],
        )
    parts = [
        (part, node2scene)
        for mesh, node2scene in document.placed_meshes()
        for part in document.parts(mesh)
    ]
    return _joined(parts, tuple(dict.fromkeys(document.notes)))


@dataclass(frozen=True, eq=False)
class _Part:
    """A primitive, in the frame of its node; normals are those of a cloud of points."""

    vertices: FloatArray
    triangles: IntArray
    colors: ByteArray | None
    normals: FloatArray | None


def _joined(parts: list[tuple[_Part, FloatArray]], notes: tuple[str, ...]) -> RawSurface:
    """Join the surfaces at their places; clouds of points count only where there is no surface."""
    surfaces = [(part, place) for part, place in parts if len(part.triangles)] or parts
    if not surfaces:
        raise ValueError(Message("it holds no mesh"))
    vertices, triangles = join_placed(
        (part.vertices, part.triangles, place) for part, place in surfaces
    )
    colors = [part.colors for part, _ in surfaces if part.colors is not None]
    normals = [
        part.normals @ place[:3, :3].T for part, place in surfaces if part.normals is not None
    ]
    return RawSurface(
        vertices,
        triangles,
        np.concatenate(colors) if len(colors) == len(surfaces) else None,
        np.concatenate(normals) if len(normals) == len(surfaces) else None,
        unit="m",
        notes=notes,
    )


@dataclass(eq=False)
class _Document:
    """The JSON of a glTF, and the bytes of its buffers."""

    root: dict[str, Any]
    binary: memoryview | None
    source: ScanContent
    notes: list[Message] = field(default_factory=list)
    buffers: dict[int, memoryview] = field(default_factory=dict)
    pictures: dict[int, ByteArray | None] = field(default_factory=dict)
    meshes: dict[int, list[_Part]] = field(default_factory=dict)

    @classmethod
    def parsed(cls, source: ScanContent) -> _Document:
        """Take the chunks of a GLB apart, or read the JSON of a glTF."""
        content = memoryview(source.content)
        text, binary = content, None
        if source.content.startswith(_MAGIC):
            text, binary = _chunks(content)
        most = _MOST_JSON_BYTES if source.content.startswith(_MAGIC) else MOST_BYTES
        if len(text) > most:
            raise ValueError(Message("its description is far too long"))
        root = json.loads(bytes(text))
        if not isinstance(root, dict):
            raise TypeError(Message("its description is no JSON object"))
        version = str(root.get("asset", {}).get("version", ""))
        if not version.startswith("2"):
            raise ValueError(
                Message("it is of version {version} instead of 2", version=version[:10] or "?")
            )
        return cls(root, binary, source)

    def placed_meshes(self) -> list[tuple[int, FloatArray]]:
        """Return the number of every mesh of the scene with the transform (4, 4) of its node."""
        nodes, meshes = self.root.get("nodes", []), self.root.get("meshes", [])
        scenes = self.root.get("scenes", [])
        if not nodes or not scenes:
            return [(number, np.eye(4)) for number in range(len(meshes))]
        found: list[tuple[int, FloatArray]] = []
        scene = scenes[_index(self.root.get("scene", 0), scenes)]
        waiting = [(number, np.eye(4), 0) for number in scene.get("nodes", [])]
        visited = 0
        while waiting:
            number, parent2scene, depth = waiting.pop()
            visited += 1
            if depth > _MOST_DEPTH or visited > _MOST_PARTS:
                raise ValueError(Message("its nodes contain each other, or are far too many"))
            node = nodes[_index(number, nodes)]
            node2scene = parent2scene @ _node2parent(node)
            if "mesh" in node:
                found.append((_index(node["mesh"], meshes), node2scene))
            waiting += [(child, node2scene, depth + 1) for child in node.get("children", [])]
        return found

    def parts(self, mesh: int) -> list[_Part]:
        """Return the parts of a mesh, which is read once, however often it is placed."""
        if mesh not in self.meshes:
            primitives = self.root["meshes"][mesh]["primitives"]
            parts = [self._part(primitive) for primitive in primitives]
            self.meshes[mesh] = [part for part in parts if part is not None]
        return self.meshes[mesh]

    def _part(self, primitive: dict[str, Any]) -> _Part | None:
        """Return the triangles or points of a primitive; None for lines."""
        attributes = primitive["attributes"]
        vertices = self._numbers(attributes["POSITION"], 3)
        mode = primitive.get("mode", _TRIANGLES)
        if mode not in {_POINTS, _TRIANGLES, _STRIP, _FAN}:
            return None
        triangles = np.empty((0, 3), dtype=np.int64)
        if mode != _POINTS:
            corners = np.arange(len(vertices))
            if "indices" in primitive:
                corners = self._array(primitive["indices"], 1)[:, 0].astype(np.int64)
            triangles = _triangles(corners, mode)
        normals = None
        if mode == _POINTS and "NORMAL" in attributes:
            normals = self._numbers(attributes["NORMAL"], 3)
        return _Part(vertices, triangles, self._colors(primitive), normals)

    def _colors(self, primitive: dict[str, Any]) -> ByteArray | None:
        """Return the colours (n, 3) of the vertices by attribute or texture; None without."""
        attributes = primitive["attributes"]
        if "COLOR_0" in attributes:
            accessor = self.root["accessors"][attributes["COLOR_0"]]
            shades = self._numbers(attributes["COLOR_0"], _WIDTHS[accessor["type"]])[:, :3]
            return colors_of_shares(shades)
        if "material" not in primitive:
            return None
        materials = self.root.get("materials", [])
        material = materials[_index(primitive["material"], materials)]
        texture = material.get("pbrMetallicRoughness", {}).get("baseColorTexture")
        if texture is None:
            return None
        name = f"TEXCOORD_{texture.get('texCoord', 0)}"
        picture = self._picture(texture["index"])
        if picture is None or name not in attributes:
            return None
        uv = self._numbers(attributes[name], 2)
        uv[:, 1] = 1.0 - uv[:, 1]  # counted from the upper edge
        return sampled(picture, uv)

    def _picture(self, texture: int) -> ByteArray | None:
        textures, images = self.root.get("textures", []), self.root.get("images", [])
        number = textures[_index(texture, textures)].get("source")
        if number is None:
            return None
        if number not in self.pictures:
            image = images[_index(number, images)]
            content = self._image_content(image)
            picture = None if content is None else decode_texture(content)
            if picture is None:
                name = str(image.get("name") or image.get("uri") or number)
                self.notes.append(missing_texture(name))
            self.pictures[number] = picture
        return self.pictures[number]

    def _image_content(self, image: dict[str, Any]) -> bytes | None:
        if "bufferView" in image:
            return bytes(self._view(image["bufferView"])[0])
        return self._by_uri(image["uri"], MOST_TEXTURE_BYTES)

    def _numbers(self, accessor: int, width: int) -> FloatArray:
        """Return the values (n, width) of an accessor as float64."""
        values = self._array(accessor, width)
        numbers = values.astype(np.float64)
        if self.root["accessors"][accessor].get("normalized") and values.dtype.kind in "iu":
            numbers = np.maximum(numbers / np.iinfo(values.dtype).max, -1.0)
        return numbers

    def _array(self, number: int, width: int) -> npt.NDArray[Any]:
        """Return the values (n, width) that an accessor describes, without copying if possible."""
        accessors = self.root.get("accessors", [])
        accessor = accessors[_index(number, accessors)]
        if accessor["type"] not in _WIDTHS or _WIDTHS[accessor["type"]] != width:
            raise ValueError(
                Message("one of its arrays is of the type {type}", type=str(accessor["type"])[:20])
            )
        if "sparse" in accessor or "bufferView" not in accessor:
            raise ValueError(Message("it holds arrays in parts, which are not read"))
        kind = np.dtype(_COMPONENTS[accessor["componentType"]]).newbyteorder("<")
        count, offset = int(accessor["count"]), int(accessor.get("byteOffset", 0))
        view, stride = self._view(accessor["bufferView"])
        stride = stride or kind.itemsize * width
        needed = offset + stride * (count - 1) + kind.itemsize * width
        if count < 1 or offset < 0 or stride < kind.itemsize * width or needed > len(view):
            raise ValueError(Message("one of its arrays is longer than the bytes it holds"))
        return np.ndarray((count, width), kind, view, offset, (stride, kind.itemsize))

    def _view(self, number: int) -> tuple[memoryview, int]:
        """Return the bytes of a view, and its stride or 0."""
        views = self.root.get("bufferViews", [])
        view = views[_index(number, views)]
        buffer = self._buffer(view["buffer"])
        offset, length = int(view.get("byteOffset", 0)), int(view["byteLength"])
        if offset < 0 or length < 0 or offset + length > len(buffer):
            raise ValueError(Message("it holds fewer bytes than it declares"))
        return buffer[offset : offset + length], int(view.get("byteStride", 0))

    def _buffer(self, number: int) -> memoryview:
        if number not in self.buffers:
            all_buffers = self.root.get("buffers", [])
            buffer = all_buffers[_index(number, all_buffers)]
            if "uri" not in buffer and number == 0 and self.binary is not None:
                self.buffers[number] = self.binary
            else:
                content = self._by_uri(str(buffer.get("uri", "")), MOST_BYTES)
                if content is None:
                    raise ValueError(
                        Message(
                            "the file {name} is not beside it", name=str(buffer.get("uri"))[:60]
                        )
                    )
                self.buffers[number] = memoryview(content)
        return self.buffers[number]

    def _by_uri(self, uri: str, most_bytes: int) -> bytes | None:
        if uri.startswith("data:"):
            try:
                return base64.b64decode(uri.partition(",")[2], validate=True)
            except binascii.Error as error:
                raise ValueError(Message("bytes in it are cut off")) from error
        return self.source.beside(unquote(uri), most_bytes)


def _chunks(content: memoryview) -> tuple[memoryview, memoryview | None]:
    """Return the JSON and the binary chunk of a GLB."""
    _magic, version, length = struct.unpack_from("<4sII", content)
    if version != 2:
        raise ValueError(Message("it is of version {version} instead of 2", version=version))
    if length > len(content):
        raise ValueError(
            Message("it declares {count} bytes and holds {held}", count=length, held=len(content))
        )
    found: dict[int, memoryview] = {}
    place = 12
    while place + 8 <= length:
        size, kind = struct.unpack_from("<II", content, place)
        if place + 8 + size > length:
            raise ValueError(Message("one of its chunks is cut off"))
        found.setdefault(kind, content[place + 8 : place + 8 + size])
        place += 8 + size
    if _JSON_CHUNK not in found:
        raise ValueError(Message("it holds no description of its meshes"))
    return found[_JSON_CHUNK], found.get(_BINARY_CHUNK)


def _index(number: Any, values: list[Any]) -> int:
    if not isinstance(number, int) or not 0 <= number < len(values):
        raise ValueError(Message("it names something that it does not hold"))
    return number


def _node2parent(node: dict[str, Any]) -> FloatArray:
    if "matrix" in node:
        matrix = np.array(node["matrix"], dtype=float).reshape(4, 4).T
    else:
        matrix = np.eye(4)
        rotation = np.array(node.get("rotation", [0, 0, 0, 1]), dtype=float)
        scale = np.array(node.get("scale", [1, 1, 1]), dtype=float)
        matrix[:3, :3] = scipy.spatial.transform.Rotation.from_quat(rotation).as_matrix() * scale
        matrix[:3, 3] = np.array(node.get("translation", [0, 0, 0]), dtype=float)
    if not np.isfinite(matrix).all():
        raise ValueError(Message("the place of a part in it is no number"))
    return matrix


def _triangles(corners: IntArray, mode: int) -> IntArray:
    """Return the triangles (m, 3) of a list, strip or fan."""
    if mode == _TRIANGLES:
        if len(corners) % 3:
            raise ValueError(Message("a triangle in it is incomplete"))
        return corners.reshape(-1, 3)
    if len(corners) < 3:
        return np.empty((0, 3), dtype=np.int64)
    if mode == _FAN:
        firsts = np.full(len(corners) - 2, corners[0])
        return np.column_stack([firsts, corners[1:-1], corners[2:]])
    strip = np.column_stack([corners[:-2], corners[1:-1], corners[2:]])
    strip[1::2] = strip[1::2, [1, 0, 2]]
    return strip
