/* The outputs beside colour, of a batch. */
#ifndef E3D_VALUES_H
#define E3D_VALUES_H

typedef struct e3d_context e3d_context;
typedef struct e3d_worker e3d_worker;

void e3d_outputs_batch(const e3d_context *context, e3d_worker *worker);

#endif
