/* Every bound and tuning constant of the core, each with the budget that it keeps.
 *
 * Coverage (docs/exactness, R12): in a tile of T samples an edge that crosses it has
 * |E / 256| <= (T - 1)(|a| + |b|). |a| and |b| are at most 256 * (clip region), so 32-bit lanes are
 * exact while (T - 1) * 256 * (width + height of the region) < 2^31: T = 64 allows a sum of 133,152 samples.
 * The guard band is 65,536 wide and high; a point adds 1024 to both, and a line 1449 to one of them.
 */
#pragma once

enum {
    E3D_TILE_SHIFT = 6,
    E3D_TILE = 1 << E3D_TILE_SHIFT, /* samples a side: a tile's depths and IDs take 32 KB, about a first-level data cache */
    E3D_TILE_SAMPLES = E3D_TILE * E3D_TILE,
    E3D_BLOCK = 8,               /* samples a side of a block of the hierarchical depth */
    E3D_SUBPIXEL = 256,          /* positions are snapped to 1/256 sample */
    E3D_GUARD = 32768,           /* samples from the viewport's centre to the guard band */
    E3D_MAX_POINT_SAMPLES = 1024, /* point size, or line width across: 256 pixels of 4 samples */
    /* 1/256 sample: an octagon no larger than this may miss every sample, and is drawn as a square */
    E3D_LEAST_DISC = 197,
    /* The most samples of a column or row that a line covers: at 45 degrees its width times the root of 2 */
    E3D_MAX_LINE_SAMPLES = 1449,
    E3D_CLUSTER_TRIANGLES = 64,  /* a cluster's triangles and vertices: 8-bit local indices */
    E3D_CLUSTER_VERTICES = 128,
    E3D_GROUP_CLUSTERS = 8,      /* clusters that are culled together first */
    E3D_FEW_LIGHTS = 4,          /* with more lights, those that don't reach a batch are left out */
    /* Elements beyond the end of arrays that are read or written by vectors; their values mean nothing */
    E3D_PAD = 16,
    E3D_MAX_THREADS = 256
};

_Static_assert(E3D_MAX_LINE_SAMPLES < 2 * E3D_MAX_POINT_SAMPLES &&
                   (long long)(E3D_TILE - 1) * E3D_SUBPIXEL * 2 * (2 * E3D_GUARD + E3D_MAX_POINT_SAMPLES) < (1LL << 31),
               "edge functions of a tile fit 32-bit lanes");

#define E3D_W_MIN 0x1p-20f      /* a vertex with a smaller w is too near to the eye: it is clipped away */
/* z_ndc by which wireframe edges move towards the viewer: a multiple of what rounding may put between an edge and its own
 * face (R36 handles the face's slope). More would let hidden edges show through. */
#define E3D_WIRE_PULL 0x1p-18f
#define E3D_UNORM16 0x1.0001p-16f /* 1 / 65535 */
#define E3D_UNORM8 0x1.010102p-8f /* 1 / 255 */
#define E3D_UNORM15 0x1.0002p-15f /* 1 / 32767 */
#define E3D_UNORM15_BLENDED 0x1.0002p-23f /* 1 / (32767 * 256): a weight of 256 */
#define E3D_UNORM8_BLENDED 0x1.03060ap-24f /* 1 / 255^3: two weights of 255 each */

/* R111: limits on the changes of texture coordinates, so that the squares of their products are finite. A footprint without a
 * direction then has none, instead of a quotient of zeros. */
#define E3D_MOST_TEXELS 0x1p30f
#define E3D_LEAST_AXIS 0x1p-60f

#define E3D_LEAST_WEIGHT 0x1p-64f /* the least weight of the first corner, so that the weights of R19 are never all 0 */
/* R81: a blended sample with a smaller alpha shows nothing, so that sums of alphas have a finite inverse */
#define E3D_LEAST_ALPHA 0x1p-24f
#define E3D_LEAST_LENGTH2 0x1p-126f /* R22: the least squared length whose root has a finite inverse */

/* The least roughness of physically based materials: smaller highlights would flicker, and a grazing angle must not divide by
 * 0. */
#define E3D_LEAST_ROUGHNESS 0.045f
#define E3D_LEAST_SHEEN_ROUGHNESS 0.07f
/* R191: normals that turn farther from sample to sample don't widen a lobe more. */
#define E3D_MOST_CURVATURE 0.18f
#define E3D_LEAST_COSINE 0x1p-20f
/* R100: how far rounding may move a sample, or a corner beside it, off the plane of its face, as a share of their
 * coordinates: 7 roundings of the sample, 8 of the corner (R3, R20). */
#define E3D_PLANE_SLACK 0x1p-20f
#define E3D_BLENDED_CASTER 0.5f /* R101: blended materials of at least this alpha hide lights */
/* Shadow maps: how far samples move towards the light, so that none lies in its own shadow. */
#define E3D_SHADOW_CORNER 0x1.6a09e6p+0f /* the root of 2, since the comparisons at the corners are farthest from the sample */
#define E3D_SHADOW_SLACK 0.25f           /* for normals that are not those of the face */
#define E3D_SOFT_WIDEST 64.0f            /* texels: the greatest radius of a soft shadow's lookup (R226) */
#define E3D_OVER_PI 0x1.45f306p-2f  /* 1 / pi */
#define E3D_OVER_2PI 0x1.45f306p-3f /* 1 / (2 pi) */
#define E3D_PI 0x1.921fb6p+1f       /* pi */
#define E3D_OVER_21 0x1.861862p-5f  /* 1 / 21 */
#define E3D_THIRD 0x1.555556p-2f    /* 1 / 3 */
/* Area lights: the least squared length along a surface that tells a direction (R233), of a vector that is divided by its length,
 * and of an angle's sine (R235) */
#define E3D_AREA_LEAST_SINE2 0x1p-40f
#define E3D_AREA_LEAST 0x1p-100f
#define E3D_AREA_LEAST_TURN 0x1p-23f
/* R140: a surface that reflects all light would have an infinite index of refraction */
#define E3D_MOST_IRIDESCENCE_F0 0.9999f
#define E3D_LEAST_IRIDESCENCE_PRODUCT 1e-5f
