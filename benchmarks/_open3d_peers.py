"""Open3D's surfaces from the placed views that the product starts from, if it is installed."""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from insole_core.geometry.arrays import FloatArray
from insole_core.geometry.mesh import TriangleMesh
from insole_core.geometry.transforms import inverse
from insole_core.reconstruct.fusion.depth_view import DepthView, read_volume
from insole_core.reconstruct.fusion.prepared_view import smooth_depth
from insole_core.reconstruct.views.measured_view import measure_view
from insole_core.reconstruct.volume import volume_of_interest
from insole_core.recording.session import Session

Peer = Callable[[list[DepthView]], TriangleMesh]

_POISSON_DEPTH = 7
_POISSON_REACH_MM = 2.5
_VOXEL_MM, _TRUNCATION_MM = 1.0, 5.0


def open3d_peers() -> dict[str, Peer]:
    """Return the peers by name; print a message and return none if Open3D is not installed."""
    try:
        open3d = importlib.import_module("open3d")
    except ImportError:
        print("Open3D is not installed (pip install insole-studio[bench]): its rows are skipped.")
        return {}
    return {
        "Open3D screened Poisson": lambda readings: _poisson(open3d, readings),
        "Open3D TSDF 1 mm": lambda readings: _tsdf(open3d, readings),
    }


def readings_of(session: Session) -> list[DepthView]:
    """Return the placed views that all pipelines but the thesis's start from."""
    placed = []
    for view in map(measure_view, session.views):
        pose = view.register(session.manifest.reference_system).sensor2reference
        box, sensor = volume_of_interest(session), view.view.sensor
        placed.append(
            read_volume(view.view.name, sensor, pose, box, raw=view.raw, color=view.color)
        )
    return placed


def with_true_poses(readings: list[DepthView], path: Path) -> list[DepthView]:
    poses = json.loads((path / "truth_poses.json").read_text())["sensor2reference"]
    return [replace(one, sensor2reference=np.array(poses[one.name])) for one in readings]


def _poisson(open3d: Any, readings: list[DepthView]) -> TriangleMesh:
    cloud = open3d.geometry.PointCloud()
    for reading in readings:
        part = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(reading.surface_points))
        part.estimate_normals(open3d.geometry.KDTreeSearchParamHybrid(radius=6, max_nn=30))
        part.orient_normals_towards_camera_location(reading.origin_mm)
        cloud += part
    mesh, _ = open3d.geometry.TriangleMesh.create_from_point_cloud_poisson(
        cloud, depth=_POISSON_DEPTH
    )
    surface = _as_mesh(mesh)
    near, _ = cKDTree(np.asarray(cloud.points)).query(surface.vertices)
    return surface.part(np.asarray(near < _POISSON_REACH_MM))


def _tsdf(open3d: Any, readings: list[DepthView]) -> TriangleMesh:
    """Fuse smoothed depth maps, as the product does, in the dense volume; metres inside."""
    points = np.concatenate([reading.surface_points for reading in readings])
    low = points.min(0) - 20
    length = float((points.max(0) + 20 - low).max())
    volume = open3d.pipelines.integration.UniformTSDFVolume(
        length=length / 1000,
        resolution=int(length / _VOXEL_MM),
        sdf_trunc=_TRUNCATION_MM / 1000,
        color_type=open3d.pipelines.integration.TSDFVolumeColorType.NoColor,
        origin=low[:, None] / 1000,
    )
    for reading in readings:
        camera = reading.sensor.depth_camera
        intrinsic = open3d.camera.PinholeCameraIntrinsic(
            camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy
        )
        depth = open3d.geometry.Image(_whole_depth_m(reading))
        grey = open3d.geometry.Image(np.zeros((camera.height, camera.width), np.uint8))
        image = open3d.geometry.RGBDImage.create_from_color_and_depth(
            grey, depth, depth_scale=1.0, depth_trunc=3.0, convert_rgb_to_intensity=False
        )
        volume.integrate(image, intrinsic, _in_metres(inverse(reading.sensor2reference)))
    mesh = _as_mesh(volume.extract_triangle_mesh())
    return TriangleMesh(1000 * mesh.vertices, mesh.triangles)


def _whole_depth_m(reading: DepthView) -> np.ndarray:
    camera = reading.sensor.depth_camera
    depth = np.zeros((camera.height, camera.width), np.float32)
    part = np.nan_to_num(smooth_depth(reading).depth_mm) / 1000
    u, v = reading.corner
    depth[v : v + part.shape[0], u : u + part.shape[1]] = part
    return depth


def _in_metres(pose: FloatArray) -> FloatArray:
    scaled = pose.copy()
    scaled[:3, 3] /= 1000
    return scaled


def _as_mesh(mesh: Any) -> TriangleMesh:
    return TriangleMesh(
        np.asarray(mesh.vertices, dtype=float), np.asarray(mesh.triangles, dtype=np.int32)
    )
