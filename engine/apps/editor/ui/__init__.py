"""The editor's window: Dear ImGui panels, drawn by the engine's own rasteriser.

It needs ``pip install engine3d[editor]``, and only ``engine3d edit`` imports it.
"""
