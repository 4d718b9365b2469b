/* Constants of tone mapping (R118, R119) and of fog (R120), and the thresholds of gradients (R122).
 *
 * ACES: Stephen Hill's fit, in the form that three.js uses: sRGB to AP1, brighter by 1/0.6, a rational curve, and back. AgX: Troy
 * Sobotka's, in the form that Filament and three.js use: sRGB to Rec. 2020 and inset, the logarithm, Benjamin Wrensch's polynomial of
 * the sigmoid, outset, and back from Rec. 2020. Products of matrices were found in float64 and rounded once.
 */
#ifndef E3D_TONE_TABLES_H
#define E3D_TONE_TABLES_H

#include <stdint.h>

#define E3D_MOST_LIGHT 0x1p16f /* what is brighter counts as this bright */

static const float E3D_ACES_IN[3][3] = {
    {0x1.fd9a26p-1f, 0x1.2e932ep-1f, 0x1.494008p-4f},
    {0x1.0369d0p-3f, 0x1.838ef4p+0f, 0x1.ab9f56p-6f},
    {0x1.83c132p-5f, 0x1.c8ce70p-3f, 0x1.6572d4p+0f},
};
static const float E3D_ACES_OUT[3][3] = {
    {1.60475f, -0.53108f, -0.07367f},
    {-0.10208f, 1.10813f, -0.00605f},
    {-0.00327f, -0.07276f, 1.07602f},
};
static const float E3D_AGX_IN[3][3] = {
    {0x1.16f19cp-1f, 0x1.7ec4c2p-2f, 0x1.4d5620p-4f},
    {0x1.1f942ep-3f, 0x1.821a6ap-1f, 0x1.afb480p-4f},
    {0x1.6bcb84p-4f, 0x1.6e4e06p-3f, 0x1.76f20cp-1f},
};
static const float E3D_AGX_OUT[3][3] = {
    {0x1.2089aap+0f, -0x1.c50b78p-4f, -0x1.0e3c98p-6f},
    {-0x1.217180p-3f, 0x1.286722p+0f, -0x1.0e3c98p-6f},
    {-0x1.217180p-3f, -0x1.c50b78p-4f, 0x1.407ee8p+0f},
};
static const float E3D_AGX_SRGB[3][3] = {
    {1.6605f, -0.5876f, -0.0728f},
    {-0.1246f, 1.1329f, -0.0083f},
    {-0.0182f, -0.1006f, 1.1187f},
};
/* The sigmoid's polynomial about the middle of the curve, where rounding does it less harm, from its constant on. */
static const float E3D_AGX_CURVE[7] = {0x1.2a7d02p-2f, 0x1.bd8adap+0f, 0x1.364746p+1f, -0x1.23126ep+2f, -0x1.487ae2p+3f, 0x1.970a3ep+2f, 0x1.f00000p+3f};
/* w^2.2 is w^2 times this polynomial of the root of w, from its constant on: to 2e-6 up to 1.1. */
static const float E3D_AGX_POWER[7] = {0x1.04c578p-2f, 0x1.ca4ff4p+0f, -0x1.64fe5cp+1f, 0x1.d09d46p+1f, -0x1.7fcc04p+1f, 0x1.6250e6p+0f, -0x1.15e018p-2f};
#define E3D_AGX_SCALE 0x1.f07c22p-5f  /* 1 over the 16.5 stops of the curve */
#define E3D_AGX_OFFSET 0x1.0623c4p-2f /* where a light of 1 is along them, from their middle */

#define E3D_MINUS_LOG2_E -0x1.715476p+0f

/* Bayer 1973: each value of 0 .. 63 once. */
enum { E3D_DITHER = 8 };
static const uint8_t E3D_DITHER_ORDER[E3D_DITHER][E3D_DITHER] = {
    {0, 32, 8, 40, 2, 34, 10, 42},
    {48, 16, 56, 24, 50, 18, 58, 26},
    {12, 44, 4, 36, 14, 46, 6, 38},
    {60, 28, 52, 20, 62, 30, 54, 22},
    {3, 35, 11, 43, 1, 33, 9, 41},
    {51, 19, 59, 27, 49, 17, 57, 25},
    {15, 47, 7, 39, 13, 45, 5, 37},
    {63, 31, 55, 23, 61, 29, 53, 21},
};

#endif
