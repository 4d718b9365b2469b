# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to pictures in MuJoCo's manner: csrc/include/e3d_mujoco.h.

In:  the shapes, planes and textures of a model, which are checked once; geoms, lights and a camera.
Out: colours, or numbers of geoms and depths, in the caller's arrays.
Always: a model holds the arrays that it points to; the GIL is released while a picture is drawn.
"""

from libc.stdint cimport int32_t, uint8_t
from libc.stdlib cimport calloc, free
from libc.string cimport memset

from e3d cimport E3D_OK, E3D_OUT_OF_MEMORY, e3d_backend, e3d_status
from e3d_mujoco cimport *

import numpy as np

from ..errors import InvalidArgumentError, OutOfMemoryError

BUILTINS = E3D_MUJ_BUILTINS
LEVELS, SAMPLES, LIGHTS = E3D_MUJ_LEVELS, E3D_MUJ_SAMPLES, E3D_MUJ_LIGHTS

#: e3d_muj_geom
GEOM = np.dtype([
    *((name, np.int32) for name in ("type", "dataid", "objid", "category", "matid", "texid", "texuniform", "texcoord",
                                    "segid", "castshadow")),
    ("size", np.float32, 3), ("pos", np.float32, 3), ("mat", np.float32, 9), ("rgba", np.float32, 4),
    *((name, np.float32) for name in ("emission", "specular", "shininess", "reflectance")),
    ("texrepeat", np.float32, 2), ("rbound", np.float32),
])
#: e3d_muj_light
LIGHT = np.dtype([
    ("is_directional", np.int32), ("castshadow", np.int32),
    *((name, np.float32, 3) for name in ("pos", "dir", "attenuation", "ambient", "diffuse", "specular")),
    ("exponent", np.float32), ("cutoff_cosine", np.float32), ("shadow_reach", np.float64),
], align=True)


cdef int require(bint condition, str message) except -1:
    if not condition:
        raise InvalidArgumentError(message)
    return 0


require(GEOM.itemsize == sizeof(e3d_muj_geom) and LIGHT.itemsize == sizeof(e3d_muj_light), "the records differ from the core's")


def halve(const uint8_t[:, :, :, ::1] texels not None, const double[::1] meaning not None, const double[::1] limits not None,
          uint8_t[:, :, :, ::1] out not None):
    """Write the next level of a texture, (faces, H, W, 4), to `out`, (faces, max(1, H // 2), max(1, W // 2), 4).

    `meaning`, (256,): what the codes of the first three channels mean; `limits`, (255,): the values halfway between.
    """
    cdef int32_t faces = <int32_t>texels.shape[0], height = <int32_t>texels.shape[1], width = <int32_t>texels.shape[2]
    require(meaning.shape[0] == 256 and limits.shape[0] == 255, "a meaning for each code")
    require(faces > 0 and height > 0 and width > 0 and texels.shape[3] == 4 and out.shape[3] == 4, "texels have four channels")
    require(out.shape[0] == faces and out.shape[1] == max(height // 2, 1) and out.shape[2] == max(width // 2, 1), "a level has the wrong size")
    with nogil:
        e3d_muj_halve(&texels[0, 0, 0, 0], faces, height, width, &meaning[0], &limits[0], &out[0, 0, 0, 0])


cdef class NativeModel:
    """The shapes, planes and textures of a model, and what else stays from picture to picture."""

    cdef e3d_muj_frame frame
    cdef e3d_muj_shape *shapes
    cdef e3d_muj_plane *planes
    cdef e3d_muj_texture *textures
    cdef dict held

    def __cinit__(self, int shapes, int planes, int textures):
        self.held = {}
        self.shapes = <e3d_muj_shape *>calloc(shapes + 1, sizeof(e3d_muj_shape))
        self.planes = <e3d_muj_plane *>calloc(planes + 1, sizeof(e3d_muj_plane))
        self.textures = <e3d_muj_texture *>calloc(textures + 1, sizeof(e3d_muj_texture))
        if self.shapes == NULL or self.planes == NULL or self.textures == NULL:
            raise OutOfMemoryError("no memory for the model")
        memset(&self.frame, 0, sizeof(e3d_muj_frame))
        self.frame.shapes, self.frame.shape_count = self.shapes, shapes
        self.frame.planes, self.frame.plane_count = self.planes, planes
        self.frame.textures, self.frame.texture_count = self.textures, textures
        self.frame.sky = -1

    def __dealloc__(self):
        free(self.shapes)
        free(self.planes)
        free(self.textures)

    def set_numbers(self, int first_mesh, int first_hfield, int first_skin, int first_flex, int sky, bint builtin_uvs):
        """Say where kinds of shapes begin, and which texture is the sky's, or -1."""
        self.frame.first_mesh, self.frame.first_hfield = first_mesh, first_hfield
        self.frame.first_skin, self.frame.first_flex = first_skin, first_flex
        self.frame.sky, self.frame.builtin_uvs = sky, builtin_uvs

    def set_quality(self, int shadow_size, float line_width, float fog_start, float fog_end,
                    const float[::1] fog not None, const float[::1] haze not None):
        self.frame.shadow_size, self.frame.line_width = min(max(shadow_size, 0), 16000), line_width
        self.frame.fog_start, self.frame.fog_end = fog_start, fog_end
        for k in range(3):
            self.frame.fog[k], self.frame.haze[k] = fog[k], haze[k]

    def set_shape(self, int number, const float[:, ::1] positions not None, const int32_t[:, ::1] corners not None,
                  const float[:, :, ::1] normals not None, const float[:, :, ::1] uvs, const uint8_t[::1] edges not None):
        """Set a shape's triangles: positions (V, 3), corners (T, 3), normals (T, 3, 3), uvs (T, 3, 2) or None, edges (T,)."""
        cdef e3d_muj_shape *shape
        cdef int32_t vertices = <int32_t>positions.shape[0], triangles = <int32_t>corners.shape[0]
        cdef bint in_range = True
        cdef int32_t i
        cdef int k
        require(0 <= number < self.frame.shape_count, "no such shape")
        require(positions.shape[1] == 3 and corners.shape[1] == 3, "positions and corners are in threes")
        require(normals.shape[0] == triangles and normals.shape[1] == 3 and normals.shape[2] == 3, "a normal for each corner")
        require(edges.shape[0] == triangles, "edges for each triangle")
        require(uvs is None or (uvs.shape[0] == triangles and uvs.shape[1] == 3 and uvs.shape[2] == 2), "a uv for each corner")
        for i in range(triangles):
            for k in range(3):
                in_range &= 0 <= corners[i, k] < vertices
        require(in_range, "a corner is out of range")
        shape = &self.shapes[number]
        shape.vertices, shape.triangles = vertices, triangles if vertices else 0
        if triangles == 0 or vertices == 0:
            return
        shape.positions, shape.corners = &positions[0, 0], &corners[0, 0]
        shape.normals, shape.edges = &normals[0, 0, 0], &edges[0]
        shape.uvs = NULL if uvs is None else &uvs[0, 0, 0]
        low, high = np.min(positions, axis=0), np.max(positions, axis=0)
        for k in range(3):
            shape.low[k], shape.high[k] = low[k], high[k]
        self.held["shape", number] = positions, corners, normals, uvs, edges

    def set_plane(self, int number, const double[::1] x not None, const double[::1] y not None, scale, offset):
        """Set a plane's lines along both axes, and where its texture lies."""
        cdef e3d_muj_plane *plane
        require(0 <= number < self.frame.plane_count, "no such plane")
        require(x.shape[0] > 1 and y.shape[0] > 1, "a plane has at least one cell")
        plane = &self.planes[number]
        plane.lines[0], plane.lines[1] = &x[0], &y[0]
        plane.cells[0], plane.cells[1] = <int32_t>x.shape[0] - 1, <int32_t>y.shape[0] - 1
        for k in range(2):
            plane.scale[k], plane.offset[k] = scale[k], offset[k]
        self.held["plane", number] = x, y

    def set_texture(self, int number, list levels not None, const float[::1] meaning):
        """Set a texture's levels, (faces, H, W, 4), and what the codes of its colours mean, (256,); None: code / 255."""
        cdef const uint8_t[:, :, :, ::1] texels
        cdef e3d_muj_texture *texture
        cdef int k
        require(0 <= number < self.frame.texture_count, "no such texture")
        require(0 < len(levels) <= E3D_MUJ_LEVELS, "a texture has at least one level")
        require(meaning is None or meaning.shape[0] == 256, "a meaning for each code")
        texture = &self.textures[number]
        memset(texture, 0, sizeof(e3d_muj_texture))
        for k in range(len(levels)):
            texels = levels[k]
            if k == 0:
                texture.faces = <int32_t>texels.shape[0]
                texture.height, texture.width = <int32_t>texels.shape[1], <int32_t>texels.shape[2]
                require(texels.shape[1] > 0 and texels.shape[2] > 0, "a texture has at least one texel")
                require(texture.faces == 1 or texture.faces == 6, "a texture has one face or six")
            require(texels.shape[0] == texture.faces and texels.shape[1] == max(texture.height >> k, 1)
                    and texels.shape[2] == max(texture.width >> k, 1) and texels.shape[3] == 4, "a level has the wrong size")
            texture.level[k] = &texels[0, 0, 0, 0]
        texture.levels = <int32_t>len(levels)
        if meaning is not None:
            texture.meaning = &meaning[0]
        self.held["texture", number] = levels, meaning


cdef class NativePicture:
    """Memory for pictures, one after the other, and what draws them: a backend of the core, up to `threads` threads (0: all)."""

    cdef e3d_muj_memory *memory
    cdef e3d_backend backend
    cdef int threads

    def __cinit__(self, int backend, int threads):
        self.backend, self.threads = <e3d_backend>backend, threads
        self.memory = e3d_muj_memory_new()
        if self.memory == NULL:
            raise OutOfMemoryError("no memory for pictures")

    def __dealloc__(self):
        e3d_muj_memory_free(self.memory)

    def render(self, NativeModel model not None, geoms not None, lights not None, const double[::1] camera not None,
               bint is_orthographic, int samples, float ambient, flags not None,
               uint8_t[:, :, ::1] color, int32_t[:, ::1] geom=None, float[:, ::1] depth=None):
        """Draw into the arrays.

        `geoms` and `lights`: arrays of the dtypes GEOM and LIGHT. `camera`: the rows of eye_from_world to the right, up and
        ahead, the eye, the frustum's left, right, bottom and top, near and far,
        and what depths of perspectives are made with. `flags`: wireframe, cull, reflect, shadow,
        additive, fog, haze, sky. Without `color`: numbers of geoms and depths.
        """
        cdef e3d_muj_frame frame = model.frame
        cdef const uint8_t[::1] geom_bytes = geoms.view(np.uint8) if len(geoms) else np.zeros(1, np.uint8)
        cdef const uint8_t[::1] light_bytes = lights.view(np.uint8) if len(lights) else np.zeros(1, np.uint8)
        cdef e3d_status status
        cdef int k
        require(geoms.dtype == GEOM and lights.dtype == LIGHT and camera.shape[0] == 23, "wrong records of a scene")
        frame.geoms, frame.geom_count = <const e3d_muj_geom *>&geom_bytes[0], <int32_t>len(geoms)
        frame.lights, frame.light_count = <const e3d_muj_light *>&light_bytes[0], <int32_t>len(lights)
        for k in range(12):
            frame.view[k // 4][k % 4] = camera[k]
        for k in range(3):
            frame.eye[k] = camera[12 + k]
        frame.left, frame.right, frame.bottom, frame.top = camera[15], camera[16], camera[17], camera[18]
        frame.near_plane, frame.far_plane = camera[19], camera[20]
        frame.depth_scale, frame.depth_offset = camera[21], camera[22]
        frame.is_orthographic, frame.samples, frame.ambient = is_orthographic, samples, ambient
        (frame.is_wireframe, frame.culls_backs, frame.reflects, frame.shadows, frame.is_additive, frame.has_fog, frame.has_haze,
         has_sky) = flags
        frame.backend = self.backend
        if not has_sky:
            frame.sky = -1
        if color is not None:
            require(color.shape[2] == 3, "colours have three channels")
            frame.height, frame.width = <int32_t>color.shape[0], <int32_t>color.shape[1]
            frame.color = &color[0, 0, 0] if color.size else NULL
        else:
            require(geom is not None or depth is not None, "something is drawn")
            frame.is_segmented = 1
            if geom is not None:
                frame.height, frame.width, frame.geom = <int32_t>geom.shape[0], <int32_t>geom.shape[1], &geom[0, 0]
            if depth is not None:
                require(geom is None or (depth.shape[0] == frame.height and depth.shape[1] == frame.width), "arrays of one size")
                frame.height, frame.width, frame.depth = <int32_t>depth.shape[0], <int32_t>depth.shape[1], &depth[0, 0]
        with nogil:
            status = e3d_muj_render(&frame, self.threads, self.memory)
        if status == E3D_OUT_OF_MEMORY:
            raise OutOfMemoryError("no memory for the picture")
        if status != E3D_OK:
            raise InvalidArgumentError("a pixel has one sample or four, and an image has at least one pixel")
