"""The editor's window: panels by Dear ImGui, drawn by the engine's own rasteriser.

It needs ``pip install engine3d[editor]``, and is imported by ``engine3d edit`` only.
"""
