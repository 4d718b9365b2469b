/* A half circle in 64 steps, for the ends of round lines and for round points (R114). */
#pragma once

enum { E3D_HALF_CIRCLE = 64 };

/* cos(j pi / 64), j from 0 to 32, each the nearest f64. */
static const double E3D_QUARTER_COSINES[E3D_HALF_CIRCLE / 2 + 1] = {
    1.0,
    0x1.ff621e3796d7ep-1,
    0x1.fd88da3d12526p-1,
    0x1.fa7557f08a517p-1,
    0x1.f6297cff75cb0p-1,
    0x1.f0a7efb9230d7p-1,
    0x1.e9f4156c62ddap-1,
    0x1.e212104f686e5p-1,
    0x1.d906bcf328d46p-1,
    0x1.ced7af43cc773p-1,
    0x1.c38b2f180bdb1p-1,
    0x1.b728345196e3ep-1,
    0x1.a9b66290ea1a3p-1,
    0x1.9b3e047f38741p-1,
    0x1.8bc806b151741p-1,
    0x1.7b5df226aafafp-1,
    0x1.6a09e667f3bcdp-1,
    0x1.57d69348ceca0p-1,
    0x1.44cf325091dd6p-1,
    0x1.30ff7fce17035p-1,
    0x1.1c73b39ae68c8p-1,
    0x1.073879922ffeep-1,
    0x1.e2b5d3806f63bp-2,
    0x1.b5d1009e15cc0p-2,
    0x1.87de2a6aea963p-2,
    0x1.58f9a75ab1fddp-2,
    0x1.294062ed59f06p-2,
    0x1.f19f97b215f1bp-3,
    0x1.8f8b83c69a60bp-3,
    0x1.2c8106e8e613ap-3,
    0x1.917a6bc29b42cp-4,
    0x1.91f65f10dd814p-5,
    0.0,
};

/* Of step j from 0 to 64. */
static inline double e3d_half_circle_cosine(int j)
{
    return j <= 32 ? E3D_QUARTER_COSINES[j] : -E3D_QUARTER_COSINES[64 - j];
}

static inline double e3d_half_circle_sine(int j)
{
    return j <= 32 ? E3D_QUARTER_COSINES[32 - j] : E3D_QUARTER_COSINES[j - 32];
}
