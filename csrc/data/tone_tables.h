/* Constants of tone mapping (R118, R119) and of fog (R120), and the thresholds of gradients (R122).
 *
 * ACES: Stephen Hill's fit, in the form that three.js uses: sRGB to AP1, brighter by 1/0.6, a rational curve, and back. AgX: Troy
 * Sobotka's, in the form that Filament and three.js use: sRGB to Rec. 2020 and inset, the logarithm, Benjamin Wrensch's polynomial of
 * the sigmoid, outset, and back from Rec. 2020. Products of matrices were found in float64 and rounded once.
 */
#pragma once

#include <stdint.h>

#define E3D_MOST_LIGHT 0x1p16f /* brighter light counts as this bright */

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
/* AgX, rearranged so that it takes few operations: rows of the first matrix are divided by their diagonal, the sigmoid is a polynomial of
 * stops from its middle, divided by its first coefficient, and what was divided by is in the constants that follow. */
static const float E3D_AGX_IN[3][3] = {
    {1.0f, 0x1.5f48f4p-1f, 0x1.31eb32p-3f}, /* the diagonal isn't multiplied by anything */
    {0x1.7d598ap-3f, 1.0f, 0x1.1e3c54p-3f},
    {0x1.f0c60cp-4f, 0x1.f4336ap-3f, 1.0f},
};
static const float E3D_AGX_LEAST[3] = {0x1.52519ap-12f, 0x1.e8d7cep-13f, 0x1.f763dap-13f}; /* where the curve begins, */
static const float E3D_AGX_MOST[3] = {0x1.de7464p+4f, 0x1.59a9f8p+4f, 0x1.63f346p+4f};     /* and ends */
/* log2(m) - (m - 1) of m from 1 to 2, cubic, to 6.4e-4: its constant with what leads from the bits of a number to the middle of the curve. */
static const float E3D_AGX_START[3] = {-0x1.3e6726p+9f, -0x1.3e2b1ep+9f, -0x1.3e3088p+9f};
static const float E3D_AGX_LOG[3] = {0x1.062114p+1f, -0x1.0d47b0p+0f, 0x1.4417e6p-3f};
static const float E3D_AGX_CURVE[6] = {0x1.729840p+18f, 0x1.0c3480p+17f, 0x1.6a3d42p+13f, -0x1.4984e0p+10f, -0x1.689978p+7f, 0x1.b14cf6p+2f};
/* The matrix after the curve adds the same sum to each channel. */
static const float E3D_AGX_OUT[3] = {-0x1.c86160p-4f, -0x1.652b6ep-4f, -0x1.aa18a2p-7f};
/* w^2.2 as w^2 (c0 + c1 root(w) + c2 w), divided by c2: c0 = 0x1.930fbcp-2, c1 = 0x1.b7f576p-1, c2 = -0x1.065e02p-2, found with the cubic above for
 * the least error of 8-bit sRGB codes over colours of all brightness: 0.41. */
static const float E3D_AGX_POWER[2] = {-0x1.80f3ccp+20f, -0x1.a8b668p+11f};
static const float E3D_AGX_SRGB[3][3] = {
    {-0x1.d08cd8p-62f, 0x1.48c7b6p-63f, 0x1.45dedcp-66f},
    {0x1.16deb8p-65f, -0x1.3cf230p-62f, 0x1.2938fcp-69f},
    {0x1.45dedcp-68f, 0x1.c24f64p-66f, -0x1.38f92ep-62f},
};

#define E3D_MINUS_LOG2_E -0x1.715476p+0f

/* Ordered dithering (Bayer 1973): each value of 0 .. 63 once. */
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
