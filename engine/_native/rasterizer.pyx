# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The gateway to the rendering core: csrc/include/e3d.h, one thin class for each handle.

In:  C-contiguous arrays of fixed types (checked here: shape and dtype, by the memoryviews), plain
     numbers, and the enumerators of the tables below.
Out: the caller's arrays, filled; every C status becomes an exception in `check`, and only there.
Always: a handle holds the arrays that the core borrows; the GIL is released for the C calls that
     take long; there is no algorithm here.
"""

from typing import NamedTuple

from cpython.exc cimport PyErr_CheckSignals
from libc.math cimport INFINITY
from cpython.ref cimport PyObject
from libc.stdint cimport int32_t, int64_t, uint8_t, uint16_t, uint32_t, uint64_t
from libc.stdlib cimport calloc, free, realloc
from libc.string cimport memcmp, memcpy, memset

from e3d cimport *
from e3d_occlusion cimport *
from e3d_posing cimport *
from e3d_draw_list cimport *
from e3d_scene cimport *
from e3d_apertures cimport *

from .scene_graph cimport NativeTree

from ..errors import BackendError, Engine3DError, InvalidArgumentError, OutOfMemoryError, RendererBusyError

FORKED = (
    "this process was forked while the renderer drew, and has no more than half of that frame: "
    "make another Renderer here"
)


cdef dict values_of(e3d_option option):
    """The number of each name that may be chosen, in the core's order."""
    values = {}
    while e3d_option_name(option, <int32_t>len(values)) != NULL:
        values[e3d_option_name(option, <int32_t>len(values)).decode()] = len(values)
    return values


ALPHA_MODES = values_of(E3D_OPTION_ALPHA_MODE)
CULLS = values_of(E3D_OPTION_CULL)
CULLINGS = values_of(E3D_OPTION_CULLING)
FALLOFFS = values_of(E3D_OPTION_FALLOFF)
FILTERS = values_of(E3D_OPTION_FILTER)
HIDDEN_SURFACES = values_of(E3D_OPTION_HIDDEN)
LIGHT_KINDS = values_of(E3D_OPTION_LIGHT_KIND)
LINE_SHAPES = values_of(E3D_OPTION_LINE_SHAPE)
MAP_LAYOUTS = values_of(E3D_OPTION_MAP_LAYOUT)
MODES = values_of(E3D_OPTION_MODE)
NORMALS = values_of(E3D_OPTION_NORMALS)
POINT_SHAPES = values_of(E3D_OPTION_POINT_SHAPE)
SHADINGS = values_of(E3D_OPTION_SHADING)
TEXTURE_SLOTS = values_of(E3D_OPTION_TEXTURE_SLOT)
TONE_MAPPINGS = values_of(E3D_OPTION_TONE_MAPPING)
WIREFRAMES: dict[str | None, int] = {
    None if name == "none" else name: value
    for name, value in values_of(E3D_OPTION_WIREFRAME).items()
}
WRAPS = values_of(E3D_OPTION_WRAP)
# Every backend that the interface knows, whether this machine can run it or not.
BACKENDS = values_of(E3D_OPTION_BACKEND)


cdef tuple names_of_physical():
    cdef e3d_physical numbers
    memset(&numbers, 0, sizeof(numbers))
    return tuple(<dict>numbers)


# What the core wants to know of a physically based material.
PHYSICAL_NUMBERS: tuple[str, ...] = names_of_physical()


class LightTraits(NamedTuple):
    """What is true of a kind of lights: e3d_light_traits; ``maps`` is one of `MAP_LAYOUTS`."""

    has_position: bool
    is_turned: bool
    maps: str


def _traits_of(int kind):
    cdef e3d_light_traits traits = e3d_light_traits_of(<e3d_light_kind>kind)
    is_turned = traits.emission != E3D_EMITS_EVENLY or not traits.has_position
    return LightTraits(bool(traits.has_position), is_turned, list(MAP_LAYOUTS)[traits.maps])


LIGHT_TRAITS: dict[str, LightTraits] = {name: _traits_of(kind) for name, kind in LIGHT_KINDS.items()}

cdef extern from *:
    const char *E3D_BUILD
    const char *_compiler "__VERSION__"

