/* The messages of status codes. */
#include "e3d.h"

const char *e3d_status_text(e3d_status status)
{
    switch (status) {
    case E3D_OK: return "ok";
    case E3D_OUT_OF_MEMORY: return "out of memory";
    case E3D_INVALID_ARGUMENT: return "invalid argument";
    case E3D_UNSUPPORTED_BACKEND: return "this build or CPU does not support the backend";
    case E3D_TOO_MANY_PRIMITIVES: return "a frame holds fewer than 2^31 primitives";
    case E3D_CANCELLED: return "cancelled";
    }
    return "unknown status";
}
