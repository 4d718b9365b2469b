/* The places at which ambient occlusion looks (R126): the direction of a pixel, its distances, and the constants of R127 and
 * R128. */
#pragma once

enum {
    E3D_OCCLUSION_CELL = 8,    /* pixels a side that together have all directions */
    E3D_OCCLUSION_TAPS = 4,    /* places a pixel looks at */
    E3D_OCCLUSION_REACH = 128, /* the greatest distance in pixels */
    E3D_OCCLUSION_FILTER = 4,  /* how many pixels to either side the filter reads */
    E3D_OCCLUSION_SPAN = 2 * E3D_OCCLUSION_FILTER + 1
};

#define E3D_OCCLUSION_SLACK 0x1p-10f /* the squared sine of the least angle above a surface that counts */
#define E3D_OCCLUSION_MOST 2.0f     /* no share is greater than pi/2: this keeps overflowed sums finite */
#define E3D_OCCLUSION_FALL 2.0f /* surfaces nearer than 0.7 of the radius count in full */
#define E3D_OCCLUSION_NO_CHANGE 0x1p126f  /* the change of nearness where nothing shows beside a pixel */
#define E3D_OCCLUSION_STEP 4.0f      /* pixels: the filter ignores pixels that lie farther before or behind the surface */

/* R127: g(s) = s^3 ((A0 + A1 s) + root(1 - s) (B0 + B1 s)). */
#define E3D_ARC_A0 0x1.43ecb2p+2f
#define E3D_ARC_A1 -0x1.bec98ap+1f
#define E3D_ARC_B0 -0x1.28819ap+2f
#define E3D_ARC_B1 0x1.e6a470p+0f

/* The cosines of the sixteen directions of a quadrant; in reverse they are the sines. */
extern const float E3D_OCCLUSION_COSINES[16];

/* The number of a pixel, 0 to 63: neighbours in rows, columns and squares have numbers as far apart as possible. */
static inline int e3d_occlusion_number(int x, int y)
{
    int number = 0;
    for (int k = 0; k < 3; k++)
        number |= ((x ^ y) >> k & 1) << (5 - 2 * k) | (y >> k & 1) << (4 - 2 * k);
    return number;
}

/* Its bits in reverse: a pixel's places are so many sixty-fourths of a step farther away. */
static inline int e3d_occlusion_shift(int number)
{
    int shift = 0;
    for (int k = 0; k < 6; k++)
        shift |= (number >> k & 1) << (5 - k);
    return shift;
}

/* The direction of a number, of unit length. */
static inline void e3d_occlusion_direction(int number, float out[2])
{
    float cosine = E3D_OCCLUSION_COSINES[number & 15], sine = E3D_OCCLUSION_COSINES[15 - (number & 15)];
    int quadrant = number >> 4;
    out[0] = quadrant == 0 ? cosine : quadrant == 1 ? 0.0f - sine
                                  : quadrant == 2   ? 0.0f - cosine
                                                    : sine;
    out[1] = quadrant == 0 ? sine : quadrant == 1 ? cosine
                                : quadrant == 2   ? 0.0f - sine
                                                  : 0.0f - cosine;
}
