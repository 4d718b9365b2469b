/* The directions of ambient occlusion, spread evenly. The order of pixels is that of ordered dithering (Bayer 1973); with the distances by
 * reversed bits (Hammersley 1960), every square of four, of sixteen and of all pixels of a cell looks all around, near and far.
 */
#include "data/occlusion_pattern.h"

const float E3D_OCCLUSION_COSINES[16] = {
    0x1.ff621ep-1f,
    0x1.fa7558p-1f,
    0x1.f0a7fp-1f,
    0x1.e2121p-1f,
    0x1.ced7bp-1f,
    0x1.b72834p-1f,
    0x1.9b3e04p-1f,
    0x1.7b5df2p-1f,
    0x1.57d694p-1f,
    0x1.30ff8p-1f,
    0x1.07387ap-1f,
    0x1.b5d1p-2f,
    0x1.58f9a8p-2f,
    0x1.f19f98p-3f,
    0x1.2c8106p-3f,
    0x1.91f66p-5f,
};
