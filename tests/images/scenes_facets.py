"""Pictures of other subjects, with one normal and one light for each face."""

from images import (  # noqa: F401
    scenes_alpha,
    scenes_exact_shadows,
    scenes_glass,
    scenes_lights,
    scenes_looks,
    scenes_multisampled,
    scenes_physical,
    scenes_shadows,
    scenes_tone,
)
from images.picture import SCENES, variant

FACETED = (
    "alpha_front",
    "bloom_glass_msaa",
    "exact_shadow_all",
    "exact_shadow_physical",
    "fog_linear",
    "forward_lit",
    "glass_front",
    "mode_depth",
    "mode_lit",
    "mode_normal",
    "msaa_4_alpha_mode_lit",
    "msaa_4_many_lights",
    "physical_maps_of_two_wraps",
    "physical_many_lights",
    "point_lights_window",
    "samples_4",
    "shadow_lamp",
    "shadow_physical",
    "shadow_spot",
    "shadow_sun",
    "specular",
    "wireframe_overlay",
)


def faceted(name):
    picture = SCENES[name]()
    picture.options = {**picture.options, "normals": "facet"}
    return picture


for _name in FACETED:
    variant(f"facet_{_name}", faceted, _name)
