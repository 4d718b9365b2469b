/* The filter through which pixels of a lens look at pinhole pictures (R203, R204). */
#pragma once

enum { E3D_LENS_ONE = 256,      /* a face's pixel: the unit of places */
       E3D_LENS_WIDEST = 32,    /* pixels: half the widest filter */
       E3D_LENS_TAPS = 2 * E3D_LENS_WIDEST + 2,
       E3D_LENS_FULL = 65535 }; /* light of the byte 255 */