# How this was compiled: the kind of build, of those in build_rules.py, the compiler's version.
BUILD: tuple[str, str] = (E3D_BUILD.decode(), _compiler.decode())


cdef dict formats_of(const e3d_array_format *formats, int count):
    """Of each array by its name the dtype and the number of channels."""
    found = {}
    for k in range(count):
        dtype = "float32" if formats[k].is_float else "uint8" if formats[k].bytes == 1 else "int32"
        found[formats[k].name.decode()] = dtype, formats[k].channels
    return found


OUTPUTS: dict[str, tuple[str, int]] = formats_of(E3D_OUTPUT_FORMATS, E3D_OUTPUTS)
VERTEX_ATTRIBUTES: dict[str, tuple[str, int]] = formats_of(E3D_VERTEX_FORMATS, E3D_VERTEX_ATTRIBUTES)
# The number of each, as the core counts them.
cdef dict OUTPUT_NUMBERS = {name: number for number, name in enumerate(OUTPUTS)}
cdef dict VERTEX_NUMBERS = {name: number for number, name in enumerate(VERTEX_ATTRIBUTES)}

# Seconds of a frame between two looks at the pending signals: Ctrl-C feels immediate, and a busy
# interpreter in another thread is not asked for the GIL more often than that.
cdef double SIGNAL_INTERVAL = 0.05


cdef int check(e3d_status status) except -1:
    """The one place where the core's status becomes an exception."""
    if status == E3D_OK:
        return 0
    text = e3d_status_text(status).decode()
    if status == E3D_OUT_OF_MEMORY:
        raise OutOfMemoryError(text)
    if status == E3D_UNSUPPORTED_BACKEND:
        raise BackendError(text)
    if status == E3D_INVALID_ARGUMENT or status == E3D_TOO_MANY_PRIMITIVES:
        raise InvalidArgumentError(text)
    raise Engine3DError(text)


cdef int require(bint condition, str message) except -1:
    if not condition:
        raise InvalidArgumentError(message)
    return 0


include "lent_arrays.pxi"


def backend_available(int backend) -> bool:
    """Whether this build has the backend and this machine can run it."""
    return bool(e3d_backend_available(<e3d_backend>backend))


def best_backend() -> int:
    """The fastest backend of this machine, never the scalar reference."""
    return <int>e3d_backend_best()


def thread_count() -> int:
    """How many threads the core takes when asked for 0."""
    return e3d_thread_count()


def bound_points(const float[:, ::1] points not None) -> tuple[list[float], list[float]]:
    """The box of the (N, 3) points that are finite: lowest and highest corner, zeros if there are none."""
    cdef float low[3]
    cdef float high[3]
    cdef int64_t count = points.shape[0]
    require(points.shape[1] == 3, "points must have 3 columns")
    with nogil:
        e3d_bound_points(&points[0, 0] if count else NULL, count, low, high)
    return low, high


def same_objects(tuple some not None, tuple others not None) -> bool:
    """Whether two tuples hold the same objects: each frame asks, of values that ``==`` would confuse."""
    cdef Py_ssize_t k
    if len(some) != len(others):
        return False
    for k in range(len(some)):
        if some[k] is not others[k]:
            return False
    return True


include "mesh_handles.pxi"
include "environment_handles.pxi"
include "mesh_poses.pxi"
include "draw_list.pxi"


cdef struct SignalPoll:
    double due
    void *renderer


cdef extern from "base/clock.h":
    int64_t e3d_now_ns() nogil


cdef double monotonic_seconds() noexcept nogil:
    return 1e-9 * <double>e3d_now_ns()


cdef int poll_signals(void *user) noexcept nogil:
    """What the core calls between tiles: non-zero when a signal handler raised."""
    cdef SignalPoll *poll = <SignalPoll *>user
    cdef double now = monotonic_seconds()
    if now < poll.due:
        return 0
    poll.due = now + SIGNAL_INTERVAL
    return run_signal_handlers(poll.renderer)


cdef int run_signal_handlers(void *renderer) noexcept with gil:
    try:
        PyErr_CheckSignals()
    except BaseException as error:
        (<NativeRenderer>renderer).interruption = error
        return 1
    return (<NativeRenderer>renderer).handle == NULL  # forked by a handler: the helpers are elsewhere


