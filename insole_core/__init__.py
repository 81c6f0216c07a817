"""Everything that knows millimetres, points, feet and insoles: no Qt, no renderer, no USB.

What all packages stand on lies beside them: ``errors.InsoleError`` and its kinds,
``messages.Message``, ``progress.Progress``, ``memo.Memo``, and the bounded readers of foreign
files, ``json_object.JsonObject``, ``zip_archive.ZipArchive``, ``given_file.read_given``.
"""
