/* Clusters that are drawn. */
#pragma once

#include <stdint.h>

#include "data/mesh/mesh.h"
#include "frame/geometry/records.h"
#include "frame/pass/draws.h"
#include "frame/pass/prepared.h"
#include "frame/pass/view.h"

/* A cluster of one instance of a draw, and the memory of the thread that draws it. */
typedef struct e3d_cluster_job {
    const e3d_prepared *pass;
    e3d_geometry_memory *state;
    const e3d_draw_state *draw;
    const e3d_view_instance *instance;
    uint32_t number, order; /* the instance's number, and the order of its first primitive */
    const e3d_cluster *cluster;
    const uint8_t *indices;
    int open; /* it may reach into an aperture, where backs are not culled */
} e3d_cluster_job;

/* The sign of the area (screen, Y down) of faces that setup may drop for every material of the cluster, or 0. */
int e3d_drop_sign(const e3d_cluster_job *j);
/* Transforms a cluster to the thread's vertices. `inside`: all of them are known to be inside the view. */
void e3d_transform_cluster(const e3d_cluster_job *j, int inside);
/* Draws the triangles of a cluster that is transformed. */
void e3d_draw_cluster(const e3d_cluster_job *j);
