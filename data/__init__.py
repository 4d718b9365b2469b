"""The models, textures and scenes that come with engine3d, all made by the project itself.

Files here are found with `importlib.resources.files("engine3d.data")`; the scripts that made them
are in the folder `scripts` of the source tree.
"""
