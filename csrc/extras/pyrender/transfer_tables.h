/* Light to codes and back, as in pyrender's shader (R147).
 * POWER_THRESHOLDS[k]  ((k + 1/2)/255)^2.2: the least light of code k + 1. Exact decimal arithmetic, rounded once.
 * SRGB_LIGHT[c]  light of the 8-bit sRGB code c, likewise. */
#pragma once

extern const float E3D_PYR_POWER_THRESHOLDS[255], E3D_PYR_SRGB_LIGHT[256];
