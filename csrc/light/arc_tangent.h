/* The arc tangent with the same bits everywhere: the method and the operations of engine/base/linalg/trigonometry.py. */
#pragma once

/* For t in [0, 1], within 2 ulps. */
static inline double e3d_arc_tangent(double t)
{
    static const double OF_EIGHTHS[9] = {0.0,
                                         0.12435499454676144,
                                         0.24497866312686414,
                                         0.35877067027057225,
                                         0.4636476090008061,
                                         0.5585993153435624,
                                         0.6435011087932844,
                                         0.7188299996216245,
                                         0.7853981633974483};
    static const double TERMS[7] = {-1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13, -1.0 / 15};
    int nearest = (int)(8.0 * t + 0.5);
    double eighths = (double)nearest / 8.0;
    double step = (t - eighths) / (1.0 + t * eighths);
    double square = step * step, series = TERMS[6];
    for (int k = 5; k >= 0; k--)
        series = series * square + TERMS[k];
    return OF_EIGHTHS[nearest] + (step + step * square * series);
}