cdef int set_fog(e3d_fog *fog, tuple values) except -1:
    """`values`: the colour, that over lit surfaces, near and far of linear fog or None, the density."""
    color, lit_color, depths, density = values
    fog.kind = E3D_FOG_EXPONENTIAL if depths is None else E3D_FOG_LINEAR
    copy_vector(fog.color, color, 3)
    copy_vector(fog.lit_color, lit_color, 3)
    fog.near, fog.far = (0.0, 1.0) if depths is None else depths
    fog.density = density
    return 0


cdef int32_t set_mirrors(e3d_mirror *out, list mirrors) except -1:
    cdef const float[:, :, ::1] radiance
    cdef int32_t count = 0
    require(len(mirrors) <= E3D_MAX_MIRRORS, "too many mirrors")
    for plane, slack, left, top, scale, radiance in mirrors:
        require(radiance.shape[2] == 3 and radiance.shape[0] > 0 and radiance.shape[1] > 0, "radiance must be (rows, columns, 3)")
        require(radiance.shape[0] % scale == 0 and radiance.shape[1] % scale == 0, "a sample has all of its pixels")
        copy_vector(out[count].plane, plane, 4)
        out[count].slack, out[count].left, out[count].top, out[count].scale = slack, left, top, scale
        out[count].width, out[count].height = <int32_t>radiance.shape[1] // scale, <int32_t>radiance.shape[0] // scale
        out[count].radiance = &radiance[0, 0, 0]
        count += 1
    return count


cdef class NativeOptions:
    """How frames are drawn: all of a frame's settings but its size, its view and the scene."""

    cdef e3d_frame frame
    cdef tuple held

    def __cinit__(
        self,
        dict numbers not None,
        NativeEnvironment environment=None,
        NativeEnvironment backdrop=None,
        tuple fog=None,
    ):
        """`numbers`: a number, or a sequence of them, for each member of e3d_frame that has such a name."""
        memset(&self.frame, 0, sizeof(e3d_frame))
        for name, value in numbers.items():
            set_numbers(&self.frame, name.encode(), value if isinstance(value, (tuple, list)) else (value,))
        self.frame.environment.environment = NULL if environment is None else environment.handle
        self.frame.backdrop.light.environment = NULL if backdrop is None else backdrop.handle
        if fog is not None:
            set_fog(&self.frame.fog, fog)
        self.held = environment, backdrop


cdef int set_numbers(e3d_frame *frame, bytes name, values) except -1:
    cdef double numbers[4]
    cdef int count = <int>len(values)
    require(count <= 4, "no member has more numbers")
    for k in range(count):
        numbers[k] = values[k]
    return require(e3d_frame_set(frame, name, numbers, count), f"no numbers of a frame: {name.decode()}")


cdef class NativeStats:
    """What a frame drew: numbers, which few callers read."""

    cdef e3d_stats stats
    cdef e3d_totals totals
    cdef int64_t draws, draws_unbatched, nodes_in_frustum, boxes_tested
    cdef int materials, lights
    cdef public int shadow_maps, shadow_maps_drawn

    def as_dict(self) -> dict[str, int | float | str]:
        cdef e3d_stats *stats = &self.stats
        cdef e3d_totals *totals = &self.totals
        return {
            "draws": self.draws,
            "draws_unbatched": self.draws_unbatched,
            "materials": self.materials,
            "lights": self.lights,
            "shadow_maps": self.shadow_maps,
            "shadow_maps_drawn": self.shadow_maps_drawn,
            "boxes_tested": self.boxes_tested,
            "objects": totals.nodes,
            "nodes_in_frustum": self.nodes_in_frustum,
            "nodes_unoccluded": stats.nodes_unoccluded,
            "nodes_drawn": stats.nodes_drawn,
            "instances": totals.instances,
            "instances_in_frustum": stats.instances,
            "instances_drawn": stats.instances_drawn,
            "clusters": totals.clusters,
            "clusters_in_frustum": stats.clusters_in_frustum,
            "clusters_unoccluded": stats.clusters_unoccluded,
            "clusters_drawn": stats.clusters_drawn,
            "clusters_culled": stats.clusters_culled + totals.clusters - stats.clusters,
            "clusters_occluded": stats.clusters_occluded,
            "triangles": totals.triangles,
            "triangles_in_frustum": stats.triangles_in_frustum,
            "triangles_unoccluded": stats.triangles_unoccluded,
            "triangles_drawn": stats.triangles_drawn,
            "triangles_culled": stats.triangles_culled + totals.triangles - stats.triangles,
            "triangles_occluded": stats.triangles_occluded,
            "triangles_clipped": stats.triangles_clipped,
            "triangles_setup": stats.triangles_setup,
            "bin_entries": stats.bin_entries,
            "pixels_shaded": stats.pixels_shaded,
            "rounds": stats.rounds,
            "ms_geometry": stats.ms_geometry,
            "ms_raster": stats.ms_raster,
            "ms_shade": stats.ms_shade,
            "ms_resolve": stats.ms_resolve,
            "ms_total": stats.ms_total,
            "ms_alone": stats.ms_alone,
            "threads": stats.threads,
            "tiles": stats.tiles,
            "backend": e3d_backend_name(stats.backend).decode(),
            "plan": self.plan(),
        }

    def plan(self):
        steps = []
        bit = 0
        while e3d_plan_step(bit):
            if self.stats.plan >> bit & 1:
                steps.append(e3d_plan_step(bit).decode().lower())
            bit += 1
        return tuple(steps)


