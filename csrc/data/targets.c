/* The outputs of a frame by number, from the list in e3d_targets.h. */
#include "e3d.h"

void e3d_targets_set(e3d_targets *targets, e3d_output_kind output, void *pixels)
{
    switch (output) {
#define SET(output, name, ...) \
    case output: targets->name = pixels; return;
        E3D_EACH_OUTPUT(SET)
    case E3D_OUTPUTS: return;
    }
}

void *e3d_targets_get(const e3d_targets *targets, e3d_output_kind output)
{
    switch (output) {
#define GET(output, name, ...) \
    case output: return targets->name;
        E3D_EACH_OUTPUT(GET)
    case E3D_OUTPUTS: return NULL;
    }
    return NULL;
}

#define FORMAT(output, name, type, channels, ...) {#name, channels, sizeof(type), (type)0.5f != 0},
const e3d_array_format E3D_OUTPUT_FORMATS[E3D_OUTPUTS] = {E3D_EACH_OUTPUT(FORMAT)};
