"""The markers of the reference system in a picture.

``blobs.find_blobs``, ``detections.Detections``, ``marker_observation.Registration``.
"""
