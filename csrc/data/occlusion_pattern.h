/* Where ambient occlusion looks from each site (R126), and the constants of R127, R128 and R180. */
#pragma once

#include <stdint.h>

enum {
    E3D_OCCLUSION_STEP = 2,   /* pixels from site to site */
    E3D_OCCLUSION_CELL = 8,   /* sites a side that together look in all directions */
    E3D_OCCLUSION_NUMBERS = E3D_OCCLUSION_CELL * E3D_OCCLUSION_CELL,
    E3D_OCCLUSION_TAPS = 5,   /* places to either side */
    E3D_OCCLUSION_REACH = 192, /* the greatest distance in sites */
    E3D_OCCLUSION_FILTER = 4, /* how many sites to either side the filter reads */
    E3D_OCCLUSION_SPAN = 2 * E3D_OCCLUSION_FILTER + 1,
    E3D_OCCLUSION_QUADRANT = 10, /* sectors of a right angle */
    E3D_OCCLUSION_SECTORS = 2 * E3D_OCCLUSION_QUADRANT
};

#define E3D_OCCLUSION_START 0.75f        /* sites to the nearest place, at least */
#define E3D_OCCLUSION_SLACK 0x1p-10f     /* the squared sine of the least angle above a surface that counts */
#define E3D_OCCLUSION_GAP 0.25f          /* what of the rise between two places is added to the higher one */
#define E3D_OCCLUSION_ROUNDING 0.25f     /* of a sector: a surface does not hide itself */
#define E3D_OCCLUSION_NO_CHANGE 0x1p126f /* the change of nearness where nothing shows beside a site */
#define E3D_OCCLUSION_LEAST_FACING 0x1p-20f /* of a normal and the line of sight */
#define E3D_OCCLUSION_LEAST 0x1p-126f
#define E3D_OCCLUSION_LOOSE 0x1p-3f /* R128: the weight of sites off the surface, which counts where few lie on it */
#define E3D_OCCLUSION_FALL 0x1p-7f  /* and how fast it falls with their distance, in sites */
#define E3D_OCCLUSION_WIDEN 0x1p-6f /* R216: from 32 sites of reach on, cells are averaged, in full from 96 on */
#define E3D_OCCLUSION_REST 0x1p-10f /* R180: the weight of sites off the surface, if there are no others */
#define E3D_OCCLUSION_MOST 2.0f     /* no share is greater than pi/2: this keeps overflowed sums finite */
#define E3D_OCCLUSION_UNIT 0x1p-13f /* of the light of sectors, halved */

/* The cosines of the directions of sites, half a circle, by number. */
extern const float E3D_OCCLUSION_COSINES[E3D_OCCLUSION_NUMBERS];

/* The light of each sector, in 1/4096: what changes with the cosine between the normal and the line of sight, and what with
 * that between the normal and the direction. */
extern const int16_t E3D_OCCLUSION_LIGHT[2][E3D_OCCLUSION_SECTORS];

/* The number of a site, 0 to 63: neighbours in rows, columns and squares have numbers as far apart as possible. */
static inline int e3d_occlusion_number(int column, int row)
{
    int number = 0;
    for (int k = 0; k < 3; k++)
        number |= ((column ^ row) >> k & 1) << (5 - 2 * k) | (row >> k & 1) << (4 - 2 * k);
    return number;
}

/* Its bits in reverse. To one side (0) and the other (1), the places of a site are so many sixty-fourths of a step farther away,
 * and half of one. */
static inline int e3d_occlusion_shift(int number, int side)
{
    int shift = 0;
    for (int k = 0; k < 6; k++)
        shift |= (number >> k & 1) << (5 - k);
    return shift ^ side << 5;
}

/* What of the square of the radius a site's own lacks, in 256ths. */
static inline int e3d_occlusion_lack(int number) { return 2 * ((5 * e3d_occlusion_shift(number, 0) + 7 * number + 3) & 63) + 1; }

/* The direction of a number, of unit length. */
static inline void e3d_occlusion_direction(int number, float out[2])
{
    int half = E3D_OCCLUSION_NUMBERS / 2;
    out[0] = E3D_OCCLUSION_COSINES[number];
    out[1] = E3D_OCCLUSION_COSINES[number < half ? half - 1 - number : number - half];
}
