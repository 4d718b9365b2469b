/* Four ways to draw a line, in C, to be timed and profiled.
 *
 *     cc -O2 -o lines lessons/03_lines.c && ./lines         nanoseconds per pixel
 *     cc -O1 -pg -o lines lessons/03_lines.c && ./lines && gprof -b -p lines gmon.out
 *     perf record ./lines && perf report
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { WIDTH = 1036,
       HEIGHT = 1024,
       LINES = 20000,
       ROUNDS = 20 };

static unsigned char picture[HEIGHT][WIDTH];
static long pixels;

static inline void put(int x, int y)
{
    picture[y][x]++;
    pixels++;
}

/* Profilers tell of functions, so that each must stay one. */
#define WHOLE __attribute__((noinline))

WHOLE static void first_try(int x0, int y0, int x1, int y1)
{
    if (x1 == x0)
        return;
    double slope = (double)(y1 - y0) / (x1 - x0);
    for (int x = x0; x <= x1; x++)
        put(x, (int)floor(y0 + slope * (x - x0) + 0.5));
}

WHOLE static void dda(int x0, int y0, int x1, int y1)
{
    int dx = x1 - x0, dy = y1 - y0;
    int count = abs(dx) > abs(dy) ? abs(dx) : abs(dy);
    double x = x0 + 0.5, y = y0 + 0.5;
    double step_x = count ? (double)dx / count : 0, step_y = count ? (double)dy / count : 0;
    for (int k = 0; k <= count; k++, x += step_x, y += step_y)
        put((int)floor(x), (int)floor(y));
}

WHOLE static void bresenham(int x0, int y0, int x1, int y1)
{
    int run = abs(x1 - x0), rise = abs(y1 - y0);
    int step_x = x0 < x1 ? 1 : -1, step_y = y0 < y1 ? 1 : -1;
    if (run >= rise) {
        int error = run - (step_y > 0);
        for (int k = 0, x = x0, y = y0; k <= run; k++, x += step_x) {
            put(x, y);
            error += 2 * rise;
            if (error >= 2 * run) {
                error -= 2 * run;
                y += step_y;
            }
        }
    } else {
        int error = rise - (step_x > 0);
        for (int k = 0, x = x0, y = y0; k <= rise; k++, y += step_y) {
            put(x, y);
            error += 2 * run;
            if (error >= 2 * rise) {
                error -= 2 * rise;
                x += step_x;
            }
        }
    }
}

/* The Line() of a tutorial of the 1990s: without the first pixel. */
WHOLE static void tutorial_line(int x0, int y0, int x1, int y1)
{
    int run = abs(x1 - x0), rise = abs(y1 - y0);
    int step_x = x0 < x1 ? 1 : -1, step_y = y0 < y1 ? 1 : -1;
    if (run > rise) {
        int error = run / 2;
        for (int k = 0, x = x0, y = y0; k < run; k++) {
            x += step_x;
            error += rise;
            if (error > run) {
                error -= run;
                y += step_y;
            }
            put(x, y);
        }
    } else {
        int error = rise / 2;
        for (int k = 0, x = x0, y = y0; k < rise; k++) {
            y += step_y;
            error += run;
            if (error > rise) {
                error -= rise;
                x += step_x;
            }
            put(x, y);
        }
    }
}

static int random_below(int n) { return (int)((double)rand() / ((double)RAND_MAX + 1) * n); }

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

int main(void)
{
    static int ends[LINES][4];
    static const struct {
        const char *name;
        void (*draw)(int, int, int, int);
    } ways[] = {{"first_try", first_try}, {"dda", dda}, {"bresenham", bresenham}, {"tutorial_line", tutorial_line}};
    for (int i = 0; i < LINES; i++)
        for (int k = 0; k < 4; k++)
            ends[i][k] = random_below(k % 2 ? HEIGHT / 4 : WIDTH / 4);
    for (int w = 0; w < 4; w++) {
        pixels = 0;
        double start = now();
        for (int round = 0; round < ROUNDS; round++)
            for (int i = 0; i < LINES; i++)
                ways[w].draw(ends[i][0], ends[i][1], ends[i][2], ends[i][3]);
        double took = now() - start;
        printf("%-14s %9ld pixels  %5.2f ns per pixel\n", ways[w].name, pixels, 1e9 * took / (double)pixels);
    }
    return 0;
}
