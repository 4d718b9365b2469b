/* How levels of pictures are halved: four neighbours along an axis make one (R124, R162). */
#pragma once

static inline float ref_halve(float a, float b, float c, float d) { return ((a + d) + (b + c) * 3.0f) * 0.125f; }
