/* Point i of n lies at angle i * pi * (3 - sqrt(5)), at radius sqrt((i + 0.5) / n): a sunflower (Vogel 1979), whose points are as
 * far apart everywhere, and along each direction at different places. */
#include "data/light_points.h"

const float E3D_LIGHT_POINT_X[E3D_LIGHT_POINTS] = {
    128, -163, 25, 206, -378, 358, -120, -228, 496, -516, 249, 184, -554, 650, -396, -92, 562, -757, 552, -37, -525,
    832, -705, 193, 445, -871, 846, -366, -327, 870, -967, 549};
const float E3D_LIGHT_POINT_Y[E3D_LIGHT_POINTS] = {
    0, 150, -285, 269, -67, -228, 446, -440, 181, 213, -531, 586, -321, -143, 564, -707, 474, 31, -549, 799, -629, 112,
    490, -856, 777, -278, -391, 876, -909, 457, 255, -855};
