"""Meshes, transforms, rays, sections: what knows neither feet nor sensors.

``mesh.TriangleMesh``, ``transforms.transform``, ``side.Side``, and the shapes of arrays in
``arrays``.
"""
