/* The standard patterns of Direct3D 11 (D3D11_STANDARD_MULTISAMPLE_PATTERN), which gives them in 1/16 pixel. */
#include "data/sample_patterns.h"

#include <stddef.h>

static const e3d_sample_pattern TWO = {2, 64, {64, -64}, {64, -64}};
static const e3d_sample_pattern FOUR = {4, 96, {-32, 96, -96, 32}, {-96, -32, 32, 96}};
static const e3d_sample_pattern EIGHT = {8, 112, {16, -16, 80, -48, -80, -112, 48, 112}, {-48, 48, 16, -80, 80, -16, 112, -112}};
static const e3d_sample_pattern SIXTEEN = {16,
                                           128,
                                           {16, -16, -48, 64, -80, 32, 80, 48, -32, 0, -64, -96, -128, 112, 96, -112},
                                           {16, -48, 32, -16, -32, 80, 48, -80, 96, -112, -96, 64, 0, -64, 112, -128}};

const e3d_sample_pattern *e3d_sample_pattern_of(int32_t samples)
{
    switch (samples) {
    case 2: return &TWO;
    case 4: return &FOUR;
    case 8: return &EIGHT;
    case 16: return &SIXTEEN;
    default: return NULL;
    }
}
