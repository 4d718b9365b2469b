/* Thin films: the eye's sensitivity to each wavelength, as a sum of waves (R139).
 * Source: Belcour and Barla 2017, section 4, whose sensitivities are sums of Gaussians over the wave number: the numbers here
 * are theirs, for a path in nanometres. The fourth wave adds to the first. tests/kernels/test_rare_materials.py computes them
 * again. */
#pragma once

enum { E3D_FILM_WAVES = 4,
       E3D_FILM_COSINE = 7 };

/* For x, y, z, and x again: amplitude, turns a nanometre, and the base-2 logarithm of what is left after a nanometre squared. */
static const float E3D_FILM_AMPLITUDE[E3D_FILM_WAVES] = {0x1.b1743ep-1f, 0x1.000e8ap+0f, 0x1.00499p+0f, 0x1.3b1f4ep-3f};
static const float E3D_FILM_TURNS[E3D_FILM_WAVES] = {0x1.b8aap-10f, 0x1.d6a08cp-10f, 0x1.21759cp-9f, 0x1.259692p-9f};
static const float E3D_FILM_FADE[E3D_FILM_WAVES] = {-0x1.08aafep-22f, -0x1.1c8348p-21f, -0x1.945d7p-22f, -0x1.14ec68p-22f};
/* From XYZ to linear RGB of sRGB's primaries. */
static const float E3D_FILM_RGB[3][3] = {{0x1.9ec734p+1f, -0x1.8981e8p+0f, -0x1.fe7f04p-2f},
                                         {-0x1.f043a2p-1f, 0x1.e0423ep+0f, 0x1.546d4p-5f},
                                         {0x1.c7d4aap-5f, -0x1.a1d854p-3f, 0x1.0ea65p+0f}};
/* The cosine of the square root of s, in half-turns, for s in 0 .. 1/4: coefficients of powers of s, from the lowest. */
static const float E3D_FILM_COSINES[E3D_FILM_COSINE] = {0x1p+0f, -0x1.3bd3c8p+4f, 0x1.03c1a8p+6f, -0x1.55ccf2p+6f,
                                                        0x1.e1574ep+5f, -0x1.9f7b4ap+4f, 0x1.a1d58ap+2f};
