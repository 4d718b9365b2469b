"""The table of pictures: name -> function that makes the Picture. One module a subject fills it."""

from images import (  # noqa: F401
    scenes_alpha,
    scenes_form,
    scenes_geometry,
    scenes_lights,
    scenes_looks,
    scenes_physical,
    scenes_textures,
    scenes_views,
)
from images.picture import SCENES

__all__ = ["SCENES"]
