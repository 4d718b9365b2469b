/* Light to codes of pictures, and codes of textures to light, as in pyrender's shader. They aren't each other's inverse.
 * E3D_PYR_POWER_THRESHOLDS[k]  ((k + 1/2)/255)^2.2: the least light of code k + 1 (R147).
 * E3D_PYR_SRGB_LIGHT[c]  the light of the 8-bit sRGB code c (R148).
 * All are exact decimals, rounded to f32 once. */
#pragma once

extern const float E3D_PYR_POWER_THRESHOLDS[255], E3D_PYR_SRGB_LIGHT[256];
