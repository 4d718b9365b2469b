/* The names of options' values, from the lists that their enums are made from. */
#include "e3d.h"

#define NAME(enumerator, name, ...) #name,
#define NAMES(list) \
    (const char *const[]) { list(NAME) NULL }

static const char *const *const NAMES_OF[E3D_OPTIONS] = {
    [E3D_OPTION_ALPHA_MODE] = NAMES(E3D_EACH_ALPHA_MODE),
    [E3D_OPTION_BACKEND] = NAMES(E3D_EACH_BACKEND),
    [E3D_OPTION_CULL] = NAMES(E3D_EACH_CULL),
    [E3D_OPTION_CULLING] = NAMES(E3D_EACH_CULLING),
    [E3D_OPTION_FALLOFF] = NAMES(E3D_EACH_FALLOFF),
    [E3D_OPTION_FILTER] = NAMES(E3D_EACH_FILTER),
    [E3D_OPTION_HIDDEN] = NAMES(E3D_EACH_HIDDEN),
    [E3D_OPTION_LIGHT_KIND] = NAMES(E3D_EACH_LIGHT_KIND),
    [E3D_OPTION_LINE_SHAPE] = NAMES(E3D_EACH_LINE_SHAPE),
    [E3D_OPTION_MAP_LAYOUT] = NAMES(E3D_EACH_MAP_LAYOUT),
    [E3D_OPTION_MODE] = NAMES(E3D_EACH_MODE),
    [E3D_OPTION_NORMALS] = NAMES(E3D_EACH_NORMALS),
    [E3D_OPTION_POINT_SHAPE] = NAMES(E3D_EACH_POINT_SHAPE),
    [E3D_OPTION_SHADING] = NAMES(E3D_EACH_SHADING),
    [E3D_OPTION_TEXTURE_SLOT] = NAMES(E3D_EACH_TEXTURE_SLOT),
    [E3D_OPTION_TONE_MAPPING] = NAMES(E3D_EACH_TONE_MAPPING),
    [E3D_OPTION_WIREFRAME] = NAMES(E3D_EACH_WIREFRAME),
    [E3D_OPTION_WRAP] = NAMES(E3D_EACH_WRAP),
};

const char *e3d_option_name(e3d_option option, int32_t value)
{
    const char *const *name = (unsigned)option < E3D_OPTIONS ? NAMES_OF[option] : NULL;
    while (name && *name && value > 0) {
        name++;
        value--;
    }
    return name && value == 0 ? *name : NULL;
}

const char *e3d_backend_name(e3d_backend backend)
{
    const char *name = e3d_option_name(E3D_OPTION_BACKEND, (int32_t)backend);
    return name ? name : "unknown";
}
