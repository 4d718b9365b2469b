/* Triangles through a z-buffer, a pixel at a time and four or eight at a time: frames per second.
 *
 *     cc -O2 -DLANES=4 -o speed lessons/12_speed.c && ./speed
 *
 * The lanes are gcc's and clang's vector types: the compiler takes what the processor has. Both
 * ways do the same operations in the same order, so that the pictures are equal to the bit, unless
 * the flags let the compiler reorder or fuse them.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 640,
       HEIGHT = 360,
       TRIANGLES = 600 };

#ifndef LANES
#define LANES 8
#endif

typedef float floats __attribute__((vector_size(4 * LANES), aligned(4)));
typedef int ints __attribute__((vector_size(4 * LANES), aligned(4)));

typedef struct triangle {
    float e[3], dx[3], dy[3]; /* edge functions at pixel (0, 0), and their growth */
    float z, z_dx, z_dy;
    int left, right, top, bottom, color;
} triangle;

static float zbuffer[HEIGHT][WIDTH];
static int picture[HEIGHT][WIDTH];

static float random_float(float low, float high) { return low + (high - low) * (float)rand() / (float)RAND_MAX; }

static triangle random_triangle(int number)
{
    float x = random_float(0, WIDTH), y = random_float(0, HEIGHT), c[3][3];
    for (int k = 0; k < 3; k++) {
        c[k][0] = x + random_float(-60, 60);
        c[k][1] = y + random_float(-60, 60);
        c[k][2] = random_float(0, 1);
    }
    triangle t = {.left = WIDTH, .top = HEIGHT, .color = number + 1};
    float area = (c[1][0] - c[0][0]) * (c[2][1] - c[0][1]) - (c[1][1] - c[0][1]) * (c[2][0] - c[0][0]);
    float turn = area < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        const float *a = c[k], *b = c[(k + 1) % 3], *opposite = c[(k + 2) % 3];
        t.dx[k] = -turn * (b[1] - a[1]);
        t.dy[k] = turn * (b[0] - a[0]);
        t.e[k] = -(t.dx[k] * a[0] + t.dy[k] * a[1]);
        t.z_dx += t.dx[k] * opposite[2] / (turn * area);
        t.z_dy += t.dy[k] * opposite[2] / (turn * area);
        t.z += t.e[k] * opposite[2] / (turn * area);
        t.left = (int)a[0] < t.left ? (int)a[0] : t.left;
        t.right = (int)a[0] > t.right ? (int)a[0] : t.right;
        t.top = (int)a[1] < t.top ? (int)a[1] : t.top;
        t.bottom = (int)a[1] > t.bottom ? (int)a[1] : t.bottom;
    }
    t.left = t.left < 0 ? 0 : t.left / LANES * LANES;
    t.top = t.top < 0 ? 0 : t.top;
    t.right = t.right >= WIDTH ? WIDTH - 1 : t.right;
    t.bottom = t.bottom >= HEIGHT ? HEIGHT - 1 : t.bottom;
    return t;
}

static void draw_pixels(const triangle *t)
{
    for (int y = t->top; y <= t->bottom; y++)
        for (int x = t->left; x <= t->right; x++) {
            float px = (float)x + 0.5f, py = (float)y + 0.5f;
            float e0 = t->e[0] + px * t->dx[0] + py * t->dy[0];
            float e1 = t->e[1] + px * t->dx[1] + py * t->dy[1];
            float e2 = t->e[2] + px * t->dx[2] + py * t->dy[2];
            float z = t->z + px * t->z_dx + py * t->z_dy;
            if (e0 > 0 && e1 > 0 && e2 > 0 && z < zbuffer[y][x]) {
                zbuffer[y][x] = z;
                picture[y][x] = t->color;
            }
        }
}

static void draw_lanes(const triangle *t)
{
    floats steps;
    for (int k = 0; k < LANES; k++)
        steps[k] = (float)k + 0.5f;
    for (int y = t->top; y <= t->bottom; y++)
        for (int x = t->left; x <= t->right; x += LANES) {
            floats px = (float)x + steps, py = (floats){0} + ((float)y + 0.5f);
            floats e0 = t->e[0] + px * t->dx[0] + py * t->dy[0];
            floats e1 = t->e[1] + px * t->dx[1] + py * t->dy[1];
            floats e2 = t->e[2] + px * t->dx[2] + py * t->dy[2];
            floats z = t->z + px * t->z_dx + py * t->z_dy;
            floats *depth = (floats *)&zbuffer[y][x];
            ints *color = (ints *)&picture[y][x];
            ints drawn = (e0 > 0) & (e1 > 0) & (e2 > 0) & (z < *depth);
            *depth = (floats)(((ints)z & drawn) | ((ints)*depth & ~drawn));
            *color = (t->color & drawn) | (*color & ~drawn);
        }
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double best_frame(void (*draw)(const triangle *), const triangle *triangles)
{
    double best = 1e9;
    for (int round = 0; round < 9; round++) {
        double start = now();
        memset(picture, 0, sizeof picture);
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            (&zbuffer[0][0])[i] = 2;
        for (int i = 0; i < TRIANGLES; i++)
            draw(&triangles[i]);
        double took = now() - start;
        best = took < best ? took : best;
    }
    return best;
}

static unsigned hash(void)
{
    unsigned hash = 2166136261u;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        hash = (hash ^ (unsigned)(&picture[0][0])[i]) * 16777619u;
    return hash;
}

int main(void)
{
    static triangle triangles[TRIANGLES];
    for (int i = 0; i < TRIANGLES; i++)
        triangles[i] = random_triangle(i);
    double one = best_frame(draw_pixels, triangles);
    unsigned first = hash();
    double several = best_frame(draw_lanes, triangles);
    printf("%7.0f %7.0f  %08x %s\n", 1 / one, 1 / several, first, first == hash() ? "same" : "other");
    return 0;
}
