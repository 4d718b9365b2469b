/* All kernels of one instruction set, and their table E3D_TABLE. */
#include "kernels/kernels.h"

#include "kernels/generic/transform.inl"
#include "kernels/generic/setup.inl"
#include "kernels/generic/facing.inl"
#include "kernels/generic/record.inl"
#include "kernels/generic/fragments.inl"
#include "kernels/generic/raster.inl"
#include "kernels/generic/block_rows.inl"
#include "kernels/generic/visible.inl"
#include "kernels/generic/visible_records.inl"
#include "kernels/generic/planes.inl"
#include "kernels/generic/mixed.inl"
#include "kernels/generic/runs.inl"
#include "kernels/generic/shown.inl"
#include "kernels/generic/spans.inl"
#include "kernels/generic/layers.inl"
#include "kernels/generic/surface.inl"
#include "kernels/generic/project.inl"
#include "kernels/generic/interpolate.inl"
#include "kernels/generic/texture.inl"
#include "kernels/generic/anisotropic.inl"
#include "kernels/generic/light.inl"
#include "kernels/generic/hidden.inl"
#include "kernels/generic/encode.inl"
#include "kernels/generic/albedo.inl"
#include "kernels/generic/lobe.inl"
#include "kernels/generic/environment.inl"
#include "kernels/generic/occlusion.inl"
#include "kernels/generic/maps.inl"
#include "kernels/generic/physical.inl"
#include "kernels/generic/tone.inl"
#include "kernels/generic/samples.inl"
#include "kernels/generic/paint.inl"
#include "kernels/generic/alpha.inl"
#include "kernels/generic/alpha_planes.inl"
#include "kernels/generic/stream.inl"
#include "kernels/generic/bloom.inl"
#include "kernels/generic/ui.inl"

const e3d_kernels E3D_TABLE = {
    .face_away = kernel_face_away,
    .transform = kernel_transform,
    .take_clip = kernel_take_clip,
    .setup = kernel_setup,
    .record = kernel_record,
    .add_small = kernel_add_small,
    .fragments = kernel_fragments,
    .raster_depth = kernel_raster_depth,
    .raster_overwrite = kernel_raster_overwrite,
    .raster_count = kernel_raster_count,
    .raster_mark = kernel_raster_mark,
    .raster_visible = kernel_raster_visible,
    .raster_fragments = kernel_raster_fragments,
    .raster_settle = kernel_raster_settle,
    .raster_alpha = kernel_raster_alpha,
    .raster_measure = kernel_raster_measure,
    .raster_planes = kernel_raster_planes,
    .planes_settle = kernel_planes_settle,
    .planes_measure = kernel_planes_measure,
    .planes_split = kernel_planes_split,
    .list_mixed = kernel_list_mixed,
    .cover_planes = kernel_cover_planes,
    .find_runs = kernel_find_runs,
    .take_runs = kernel_take_runs,
    .show_records = kernel_show_records,
    .show_fragments = kernel_show_fragments,
    .cover_records = kernel_cover_records,
    .show_alone = kernel_show_alone,
    .show_layers = kernel_show_layers,
    .take_shown = kernel_take_shown,
    .take_placed = kernel_take_placed,
    .project = kernel_project,
    .surface = kernel_surface,
    .interpolate = kernel_interpolate,
    .texture = kernel_texture,
    .tint = kernel_tint,
    .receivers = kernel_receivers,
    .hide = kernel_hide,
    .light = kernel_light,
    .combine = kernel_combine,
    .map_surfaces = kernel_map_surfaces,
    .maps = kernel_maps,
    .map_normals = kernel_map_normals,
    .varying = kernel_varying,
    .physical = kernel_physical,
    .environment = kernel_environment,
    .irradiance = kernel_irradiance,
    .albedo = kernel_albedo,
    .lobe = kernel_lobe,
    .nearness = kernel_nearness,
    .occlusion = kernel_occlusion,
    .occlusion_across = kernel_occlusion_across,
    .occlusion_down = kernel_occlusion_down,
    .backdrop = kernel_backdrop,
    .fog = kernel_fog,
    .tone = kernel_tone,
    .alpha = kernel_alpha,
    .lay = kernel_lay,
    .lay_through = kernel_lay_through,
    .blend = kernel_blend,
    .encode = kernel_encode,
    .put = kernel_put,
    .keep = kernel_keep,
    .average = kernel_average,
    .paint = kernel_paint,
    .stream = kernel_stream,
    .bloom_bright = kernel_bloom_bright,
    .bloom_rows = kernel_bloom_rows,
    .bloom_halve = kernel_bloom_halve,
    .bloom_mix = kernel_bloom_mix,
    .bloom_spread = kernel_bloom_spread,
    .bloom_lay = kernel_bloom_lay,
    .ui = kernel_ui,
};
