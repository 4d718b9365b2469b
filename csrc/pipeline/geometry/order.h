/* The records of a frame, sorted where the last one wins. */
#ifndef E3D_ORDER_H
#define E3D_ORDER_H

typedef struct e3d_context e3d_context;

/* Sorts the records and bins them; 0 when memory is out. */
int e3d_sort_records(e3d_context *context);

#endif
