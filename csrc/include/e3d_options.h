/* Lists of named values. Each list stands once, as a macro E3D_EACH_...(X) beside its enum: X(ENUMERATOR, name, ...), where the
 * name is the one that users write. Enums, tables and options are made from it. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define E3D_ENUMERATOR(enumerator, ...) enumerator,

typedef enum e3d_option {
    E3D_OPTION_ALPHA_MODE = 0,
    E3D_OPTION_BACKEND,
    E3D_OPTION_CULL,
    E3D_OPTION_CULLING,
    E3D_OPTION_FALLOFF,
    E3D_OPTION_FILTER,
    E3D_OPTION_HIDDEN,
    E3D_OPTION_LIGHT_KIND,
    E3D_OPTION_LINE_SHAPE,
    E3D_OPTION_MAP_LAYOUT,
    E3D_OPTION_MODE,
    E3D_OPTION_NORMALS,
    E3D_OPTION_POINT_SHAPE,
    E3D_OPTION_SHADING,
    E3D_OPTION_TEXTURE_SLOT,
    E3D_OPTION_TONE_MAPPING,
    E3D_OPTION_WIREFRAME,
    E3D_OPTION_WRAP,
    E3D_OPTIONS
} e3d_option;

/* The name of a value, or NULL if there is none of that number. */
const char *e3d_option_name(e3d_option option, int32_t value);

/* The format of an output's array or of a vertex attribute's. */
typedef struct e3d_array_format {
    const char *name;
    int32_t channels;
    int32_t bytes, is_float; /* of a channel */
} e3d_array_format;

#ifdef __cplusplus
}
#endif
