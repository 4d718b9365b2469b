/* The directions of ambient occlusion, spread evenly. Pixels are ordered as in ordered dithering (Bayer 1973), and distances
 * are reversed bits (Hammersley 1960), so that the pixels of every square of four, of sixteen, and of a whole cell look in
 * all directions, near and far. */
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
