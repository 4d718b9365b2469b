"""Contact sheets: pictures of a model from several sides, and a report.

In: files, meshes or scenes. Out: a `Sheet`: pixels, and a dict that JSON takes. The same input
gives the same bytes on every machine.
"""
