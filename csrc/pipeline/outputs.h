/* The outputs beside colour (the G-buffer). */
#ifndef E3D_OUTPUTS_H
#define E3D_OUTPUTS_H

#include <stddef.h>

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;
typedef struct e3d_tile e3d_tile;

/* What is asked for beside colour. */
typedef enum e3d_output_kind {
    E3D_OUTPUT_NDC_DEPTH = 0,
    E3D_OUTPUT_DEPTH,
    E3D_OUTPUT_TRIANGLE_ID,
    E3D_OUTPUT_OBJECT_ID,
    E3D_OUTPUT_INSTANCE_ID,
    E3D_OUTPUT_MATERIAL_ID,
    E3D_OUTPUT_ALBEDO,
    E3D_OUTPUT_NORMAL,
    E3D_OUTPUT_POSITION,
    E3D_OUTPUT_WORLD_NORMAL,
    E3D_OUTPUT_WORLD_POSITION,
    E3D_OUTPUT_UV,
    E3D_OUTPUT_BARYCENTRIC,
    E3D_OUTPUTS
} e3d_output_kind;

typedef struct e3d_output {
    void *target; /* or NULL */
    size_t first; /* word in e3d_worker.outputs */
} e3d_output;

int e3d_outputs_prepare(e3d_context *context); /* 0 when memory is out */
void e3d_outputs_begin(const e3d_context *context, e3d_worker *worker);
void e3d_outputs_again(const e3d_context *context, e3d_worker *worker, const e3d_tile *tile);
void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker);
void e3d_outputs_end(const e3d_context *context, const e3d_worker *worker, const e3d_tile *tile);
/* The whole tile is background. */
void e3d_outputs_blank(const e3d_context *context, const e3d_tile *tile);

#endif
