"""The table of pictures: name -> function that makes the Picture. One module a subject fills it."""

from images import (  # noqa: F401
    scenes_alpha,
    scenes_ambient,
    scenes_area_lights,
    scenes_exact_shadows,
    scenes_facets,
    scenes_filters,
    scenes_form,
    scenes_geometry,
    scenes_glass,
    scenes_lights,
    scenes_looks,
    scenes_mirrors,
    scenes_multisampled,
    scenes_physical,
    scenes_refraction,
    scenes_shadows,
    scenes_textures,
    scenes_tone,
    scenes_translucent,
    scenes_views,
)
from images.picture import SCENES

__all__ = ["SCENES"]