cdef class NativeRenderer:
    """A renderer of the core: one backend, a number of threads. One thread's at a time."""

    cdef e3d_renderer *handle
    cdef SignalPoll poll
    cdef object interruption

    def __cinit__(self, int backend, int threads):
        check(e3d_renderer_create(<e3d_backend>backend, threads, &self.handle))
        self.poll.renderer = <void *>self
        e3d_renderer_set_poll(self.handle, poll_signals, &self.poll)

    def __dealloc__(self):
        if self.handle != NULL:
            e3d_renderer_destroy(self.handle)

    def abandon(self):
        """Use the handle no more, nor free it: a fork may have caught a frame in mid-write."""
        self.handle = NULL

    cdef int check_usable(self) except -1:
        """Raise if the renderer was abandoned."""
        if self.handle == NULL:
            raise RendererBusyError(FORKED)
        return 0

    def prepare(self, int width, int height, int planes):
        """Have memory ready that frames of so many samples may need, in as many planes."""
        cdef e3d_status status
        self.check_usable()
        with nogil:
            status = e3d_renderer_prepare(self.handle, width, height, planes)
        check(status)

    def render(
        self,
        NativeDrawList draw_list not None,
        dict targets not None,
        NativeOptions options not None,
        int width,
        int height,
        int samples_axis,
        int msaa_samples,
        clip_from_world: NDArray[np.float64],
        view_from_world: NDArray[np.float64],
        eye: Sequence[float],
        int64_t number,
        float depth_near,
        float depth_far,
        const double[:, ::1] frozen_clip_from_world=None,
        const float[:, ::1] rays=None,
        const float[:, ::1] ambient_visibility=None,
        list mirrors=None,
        const float[::1] behind=None,
        const float[:, ::1] behind_depth=None,
        tuple whole=None,
    ) -> NativeStats:
        """Draw one frame into the arrays of `targets`; return its NativeStats.

        `number` tells the camera from others: the core remembers what each saw in its last frame.
        If a signal handler raises meanwhile, its exception is raised here and the targets are
        partly written. Where an environment is the background, `rays` has three rows: e3d_backdrop's.
        `ambient_visibility`: (height, width), of each pixel. `mirrors`: of each its plane (four numbers), slack, left,
        top, scale, and radiance (rows, columns, 3), as e3d_mirror has them. `behind`: what `find_behind` found, with the
        depths of the same picture. `whole`: of a part of a picture, the width and height of that one, and the fineness.
        """
        cdef e3d_frame frame
        cdef e3d_mirror reflecting[E3D_MAX_MIRRORS]
        cdef e3d_targets outputs
        cdef NativeStats drawn = NativeStats.__new__(NativeStats)
        frame = options.frame
        frame.width = width
        frame.height = height
        frame.samples_axis = samples_axis
        frame.msaa_samples = msaa_samples
        if whole is not None:
            frame.whole_width, frame.whole_height, frame.fineness = whole
        set_view(&frame, clip_from_world, view_from_world, eye, number)
        set_frustum(&frame, frozen_clip_from_world)
        if rays is not None:
            require(rays.shape[0] == 3 and rays.shape[1] == 3, "rays must be (3, 3)")
            memcpy(frame.backdrop.ray, &rays[0, 0], 3 * sizeof(float))
            memcpy(frame.backdrop.across, &rays[1, 0], 3 * sizeof(float))
            memcpy(frame.backdrop.down, &rays[2, 0], 3 * sizeof(float))
        if ambient_visibility is not None:
            require(ambient_visibility.shape[0] == height and ambient_visibility.shape[1] == width,
                    "ambient_visibility must be (height, width)")
            frame.ambient_visibility = &ambient_visibility[0, 0]
        if mirrors is not None:
            frame.mirrors, frame.mirror_count = reflecting, set_mirrors(reflecting, mirrors)
        if behind is not None:
            require(<size_t>behind.shape[0] >= e3d_behind_floats(width, height), "behind is too small")
            require(behind_depth.shape[0] == height and behind_depth.shape[1] == width,
                    "behind_depth must be (height, width)")
            frame.behind, frame.behind_depth = &behind[0], &behind_depth[0, 0]
        frame.ambient_light = draw_list.ambient_light
        frame.depth_near = depth_near
        frame.depth_far = depth_far
        frame.apertures, frame.aperture_count = draw_list.apertures, draw_list.aperture_count
        frame.materials = draw_list.materials
        if frame.mode == E3D_MODE_UNLIT:
            draw_list.find_unlit_materials()
            frame.materials = draw_list.unlit_materials
        frame.material_count = draw_list.material_count
        frame.lights = draw_list.lights
        frame.light_count = draw_list.light_count
        frame.draws = draw_list.placed.draws
        frame.draw_count = draw_list.placed.count
        frame.order = draw_list.placed.order
        frame.order_count = draw_list.placed.order_count
        frame.shadow_maps = draw_list.shadow_maps
        frame.shadow_map_count = draw_list.shadow_map_count
        frame.casters = draw_list.casters_now()
        fill_targets(&outputs, targets, width, height)
        self.draw(&frame, &outputs, &drawn.stats)
        drawn.totals = draw_list.totals
        drawn.draws = draw_list.placed.calls
        drawn.draws_unbatched = draw_list.placed.node_calls
        drawn.boxes_tested = draw_list.node_boxes_tested + draw_list.placed.boxes_tested
        drawn.nodes_in_frustum = draw_list.placed.nodes
        drawn.materials = draw_list.material_count
        drawn.lights = draw_list.light_count
        return drawn

    cdef int draw(self, const e3d_frame *frame, const e3d_targets *outputs, e3d_stats *stats) except -1:
        """Draw; raise what a signal handler raised, and RendererBusyError if the process was forked meanwhile."""
        cdef e3d_status status
        self.check_usable()
        self.interruption = None
        self.poll.due = monotonic_seconds() + SIGNAL_INTERVAL
        with nogil:
            status = e3d_render(self.handle, frame, outputs, stats)
        if self.interruption is not None:
            error, self.interruption = self.interruption, None
            raise error
        self.check_usable()
        check(status)
        return 0

    def draw_shadow_map(
        self,
        NativeDrawList draw_list not None,
        float[:, ::1] depths not None,
        clip_from_world: NDArray[np.float64],
        view_from_world: NDArray[np.float64],
        eye,
        int cull,
        int64_t number,
        const double[:, ::1] region=None,
    ):
        """Draw the casters that were placed last into a square of ndc depths; see `render`.

        ``region``: the frustum of those that count. Returns how many faces count and are not known
        to be hidden; 0 if hidden ones were looked for.
        """
        cdef e3d_frame frame
        cdef e3d_targets outputs
        cdef e3d_stats stats
        memset(&frame, 0, sizeof(e3d_frame))
        memset(&outputs, 0, sizeof(e3d_targets))
        frame.width, frame.height, frame.samples_axis = <int32_t>depths.shape[1], <int32_t>depths.shape[0], 1
        set_view(&frame, clip_from_world, view_from_world, eye, number)
        frame.mode, frame.cull = E3D_MODE_UNLIT, <e3d_cull>cull
        frame.line_width = frame.point_size = frame.depth_far = frame.exposure = 1.0
        frame.faces_only = True
        frame.materials = draw_list.casting_materials
        frame.material_count = draw_list.material_count
        frame.draws = draw_list.casting.draws
        frame.draw_count = draw_list.casting.count
        frame.order = draw_list.casting.order
        frame.order_count = draw_list.casting.order_count
        set_frustum(&frame, region)
        e3d_targets_set(&outputs, E3D_OUTPUT_NDC_DEPTH, floats_of(depths, frame.width, frame.height))
        self.draw(&frame, &outputs, &stats)
        return stats.triangles_in_frustum if stats.rounds == 1 else 0


