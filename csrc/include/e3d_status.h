/* The result of a call: done, or why not. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

typedef enum e3d_status {
    E3D_OK = 0,
    E3D_OUT_OF_MEMORY,
    E3D_INVALID_ARGUMENT,
    E3D_UNSUPPORTED_BACKEND,
    E3D_TOO_MANY_PRIMITIVES, /* a frame holds fewer than 2^31 */
    E3D_CANCELLED            /* the poll function asked to stop; the targets are partly written */
} e3d_status;

const char *e3d_status_text(e3d_status status);

#ifdef __cplusplus
}
#endif
