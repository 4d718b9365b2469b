/* Rotations of points with 12, 9 and 6 multiplications each: nanoseconds per point.
 *
 *     cc -O2 -o rotations lessons/13_rotations.c -lm && ./rotations
 */
#include <math.h>
#include <stdio.h>
#include <time.h>

enum { POINTS = 4096,
       ROUNDS = 400 };

static float in[POINTS][3], out[POINTS][3], product[POINTS], m[3][3], row_product[3];
static float sines[3], cosines[3];

/* About x, then y, then z: four multiplications each. */
static void rotate_12(void)
{
    for (int i = 0; i < POINTS; i++) {
        float x = in[i][0], y = in[i][1], z = in[i][2], t;
        t = y * cosines[0] - z * sines[0], z = y * sines[0] + z * cosines[0], y = t;
        t = x * cosines[1] + z * sines[1], z = z * cosines[1] - x * sines[1], x = t;
        t = x * cosines[2] - y * sines[2], y = x * sines[2] + y * cosines[2], x = t;
        out[i][0] = x, out[i][1] = y, out[i][2] = z;
    }
}

/* One matrix: three per row. */
static void rotate_9(void)
{
    for (int i = 0; i < POINTS; i++) {
        float x = in[i][0], y = in[i][1], z = in[i][2];
        for (int k = 0; k < 3; k++)
            out[i][k] = m[k][0] * x + m[k][1] * y + m[k][2] * z;
    }
}

/* ax + by = (a + y)(b + x) - ab - xy, where ab belongs to the matrix and xy to the point. */
static void rotate_6(void)
{
    for (int i = 0; i < POINTS; i++) {
        float x = in[i][0], y = in[i][1], z = in[i][2];
        for (int k = 0; k < 3; k++)
            out[i][k] = (m[k][0] + y) * (m[k][1] + x) + m[k][2] * z - (row_product[k] + product[i]);
    }
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void report(const char *name, void (*rotate)(void))
{
    double best = 1e9;
    for (int round = 0; round < ROUNDS; round++) {
        double start = now();
        rotate();
        double took = now() - start;
        best = took < best ? took : best;
    }
    printf("%-20s %6.2f ns per point   %.6f %.6f %.6f\n", name, 1e9 * best / POINTS, out[1][0], out[1][1], out[1][2]);
}

int main(void)
{
    for (int k = 0; k < 3; k++) {
        sines[k] = sinf(0.3f + 0.4f * (float)k);
        cosines[k] = cosf(0.3f + 0.4f * (float)k);
    }
    const float *s = sines, *c = cosines;
    const float matrix[3][3] = {
        {c[2] * c[1], c[2] * s[1] * s[0] - s[2] * c[0], c[2] * s[1] * c[0] + s[2] * s[0]},
        {s[2] * c[1], s[2] * s[1] * s[0] + c[2] * c[0], s[2] * s[1] * c[0] - c[2] * s[0]},
        {-s[1], c[1] * s[0], c[1] * c[0]},
    };
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++)
            m[k][j] = matrix[k][j];
        row_product[k] = m[k][0] * m[k][1];
    }
    for (int i = 0; i < POINTS; i++) {
        for (int k = 0; k < 3; k++)
            in[i][k] = (float)((i * (k + 7) * 37) % 1000) / 500 - 1;
        product[i] = in[i][0] * in[i][1];
    }
    report("12 multiplications", rotate_12);
    report("9 multiplications", rotate_9);
    report("6 multiplications", rotate_6);
    return 0;
}