cdef int set_frustum(e3d_frame *frame, const double[:, ::1] clip_from_world) except -1:
    """Cull by the frustum of another camera, unless it is None."""
    if clip_from_world is not None:
        require(clip_from_world.shape[0] == 4 and clip_from_world.shape[1] == 4, "a matrix is 4x4")
        frame.frozen_clip_from_world = &clip_from_world[0, 0]
    return 0


cdef int set_view(e3d_frame *frame, clip_from_world, view_from_world, eye, int64_t number) except -1:
    """Say from where a frame is seen, and the number by which the core remembers that."""
    require(copy_matrix(&frame.clip_from_world[0], clip_from_world), "a matrix is 4x4")
    require(copy_matrix(&frame.view_from_world[0], view_from_world), "a matrix is 4x4")
    copy_vector(frame.eye, eye, 4)
    frame.view = number
    return 0


cdef int fill_targets(e3d_targets *outputs, dict targets, int width, int height) except -1:
    """Point the core at the arrays, whose shape and dtype are checked on the way."""
    memset(outputs, 0, sizeof(e3d_targets))
    for name, array in targets.items():
        number = OUTPUT_NUMBERS.get(name)
        if number is None:
            raise InvalidArgumentError(f"no such output: {name!r}")
        e3d_targets_set(outputs, number, pixels_of(array, &E3D_OUTPUT_FORMATS[number], width, height))
    return 0


