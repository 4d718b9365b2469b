/* The targets of a frame: arrays, (height, width[, channels]). NULL: that output is not asked for, and is not computed. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The outputs: X(ENUMERATOR, name, type of a channel, channels, the value where nothing shows, the item of the plan that asks
 * for it). IDs are of faces, lines and points; face_id is -1 on the latter two. Directions have unit length; normals look
 * towards the viewer. */
#define E3D_EACH_OUTPUT(X) \
    X(E3D_OUTPUT_COLOR, color, uint8_t, 4, 0, COLOR) /* RGBA */ \
    X(E3D_OUTPUT_DEPTH, depth, float, 1, 0, POSITIONS) /* along the view axis */ \
    X(E3D_OUTPUT_NDC_DEPTH, ndc_depth, float, 1, INFINITY, NDC_DEPTH) \
    X(E3D_OUTPUT_FACE_ID, face_id, int32_t, 1, -1, IDENTITIES) \
    X(E3D_OUTPUT_OBJECT_ID, object_id, int32_t, 1, -1, IDENTITIES) \
    X(E3D_OUTPUT_INSTANCE_ID, instance_id, int32_t, 1, -1, IDENTITIES) \
    X(E3D_OUTPUT_MATERIAL_ID, material_id, int32_t, 1, -1, IDENTITIES) \
    X(E3D_OUTPUT_ALBEDO, albedo, float, 3, 0, ALBEDO) /* working space */ \
    X(E3D_OUTPUT_NORMAL, normal, float, 3, 0, NORMALS) /* view space */ \
    X(E3D_OUTPUT_POSITION, position, float, 3, 0, POSITIONS) /* view space */ \
    X(E3D_OUTPUT_WORLD_NORMAL, world_normal, float, 3, 0, NORMALS) \
    X(E3D_OUTPUT_WORLD_POSITION, world_position, float, 3, 0, POSITIONS) \
    X(E3D_OUTPUT_UV, uv, float, 2, 0, UVS) \
    X(E3D_OUTPUT_BARYCENTRIC, barycentric, float, 3, 0, BARYCENTRIC) \
    X(E3D_OUTPUT_METALLIC_ROUGHNESS, metallic_roughness, float, 2, 0, MATERIALS) \
    X(E3D_OUTPUT_EMISSIVE, emissive, float, 3, 0, MATERIALS) /* working space */ \
    X(E3D_OUTPUT_TANGENT, tangent, float, 4, 0, TANGENTS) /* view space, and the sign of the bitangent */ \
    X(E3D_OUTPUT_RADIANCE, radiance, float, 3, 0, RADIANCE) /* the working space's colour before tone mapping and clamping */ \
    X(E3D_OUTPUT_RANGE, range, float, 1, 0, POSITIONS) /* along the pixel's ray */

typedef enum e3d_output_kind { E3D_EACH_OUTPUT(E3D_ENUMERATOR) E3D_OUTPUTS } e3d_output_kind;

#define E3D_TARGET(enumerator, name, type, ...) type *name;
typedef struct e3d_targets {
    E3D_EACH_OUTPUT(E3D_TARGET)
} e3d_targets;

/* The same by number. */
void e3d_targets_set(e3d_targets *targets, e3d_output_kind output, void *pixels);
void *e3d_targets_get(const e3d_targets *targets, e3d_output_kind output);

extern const e3d_array_format E3D_OUTPUT_FORMATS[E3D_OUTPUTS];

#ifdef __cplusplus
}
#endif
