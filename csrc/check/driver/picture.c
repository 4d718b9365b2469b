/* What one run of a scene gives: an array for each output that it is asked for. */
#include "check/driver/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "check/driver/hash.h"

static size_t output_size(const picture *p, int k)
{
    return p->pixels * (size_t)(E3D_OUTPUT_FORMATS[k].channels * E3D_OUTPUT_FORMATS[k].bytes);
}

picture picture_create(size_t pixels, uint32_t mask, int poison)
{
    picture p = {.pixels = pixels};
    for (int k = 0; k < E3D_OUTPUTS; k++) {
        if (!(mask >> k & 1))
            continue;
        p.arrays[k] = malloc(output_size(&p, k));
        if (p.arrays[k] == NULL)
            abort();
        memset(p.arrays[k], poison, output_size(&p, k));
    }
    return p;
}

void picture_destroy(picture *p)
{
    for (int k = 0; k < E3D_OUTPUTS; k++)
        free(p->arrays[k]);
}

e3d_targets picture_targets(const picture *p)
{
    e3d_targets targets;
    for (int k = 0; k < E3D_OUTPUTS; k++)
        e3d_targets_set(&targets, k, p->arrays[k]);
    return targets;
}

uint64_t picture_hash(const picture *p)
{
    uint64_t hash = HASH_START ^ (uint64_t)p->status;
    for (int k = 0; k < E3D_OUTPUTS && p->status == E3D_OK; k++)
        if (p->arrays[k] != NULL)
            hash = hash_bytes(hash, p->arrays[k], output_size(p, k));
    return hash;
}

static int complain(const char *title, const char *run, const char *name, const char *what, size_t i)
{
    if (title != NULL)
        fprintf(stderr, "%s: %s: %s %s at value %zu\n", title, run, name, what, i);
    return 0;
}

int picture_has_no_nan(const picture *p, const char *title, const char *run)
{
    int fine = 1;
    for (int k = 0; k < E3D_OUTPUTS && p->status == E3D_OK; k++) {
        const float *values = p->arrays[k];
        size_t count = p->pixels * (size_t)E3D_OUTPUT_FORMATS[k].channels;
        for (size_t i = 0; E3D_OUTPUT_FORMATS[k].is_float && values != NULL && i < count; i++)
            if (isnan(values[i])) {
                fine = complain(title, run, E3D_OUTPUT_FORMATS[k].name, "is NaN", i);
                break;
            }
    }
    return fine;
}

int picture_is_same(const picture *a, const picture *b, const char *title, const char *run)
{
    if (a->status != b->status)
        return complain(title, run, "the status", e3d_status_text(b->status), 0);
    int same = 1;
    for (int k = 0; k < E3D_OUTPUTS && a->status == E3D_OK; k++) {
        const uint8_t *left = a->arrays[k], *right = b->arrays[k];
        if (left == NULL || right == NULL || memcmp(left, right, output_size(a, k)) == 0)
            continue;
        size_t i = 0;
        while (left[i] == right[i])
            i++;
        same = complain(title, run, E3D_OUTPUT_FORMATS[k].name, "differs", i / (size_t)E3D_OUTPUT_FORMATS[k].bytes);
    }
    return same;
}
