/* The directions of ambient occlusion, spread evenly, and the light of its sectors. Sites are ordered as in ordered dithering
 * (Bayer 1973), and distances are reversed bits (Hammersley 1960), so that the sites of every square of four and of a whole
 * cell look in all directions, near and far. */
#include "data/occlusion_pattern.h"

/* cos((n + 1/2) pi/64) */
const float E3D_OCCLUSION_COSINES[E3D_OCCLUSION_NUMBERS] = {
    0x1.ffd886p-1f, 0x1.fe9cdap-1f, 0x1.fc2648p-1f, 0x1.f8765p-1f, 0x1.f38f3ap-1f, 0x1.ed740ep-1f, 0x1.e6288ep-1f, 0x1.ddb13cp-1f,
    0x1.d4134ep-1f, 0x1.c954b2p-1f, 0x1.bd7c0ap-1f, 0x1.b090a6p-1f, 0x1.a29a7ap-1f, 0x1.93a224p-1f, 0x1.83b0ep-1f, 0x1.72d084p-1f,
    0x1.610b76p-1f, 0x1.4e6cacp-1f, 0x1.3affa2p-1f, 0x1.26d054p-1f, 0x1.11eb36p-1f, 0x1.f8ba4ep-2f, 0x1.cc66eap-2f, 0x1.9ef794p-2f,
    0x1.708854p-2f, 0x1.4135cap-2f, 0x1.111d26p-2f, 0x1.c0b826p-3f, 0x1.5e2144p-3f, 0x1.f564e6p-4f, 0x1.2d520ap-4f, 0x1.92156p-6f,
    -0x1.92156p-6f, -0x1.2d520ap-4f, -0x1.f564e6p-4f, -0x1.5e2144p-3f, -0x1.c0b826p-3f, -0x1.111d26p-2f, -0x1.4135cap-2f, -0x1.708854p-2f,
    -0x1.9ef794p-2f, -0x1.cc66eap-2f, -0x1.f8ba4ep-2f, -0x1.11eb36p-1f, -0x1.26d054p-1f, -0x1.3affa2p-1f, -0x1.4e6cacp-1f, -0x1.610b76p-1f,
    -0x1.72d084p-1f, -0x1.83b0ep-1f, -0x1.93a224p-1f, -0x1.a29a7ap-1f, -0x1.b090a6p-1f, -0x1.bd7c0ap-1f, -0x1.c954b2p-1f, -0x1.d4134ep-1f,
    -0x1.ddb13cp-1f, -0x1.e6288ep-1f, -0x1.ed740ep-1f, -0x1.f38f3ap-1f, -0x1.f8765p-1f, -0x1.fc2648p-1f, -0x1.fe9cdap-1f, -0x1.ffd886p-1f,
};

/* The changes, from sector to sector, of sin^2 and of the angle minus sin cos, of the angle whose tangent is p/(1 - p), where p
 * is 0, 1/10 ... 2. */
const int16_t E3D_OCCLUSION_LIGHT[2][E3D_OCCLUSION_SECTORS] = {
    {50, 191, 395, 624, 788, 788, 624, 395, 191, 50, -50, -191, -395, -624, -788, -788, -624, -395, -191, -50},
    {4, 36, 135, 343, 651, 966, 1158, 1174, 1064, 903, 903, 1064, 1174, 1158, 966, 651, 343, 135, 36, 4},
};
