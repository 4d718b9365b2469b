/* Light trees (R67): a cell stands for the light of its texels at their centre of light, so that a small sun in a dark cell
 * keeps its place. After the light trees of Walter et al., Lightcuts, 2005. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/pool.h"
#include "light/light_tree.h"

enum { MOST_CELLS = 256 }; /* cells along a face: lobes don't resolve finer ones */
#define FAINT 0x1p-100     /* the light that a black texel counts for, so that a cell has a centre */

/* Sums over a cell's texels. */
typedef struct cell {
    double weight, light[3], moment[3];
} cell;

typedef struct build_job {
    const e3d_cube *cube; /* of the finest level, */
    const cell *finer;    /* or the cells of the next finer one */
    cell *cells;
    int32_t size; /* cells along a face */
    e3d_cell_group *groups;
    double scale; /* of solid angles, the same in all levels */
} build_job;

static void add_texel(const e3d_cube *cube, int face, int32_t column, int32_t row, cell *sum)
{
    double p = e3d_cube_middle(cube->size, column), q = e3d_cube_middle(cube->size, row), d[3];
    const float *texel = e3d_cube_texel(cube, face, column, row);
    double weight = e3d_cube_weight(p, q), length = sqrt((1.0 + p * p) + q * q);
    double shine = weight * ((((double)texel[0] + (double)texel[1]) + (double)texel[2]) + FAINT);
    e3d_cube_direction(face, p, q, d);
    sum->weight += weight;
    for (int k = 0; k < 3; k++) {
        sum->light[k] += weight * (double)texel[k];
        sum->moment[k] += shine * (d[k] / length);
    }
}

static void add_cell(const cell *part, cell *sum)
{
    sum->weight += part->weight;
    for (int k = 0; k < 3; k++) {
        sum->light[k] += part->light[k];
        sum->moment[k] += part->moment[k];
    }
}

/* Sums up a row of cells, each from a square of texels or from four finer cells. */
static void sum_row(void *argument, int number)
{
    const build_job *job = argument;
    int32_t size = job->size, face = number / size, row = number % size;
    int32_t texels = job->cube ? job->cube->size / size : 2;
    for (int32_t column = 0; column < size; column++) {
        cell sum = {0};
        for (int32_t y = row * texels; y < (row + 1) * texels; y++)
            for (int32_t x = column * texels; x < (column + 1) * texels; x++) {
                if (job->cube)
                    add_texel(job->cube, face, x, y, &sum);
                else
                    add_cell(&job->finer[((size_t)face * 2 * (size_t)size + (size_t)y) * 2 * (size_t)size + (size_t)x], &sum);
            }
        job->cells[(size_t)number * (size_t)size + (size_t)column] = sum;
    }
}

static void fill_lane(const cell *from, double scale, int lane, e3d_cell_group *out)
{
    const double *m = from->moment;
    double length = sqrt((m[0] * m[0] + m[1] * m[1]) + m[2] * m[2]);
    out->weight[lane] = (float)(from->weight * scale);
    for (int k = 0; k < 3; k++) {
        out->direction[k][lane] = (float)(m[k] / length);
        out->light[k][lane] = (float)(from->light[k] * scale);
    }
}

static void group_row(void *argument, int number)
{
    const build_job *job = argument;
    size_t size = (size_t)job->size, half = size / 2;
    for (size_t column = 0; column < half; column++) {
        e3d_cell_group *group = &job->groups[(size_t)number * half + column];
        double p = e3d_cube_middle(job->size / 2, (int32_t)column), q = e3d_cube_middle(job->size / 2, number % (job->size / 2));
        e3d_cube_unit(number / (job->size / 2), p, q, group->middle);
        for (int lane = 0; lane < E3D_CELLS; lane++) {
            size_t row = 2 * (size_t)number + (size_t)(lane >> 1);
            const cell *from = &job->cells[row * size + 2 * column + (size_t)(lane & 1)];
            fill_lane(from, job->scale, lane, group);
        }
    }
}

/* Builds the cells of a level, and their groups. */
static int build_level(build_job *job, int threads, e3d_tree_level *out)
{
    size_t cells = E3D_FACES * (size_t)job->size * (size_t)job->size;
    job->cells = malloc(cells * sizeof *job->cells);
    job->groups = malloc(cells / E3D_CELLS * sizeof *job->groups);
    *out = (e3d_tree_level){job->groups, job->size / 2};
    if (!job->cells || !job->groups)
        return 0;
    e3d_pool_share(threads, E3D_FACES * job->size, sum_row, job);
    e3d_pool_share(threads, E3D_FACES * job->size / 2, group_row, job);
    return 1;
}

int e3d_light_tree_create(const e3d_cube *cube, int threads, e3d_light_tree *out)
{
    build_job job = {.cube = cube, .size = cube->size < MOST_CELLS ? cube->size : MOST_CELLS};
    cell *finer = NULL;
    int built = 1;
    job.scale = 1.0 / ((double)cube->size * (double)cube->size);
    memset(out, 0, sizeof *out);
    for (int32_t size = E3D_TREE_ROOT; size <= job.size / 2; size *= 2)
        out->count++;
    for (int level = out->count - 1; level >= 0 && built; level--) {
        job.finer = finer;
        built = build_level(&job, threads, &out->levels[level]);
        free(finer);
        finer = job.cells;
        job.cube = NULL;
        job.size /= 2;
    }
    free(finer);
    return built;
}

void e3d_light_tree_free(e3d_light_tree *tree)
{
    for (int level = 0; level < tree->count; level++)
        free(tree->levels[level].groups);
}
