"""Pictures of the other modules with multisampling: each mode, method and kind of surface."""

from dataclasses import replace

from images.picture import SCENES, variant

_SUBJECTS = {
    2: ("mode_lit", "alpha_mode_lit", "wireframe_overlay", "lines"),
    4: (
        "alpha_hidden_none",
        "alpha_mode_depth",
        "alpha_mode_lit",
        "alpha_painter",
        "alpha_wireframe_only",
        "alpha_wireframe_overlay",
        "alpha_without_background",
        "anisotropic_16",
        "anisotropic_blend",
        "anisotropic_maps",
        "brushed",
        "coplanar",
        "exact_shadow_holes_nearest",
        "far_plane_cuts",
        "floor_to_the_horizon",
        "fog_in_front",
        "forward_lit",
        "giant_triangles",
        "glass_front",
        "gradient",
        "hidden_none",
        "intersecting",
        "lines",
        "many_lights",
        "many_small_triangles",
        "mode_depth",
        "mode_lit",
        "mode_lit_linear",
        "mode_normal",
        "mode_overdraw",
        "mode_random",
        "mode_unlit",
        "near_plane_cuts",
        "occlusion",
        "painter",
        "physical_floor",
        "physical_maps_trilinear",
        "points",
        "round_lines_painter",
        "shadow_on_glass",
        "size_257x31",
        "size_2x3",
        "size_large",
        "slivers",
        "specular",
        "texture_trilinear_repeat",
        "tone_wireframe",
        "transparent_background",
        "two_sided_beside_culled",
        "wireframe_only",
        "wireframe_only_hidden_lines",
        "wireframe_overlay_wide",
    ),
    8: (
        "alpha_leaf_bilinear_srgb",
        "alpha_mode_lit",
        "layers",
        "mode_lit",
        "transparent_background",
    ),
    16: (
        "alpha_leaf_bilinear_linear",
        "alpha_mode_lit",
        "hills",
        "lines",
        "mode_lit",
        "wireframe_overlay",
    ),
}


def multisampled(name, samples, **options):
    """A picture of another module, drawn with so many samples a pixel."""
    picture = SCENES[name]()
    options = picture.options | options
    return replace(picture, samples=samples, antialiasing="msaa", options=options)


for _samples, _names in _SUBJECTS.items():
    for _name in _names:
        variant(f"msaa_{_samples}_{_name}", multisampled, _name, _samples)
    for _name in ("alpha_mode_lit", "alpha_leaf_bilinear_srgb"):
        variant(
            f"msaa_{_samples}_{_name}_to_coverage",
            multisampled,
            _name,
            _samples,
            alpha_to_coverage=True,
        )
variant("msaa_4_painter_to_coverage", multisampled, "alpha_painter", 4, alpha_to_coverage=True)
variant(
    "msaa_4_wireframe_to_coverage", multisampled, "alpha_wireframe_only", 4, alpha_to_coverage=True
)

for _name in (
    "alpha_hidden_none",
    "alpha_mode_lit",
    "alpha_painter",
    "alpha_wireframe_only",
    "alpha_wireframe_overlay",
    "anisotropic_maps",
    "exact_shadow_holes_nearest",
    "fog_in_front",
    "glass_front",
    "gradient",
    "many_small_triangles",
    "mode_lit",
    "physical_maps_trilinear",
    "shadow_on_glass",
    "transparent_background",
):
    variant(f"msaa_4_{_name}_alone", multisampled, _name, 4, sample_shading=True)
variant("msaa_16_alpha_mode_lit_alone", multisampled, "alpha_mode_lit", 16, sample_shading=True)
