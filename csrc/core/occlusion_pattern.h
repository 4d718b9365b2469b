/* Where ambient occlusion looks (R126): which of sixteen directions a pixel has, how far away it looks, and the numbers of R127. */
#ifndef E3D_OCCLUSION_PATTERN_H
#define E3D_OCCLUSION_PATTERN_H

enum {
    E3D_OCCLUSION_CELL = 4,  /* pixels a side that have all directions between them */
    E3D_OCCLUSION_TAPS = 4,  /* places a pixel looks at */
    E3D_OCCLUSION_REACH = 128, /* pixels, at most, to the last */
    E3D_OCCLUSION_FILTER = 2, /* pixels to either side that the filter takes in */
    E3D_OCCLUSION_SPAN = 2 * E3D_OCCLUSION_FILTER + 1
};

#define E3D_OCCLUSION_SLACK 0x1p-10f /* the squared sine of the least angle above a surface that counts */
#define E3D_OCCLUSION_FALL 0x1.555556p+0f /* 4/3: what is nearer than half the radius counts in full */
#define E3D_OCCLUSION_NO_CHANGE 0x1p126f  /* of nearness, where nothing shows beside a pixel */
#define E3D_OCCLUSION_STEP 8.0f      /* pixels: what is further in front of or behind a surface is another for the filter */

/* Unit vectors by their number, and the number of each pixel of a cell: [row][column]. Neighbours look in opposite directions. */
extern const float E3D_OCCLUSION_DIRECTIONS[16][2];
extern const unsigned char E3D_OCCLUSION_NUMBERS[E3D_OCCLUSION_CELL][E3D_OCCLUSION_CELL];
/* By how much of a sixteenth of a step each pixel's places are further away. */
extern const unsigned char E3D_OCCLUSION_SHIFTS[E3D_OCCLUSION_CELL][E3D_OCCLUSION_CELL];

/* R127: g(s) = s^3 ((A0 + A1 s) + root(1 - s) (B0 + B1 s)). */
#define E3D_ARC_A0 0x1.43ecb2p+2f
#define E3D_ARC_A1 -0x1.bec98ap+1f
#define E3D_ARC_B0 -0x1.28819ap+2f
#define E3D_ARC_B1 0x1.e6a470p+0f

#endif
