# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to pictures in pyrender's manner: csrc/include/e3d_pyrender.h.

In:  arrays of shapes and textures, which are checked once; lists of what a picture draws, in order.
Out: colours and depths, in the caller's arrays.
Always: what a picture points to is held by it until the next `clear`; the GIL is released while it is drawn.
"""

from cpython.bytearray cimport PyByteArray_AsString
from libc.stdint cimport int32_t, uint8_t
from libc.stdlib cimport free, realloc
from libc.string cimport memset

from e3d cimport E3D_OK, E3D_OUT_OF_MEMORY, e3d_status
from e3d_pyrender cimport *

from ..errors import InvalidArgumentError, OutOfMemoryError

TRIANGLES, LINES, POINTS = E3D_PYR_TRIANGLES, E3D_PYR_LINES, E3D_PYR_POINTS
LIT, FLAT, PLAIN, DEPTH = E3D_PYR_LIT, E3D_PYR_FLAT, E3D_PYR_PLAIN, E3D_PYR_DEPTH
REPEAT, CLAMP, MIRROR = E3D_PYR_REPEAT, E3D_PYR_CLAMP, E3D_PYR_MIRROR
DIRECTIONAL, POINT, SPOT = E3D_PYR_DIRECTIONAL, E3D_PYR_POINT, E3D_PYR_SPOT
SAMPLES = E3D_PYR_SAMPLES
CENTRE, PLACES = E3D_PYR_CENTRE, E3D_PYR_PLACES
LEVELS = E3D_PYR_LEVELS


cdef int require(bint condition, str message) except -1:
    if not condition:
        raise InvalidArgumentError(message)
    return 0


cdef int copy_floats(float *to, values, int count) except -1:
    for k in range(count):
        to[k] = values[k]
    return 0


cdef int copy_matrix(double *to, const double[:, ::1] matrix) except -1:
    require(matrix.shape[0] == 4 and matrix.shape[1] == 4, "a matrix is 4x4")
    for k in range(16):
        to[k] = matrix[k // 4, k % 4]
    return 0


cdef const float *rows_of(const float[:, ::1] array, int32_t rows, int columns) except? NULL:
    if array is None:
        return NULL
    require(array.shape[0] == rows and array.shape[1] == columns, "an array has the wrong shape")
    return &array[0, 0] if rows else NULL


cdef class NativeShape:
    """What a primitive is made of: corners of triangles, lines or points, and vertices."""

    cdef e3d_pyr_draw draw
    cdef object held
    cdef bytearray calm

    def __init__(self, int mode, const int32_t[::1] indices not None, const float[:, ::1] positions not None,
                 const float[:, ::1] normals=None, const float[:, ::1] uvs=None, const float[:, ::1] colors=None):
        cdef int32_t size = 3 if mode == E3D_PYR_TRIANGLES else 2 if mode == E3D_PYR_LINES else 1
        cdef int32_t vertices = <int32_t>positions.shape[0]
        cdef bint in_range = True
        cdef Py_ssize_t i
        for i in range(indices.shape[0]):
            in_range &= 0 <= indices[i] < vertices
        require(in_range, "an index is out of range")
        memset(&self.draw, 0, sizeof(e3d_pyr_draw))
        self.draw.mode, self.draw.vertices = mode, vertices
        self.draw.count = <int32_t>(indices.shape[0] // size)
        self.draw.indices = &indices[0] if indices.shape[0] else NULL
        self.draw.positions = rows_of(positions, vertices, 3)
        self.draw.normals = rows_of(normals, vertices, 3)
        self.draw.uvs = rows_of(uvs, vertices, 2)
        self.draw.colors = rows_of(colors, vertices, 4)
        self.held = indices, positions, normals, uvs, colors
        if mode == E3D_PYR_TRIANGLES:
            self.calm = bytearray(self.draw.count)
            self.draw.calm = <const uint8_t *>PyByteArray_AsString(self.calm)
            e3d_pyr_find_calm(&self.draw, <uint8_t *>PyByteArray_AsString(self.calm))


cdef class NativeTexture:
    """Levels of 8-bit texels, (height, width, channels), row 0 at the bottom; each half as large as the one before."""

    cdef e3d_pyr_texture texture
    cdef object held

    def __init__(self, list levels not None, int wrap_u, int wrap_v, bint linear_near, bint linear_far,
                 bint blends_levels):
        cdef const uint8_t[:, :, ::1] texels
        cdef int k
        require(0 < len(levels) <= E3D_PYR_LEVELS, "a texture has at least one level")
        memset(&self.texture, 0, sizeof(e3d_pyr_texture))
        for k in range(len(levels)):
            texels = levels[k]
            if k == 0:
                self.texture.height, self.texture.width = <int32_t>texels.shape[0], <int32_t>texels.shape[1]
                self.texture.channels = <int32_t>texels.shape[2]
                require(texels.shape[0] > 0 and texels.shape[1] > 0, "a texture has at least one texel")
                require(0 < texels.shape[2] <= 4, "a texture has up to four channels")
            require(texels.shape[0] == max(self.texture.height >> k, 1)
                    and texels.shape[1] == max(self.texture.width >> k, 1)
                    and texels.shape[2] == self.texture.channels, "a level has the wrong size")
            self.texture.level[k] = &texels[0, 0, 0]
        self.texture.levels = <int32_t>len(levels)
        self.texture.wrap[0], self.texture.wrap[1] = wrap_u, wrap_v
        self.texture.linear_near, self.texture.linear_far = linear_near, linear_far
        self.texture.blends_levels = blends_levels
        self.held = levels


cdef void *grown(void *items, int count, int *capacity, size_t size) except NULL:
    """Room for one more item."""
    cdef void *moved
    if count < capacity[0]:
        return items
    capacity[0] = capacity[0] * 2 if capacity[0] else 16
    moved = realloc(items, capacity[0] * size)
    if moved == NULL:
        raise OutOfMemoryError("no memory for the list of what to draw")
    return moved


cdef class NativePicture:
    """Lists of what a picture draws, and the drawing of it."""

    cdef e3d_pyr_draw *draws
    cdef e3d_pyr_light *lights
    cdef int32_t *light_numbers
    cdef e3d_pyr_step *steps
    cdef int draw_room, light_room, number_room, step_room
    cdef readonly int draw_count, light_count, step_count
    cdef int number_count
    cdef list held
    cdef e3d_pyr_memory *memory

    def __cinit__(self):
        self.held = []
        self.memory = e3d_pyr_memory_new()
        if self.memory == NULL:
            raise OutOfMemoryError("no memory for pictures")

    def __dealloc__(self):
        free(self.draws)
        free(self.lights)
        free(self.light_numbers)
        free(self.steps)
        e3d_pyr_memory_free(self.memory)

    def clear(self):
        self.draw_count = self.light_count = self.step_count = self.number_count = 0
        self.held = []

    def add_light(self, int kind, color: Sequence[float] | NDArray[Any], position: Sequence[float] | NDArray[Any],
                  direction: Sequence[float] | NDArray[Any], float cone_scale, float cone_offset,
                  const float[:, ::1] shadow_map=None, const double[:, ::1] shadow_from_world=None):
        """Add a light; its number is how many there were."""
        cdef e3d_pyr_light *light
        self.lights = <e3d_pyr_light *>grown(self.lights, self.light_count, &self.light_room, sizeof(e3d_pyr_light))
        light = &self.lights[self.light_count]
        memset(light, 0, sizeof(e3d_pyr_light))
        light.kind = kind
        copy_floats(light.color, color, 3)
        copy_floats(light.position, position, 3)
        copy_floats(light.direction, direction, 3)
        light.cone_scale, light.cone_offset = cone_scale, cone_offset
        if shadow_map is not None:
            require(shadow_map.shape[0] == shadow_map.shape[1] > 0, "a map of shadows is a square")
            copy_matrix(light.shadow_from_world, shadow_from_world)
            light.shadow_map, light.shadow_size = &shadow_map[0, 0], <int32_t>shadow_map.shape[0]
            self.held.append(shadow_map)
        self.light_count += 1

    def add_lights_of_draws(self, numbers: Iterable[int]) -> int:
        """Say which lights the draws that are added next have; returns where the list begins."""
        first = self.number_count
        for number in numbers:
            require(0 <= number < self.light_count, "no such light")
            self.light_numbers = <int32_t *>grown(
                self.light_numbers, self.number_count, &self.number_room, sizeof(int32_t))
            self.light_numbers[self.number_count] = number
            self.number_count += 1
        return first

    def add_draw(self, NativeShape shape not None, const double[:, ::1] world not None, bint culls_backs,
                 bint is_wireframe, bint blends, color: Sequence[float] | NDArray[Any], float metallic,
                 float roughness, emissive: Sequence[float] | NDArray[Any],
                 tuple textures not None, int first_light, int light_count):
        """Add a draw; its number is how many there were."""
        cdef e3d_pyr_draw *draw
        cdef int k
        require(0 <= first_light and 0 <= light_count and first_light + light_count <= self.number_count,
                "no such lights")
        require(len(textures) == E3D_PYR_SLOTS, "a texture or None for each slot")
        self.draws = <e3d_pyr_draw *>grown(self.draws, self.draw_count, &self.draw_room, sizeof(e3d_pyr_draw))
        draw = &self.draws[self.draw_count]
        draw[0] = shape.draw
        copy_matrix(draw.world, world)
        draw.culls_backs, draw.is_wireframe, draw.blends = culls_backs, is_wireframe, blends
        copy_floats(draw.color, color, 4)
        draw.metallic, draw.roughness = metallic, roughness
        copy_floats(draw.emissive, emissive, 3)
        for k in range(E3D_PYR_SLOTS):
            if textures[k] is not None:
                draw.textures[k] = &(<NativeTexture?>textures[k]).texture
        draw.first_light, draw.light_count = first_light, light_count
        self.held.append((shape, textures))
        self.draw_count += 1

    cdef e3d_pyr_step *new_step(self) except NULL:
        self.steps = <e3d_pyr_step *>grown(self.steps, self.step_count, &self.step_room, sizeof(e3d_pyr_step))
        memset(&self.steps[self.step_count], 0, sizeof(e3d_pyr_step))
        self.step_count += 1
        return &self.steps[self.step_count - 1]

    def add_drawn(self, int first, int count):
        """Draw some of the draws next, one after the other."""
        cdef e3d_pyr_step *step
        require(0 <= first and 0 <= count and first + count <= self.draw_count, "no such draws")
        step = self.new_step()
        step.first_draw, step.draw_count = first, count

    def add_visible(self, list places not None, const int32_t[::1] draw_of_object not None):
        """Show next what is known to be visible.

        `places`: of each sample, then of the centre, the outputs object_id, face_id and instance_id of a frame; None for the
        first where all is of object 0, and for the last where nothing has instances. `draw_of_object`: the draw of each object's
        first instance.
        """
        cdef e3d_pyr_step *step = self.new_step()
        cdef const int32_t[:, ::1] ids
        cdef int k
        require(0 < len(places) <= E3D_PYR_PLACES, "a pixel has one place or five")
        for k in range(len(places)):
            objects, triangles, instances = places[k]
            if objects is not None:
                ids = objects
                step.object_id[k] = &ids[0, 0]
            ids = triangles
            step.face_id[k] = &ids[0, 0]
            if instances is not None:
                ids = instances
                step.instance_id[k] = &ids[0, 0]
        step.draw_of_object = &draw_of_object[0]
        self.held.append((places, draw_of_object))

    def render(self, int samples, int shading, const double[:, ::1] clip_from_world not None,
               eye: Sequence[float] | NDArray[Any], ambient: Sequence[float] | NDArray[Any],
               background: Sequence[float] | NDArray[Any], float point_size, double depth_near,
               double depth_far, bint depth_is_straight, int depth_place, int threads,
               uint8_t[:, :, ::1] color, float[:, ::1] depth not None):
        """Draw into the arrays; `color` is None where there is none, with shading DEPTH."""
        cdef e3d_pyr_frame frame
        cdef e3d_status status
        memset(&frame, 0, sizeof(e3d_pyr_frame))
        frame.height, frame.width = <int32_t>depth.shape[0], <int32_t>depth.shape[1]
        require(frame.width > 0 and frame.height > 0, "an image has at least one pixel")
        require((color is None) == (shading == E3D_PYR_DEPTH), "colours, unless only depths are drawn")
        if color is not None:
            require(color.shape[0] == frame.height and color.shape[1] == frame.width and 3 <= color.shape[2] <= 4,
                    "color must be (height, width, 3 or 4)")
            frame.color, frame.channels = &color[0, 0, 0], <int32_t>color.shape[2]
        frame.depth = &depth[0, 0]
        frame.samples, frame.shading = samples, shading
        copy_matrix(frame.clip_from_world, clip_from_world)
        copy_floats(frame.eye, eye, 3)
        copy_floats(frame.ambient, ambient, 3)
        copy_floats(frame.background, background, 4)
        frame.point_size = point_size
        frame.depth_place = depth_place
        frame.depth_near, frame.depth_far, frame.depth_is_straight = depth_near, depth_far, depth_is_straight
        frame.draws, frame.draw_count = self.draws, self.draw_count
        frame.lights, frame.light_numbers = self.lights, self.light_numbers
        frame.steps, frame.step_count = self.steps, self.step_count
        with nogil:
            status = e3d_pyr_render(&frame, threads, self.memory)
        if status == E3D_OUT_OF_MEMORY:
            raise OutOfMemoryError("no memory for the picture")
        if status != E3D_OK:
            raise InvalidArgumentError("a pixel has one sample or four, and its depth is at one of them or at the centre")
