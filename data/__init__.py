"""The models, textures and fonts that come with engine3d; all but the fonts are its own.

Files here are found with `importlib.resources.files("engine3d.data")`; the scripts that made them
are in the folder `scripts` of the source tree.
"""