cdef void *pixels_of(array, const e3d_array_format *format, int width, int height) except NULL:
    cdef Py_buffer lent
    cdef char letter = b"f" if format.is_float else b"B" if format.bytes == 1 else b"i"
    cdef int ndim = 2 if format.channels == 1 else 3
    PyObject_GetBuffer(array, &lent, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT | PyBUF_WRITABLE)
    cdef bint fits = is_plain(&lent, letter, ndim) and lent.shape[0] == height and lent.shape[1] == width
    fits = fits and (ndim == 2 or lent.shape[2] == format.channels)
    PyBuffer_Release(&lent)
    return lent.buf if fits else checked_pixels(array, format, width, height)


cdef void *checked_pixels(array, const e3d_array_format *format, int width, int height) except NULL:
    """What `pixels_of` returns; raises where an array is not as it must be."""
    if format.bytes == 1:
        return bytes_of(array, width, height)
    if format.channels > 1:
        return vectors_of(array, width, height, format.channels)
    return floats_of(array, width, height) if format.is_float else <void *>integers_of(array, width, height)


cdef uint8_t *bytes_of(uint8_t[:, :, ::1] array, int width, int height) except NULL:
    require(array.shape[0] == height and array.shape[1] == width and array.shape[2] == 4,
            "color must be (height, width, 4)")
    return &array[0, 0, 0]


cdef float *floats_of(float[:, ::1] array, int width, int height) except NULL:
    require(array.shape[0] == height and array.shape[1] == width, "depth must be (height, width)")
    return &array[0, 0]


cdef int32_t *integers_of(int32_t[:, ::1] array, int width, int height) except NULL:
    require(array.shape[0] == height and array.shape[1] == width, "ids must be (height, width)")
    return &array[0, 0]


cdef float *vectors_of(float[:, :, ::1] array, int width, int height, int channels) except NULL:
    require(array.shape[0] == height and array.shape[1] == width and array.shape[2] == channels,
            "an output must be (height, width, channels)")
    return &array[0, 0, 0]


include "behind.pxi"
include "bloom.pxi"
include "clip_space.pxi"
include "occlusion.pxi"
include "shadow_ranges.pxi"
include "turns.pxi"
