/* What one run of a scene gives: an array for each output that it is asked for. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "e3d.h"

typedef struct picture {
    void *arrays[E3D_OUTPUTS]; /* NULL where not asked for */
    size_t pixels;
    e3d_status status;
} picture;

/* Bit k of `mask` asks for output k; all bytes are `poison`. */
picture picture_create(size_t pixels, uint32_t mask, int poison);
void picture_destroy(picture *p);
e3d_targets picture_targets(const picture *p);
uint64_t picture_hash(const picture *p);
/* Both tell standard error what is wrong, in lines that begin with `title` and `run`; title NULL: nothing. */
int picture_has_no_nan(const picture *p, const char *title, const char *run);
/* Of the outputs that both have. */
int picture_is_same(const picture *a, const picture *b, const char *title, const char *run);
