"""The 3-D pictures: the only package that knows the renderer.

``scene_view.SceneView`` is a view, ``pointer.PointerEvent`` what a tool gets from it,
``pointer.Gesture`` a drag.
"""
