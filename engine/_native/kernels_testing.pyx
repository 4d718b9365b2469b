# cython: boundscheck=False, wraparound=False, initializedcheck=False
"""The table of kernels of one backend, and clusters, for tests and benchmarks; the engine itself never imports it.

In:  plain numbers, arrays, and the kernels' C structs as their bytes (uint8 arrays whose size is
     checked: `STRUCT_SIZES`). tests/kernels/layouts.py has them as NumPy record types.
Out: what the calls of one kernel wrote, in the same arrays.
Always: nothing but the sizes of structs is checked. What a kernel expects of its arguments
     (csrc/kernels/kernels.h) is for the caller to keep: index out of range here, and it crashes.
"""

from array import array

from libc.math cimport INFINITY
from libc.stdint cimport int32_t, int64_t, uint8_t, uint16_t, uint32_t, uint64_t
from libc.string cimport memcpy, memset

from e3d cimport (
    E3D_DFG_SIZE, E3D_DFG_TABLE, E3D_OK, e3d_backdrop, e3d_backend, e3d_dfg, e3d_environment, e3d_environment_create,
    e3d_environment_destroy, e3d_environment_light, e3d_filter, e3d_fog_kind, e3d_light, e3d_light_shadow, e3d_mesh, e3d_mesh_create,
    e3d_mesh_desc, e3d_mesh_destroy, e3d_shadow_map, e3d_tone_mapping, e3d_wrap
)
from e3d_clusters cimport *
from e3d_helping cimport e3d_helping, e3d_helping_note, e3d_job_times
from e3d_kernels cimport *
from e3d_posing cimport e3d_pose_desc, e3d_reference_pose
from e3d_plan cimport E3D_ASKED_ITEMS, E3D_ASKED_WORDS, E3D_PLAN_ITEMS, E3D_PLAN_RULE_COUNT, E3D_PLAN_RULES, E3D_PLAN_WORDS, e3d_plan_rule

STRUCT_SIZES = {
    "cluster": sizeof(e3d_cluster),
    "facing": sizeof(e3d_facing),
    "viewport": sizeof(e3d_viewport),
    "vertices": sizeof(e3d_vertices),
    "survivors": sizeof(e3d_survivors),
    "record": sizeof(e3d_record),
    "tile_span": sizeof(e3d_tile_span),
    "small_triangles": sizeof(e3d_small_triangles),
    "bin": sizeof(e3d_bin),
    "fragment_block": sizeof(e3d_fragment_block),
    "drawn_cluster": sizeof(e3d_drawn_cluster),
    "piece": sizeof(e3d_piece),
    "visible_tile": sizeof(e3d_visible_tile),
    "run": sizeof(e3d_run),
    "cover": sizeof(e3d_cover),
    "layers": sizeof(e3d_layers),
    "shown": sizeof(e3d_shown),
    "surfaces": sizeof(e3d_surfaces),
    "batch": sizeof(e3d_batch),
    "light": sizeof(e3d_light),
    "light_shadow": sizeof(e3d_light_shadow),
    "shadow_map": sizeof(e3d_shadow_map),
    "map_batch": sizeof(e3d_map_batch),
    "cell_group": sizeof(e3d_cell_group),
    "lobe_block": sizeof(e3d_lobe_block),
}
LIMITS = {
    "PAD": E3D_PAD,
    "TILE": E3D_TILE,
    "CLUSTER_TRIANGLES": E3D_CLUSTER_TRIANGLES,
    "CLUSTER_VERTICES": E3D_CLUSTER_VERTICES,
    "BATCH": E3D_BATCH,
    "BATCH_SURFACES": E3D_BATCH_SURFACES,
    "MOST_COVERING": E3D_MOST_COVERING,
    "COVER_ROWS": E3D_COVER_ROWS,
    "SMALLS": E3D_SMALLS,
    "MOST_FRAGMENTS": E3D_MOST_FRAGMENTS,
    "BLOCK_FRAGMENTS": E3D_BLOCK_FRAGMENTS,
    "FRAGMENT_ID": E3D_FRAGMENT_ID,
    "MAX_LEVELS": E3D_MAX_LEVELS,
}


def plan_rules():
    """The rules of a frame's plan: (item, the items that it needs, those that it must not have).

    Each item is named, and has its meaning in asked_items() or planned_items().
    """
    cdef const e3d_plan_rule *rule
    asked, planned = asked_items(), planned_items()

    def names(items, bits):
        return [name for k, (name, _) in enumerate(items) if bits >> k & 1]

    rules = []
    for r in range(E3D_PLAN_RULE_COUNT):
        rule = &E3D_PLAN_RULES[r]
        needs = names(asked, rule.asked) + names(planned, rule.planned)
        forbids = names(asked, rule.unless_asked) + names(planned, rule.unless_planned)
        rules.append((planned[rule.item][0], needs, forbids))
    return rules


def asked_items():
    """What may be asked for, in the order of its bits: (name, meaning)."""
    return [(E3D_ASKED_WORDS[k].name.decode(), E3D_ASKED_WORDS[k].text.decode()) for k in range(E3D_ASKED_ITEMS)]


def planned_items():
    """What is planned, in the order of its bits: (name, meaning)."""
    return [(E3D_PLAN_WORDS[k].name.decode(), E3D_PLAN_WORDS[k].text.decode()) for k in range(E3D_PLAN_ITEMS)]


def dfg_table(int kind):
    """A table of albedos: `E3D_DFG_SIZE` rows of as many numbers."""
    return [[E3D_DFG_TABLE[kind][E3D_DFG_SIZE * i + j] for j in range(E3D_DFG_SIZE)] for i in range(E3D_DFG_SIZE)]


cdef class _KeptEnvironment:
    """An environment of pixels, which takes a hundred times as long to make as to look up."""

    cdef e3d_environment *environment
    cdef object pixels

    def __cinit__(self, const float[:, :, ::1] pixels):
        self.pixels = pixels.base
        if e3d_environment_create(&pixels[0, 0, 0], <int32_t>pixels.shape[1], <int32_t>pixels.shape[0], 1,
                                  &self.environment) != E3D_OK:
            raise MemoryError()

    def __dealloc__(self):
        e3d_environment_destroy(self.environment)


cdef _KeptEnvironment last_environment = None


cdef int fill_light(e3d_environment_light *light, const float[:, :, ::1] pixels, turn, float intensity) except -1:
    """Makes the environment, or takes the last one if it is of the same array, which must not have changed."""
    global last_environment
    if last_environment is None or last_environment.pixels is not pixels.base:
        last_environment = _KeptEnvironment(pixels)
    light.environment = last_environment.environment
    light.cosine, light.sine = turn
    light.intensity = intensity
    return 0


include "float_control.pxi"
include "kernel_arguments.pxi"
include "posing_reference.pxi"
include "mesh_clusters.pxi"


cdef class Kernels:
    """The kernels of one backend, by the number that `rasterizer.BACKENDS` gives it.

    Every method calls its kernel `rounds` times with the same arguments: once, unless a benchmark
    sets it otherwise.

    Raises
    ------
    LookupError
        This build or CPU has no such kernels.
    """

    cdef const e3d_kernels *table
    cdef public int rounds

    def __cinit__(self, int backend):
        self.rounds = 1
        self.table = e3d_kernels_for(<e3d_backend>backend)
        if self.table == NULL:
            raise LookupError("this build or CPU lacks the backend")

    def face_away(self, const uint8_t[::1] clusters, const uint8_t[::1] facing, int drop, const float[::1] clip,
                  const uint8_t[::1] viewport):
        """A bit for each cluster."""
        cdef uint32_t away = 0
        check_size(facing, sizeof(e3d_facing))
        check_size(viewport, sizeof(e3d_viewport))
        for _ in range(self.rounds):
            away = self.table.face_away(<const e3d_cluster *>&clusters[0], <int>(clusters.shape[0] // sizeof(e3d_cluster)),
                                        <const e3d_facing *>&facing[0], drop, &clip[0], <const e3d_viewport *>&viewport[0])
        return away

    def transform(self, const float[::1] positions, int stride, int count, const float[::1] matrix,
                  const uint8_t[::1] viewport, bint inside, uint8_t[::1] out):
        check_size(viewport, sizeof(e3d_viewport))
        check_size(out, sizeof(e3d_vertices))
        for _ in range(self.rounds):
            self.table.transform(&positions[0], stride, count, &matrix[0],
                                 <const e3d_viewport *>&viewport[0], inside,
                                 <e3d_vertices *>&out[0])

    def take_clip(self, const float[::1] positions, int stride, int count,
                  const uint8_t[::1] viewport, uint8_t[::1] out):
        check_size(viewport, sizeof(e3d_viewport))
        check_size(out, sizeof(e3d_vertices))
        for _ in range(self.rounds):
            self.table.take_clip(&positions[0], stride, count, <const e3d_viewport *>&viewport[0],
                                 <e3d_vertices *>&out[0])

    def setup(self, const uint8_t[::1] vertices, const uint8_t[::1] indices, int triangles, int cull,
              bint fragments, const uint8_t[::1] viewport, uint8_t[::1] out):
        """Returns how many survive."""
        cdef int count = 0
        check_size(vertices, sizeof(e3d_vertices))
        check_size(viewport, sizeof(e3d_viewport))
        check_size(out, sizeof(e3d_survivors))
        for _ in range(self.rounds):
            count = self.table.setup(<const e3d_vertices *>&vertices[0], &indices[0], triangles, cull,
                                     fragments, <const e3d_viewport *>&viewport[0],
                                     <e3d_survivors *>&out[0])
        return count

    def record(self, const uint8_t[::1] vertices, const uint8_t[::1] indices,
               const uint8_t[::1] triangles, int count, bint tiny, int cull, bint mirrored, uint32_t order,
               const int32_t[::1] faces, const uint8_t[::1] viewport, uint8_t[::1] out,
               uint8_t[::1] spans):
        """``out`` and ``spans`` have room for a cluster's triangles; returns how many are made."""
        cdef e3d_record_request request
        cdef int made = 0
        check_size(vertices, sizeof(e3d_vertices))
        check_size(viewport, sizeof(e3d_viewport))
        check_size(out, E3D_CLUSTER_TRIANGLES * sizeof(e3d_record))
        check_size(spans, E3D_CLUSTER_TRIANGLES * sizeof(e3d_tile_span))
        request.vertices = <const e3d_vertices *>&vertices[0]
        request.indices = &indices[0]
        request.triangles = &triangles[0]
        request.count = count
        request.tiny = tiny
        request.cull = cull
        request.mirrored = mirrored
        request.order = order
        request.faces = &faces[0]
        request.viewport = <const e3d_viewport *>&viewport[0]
        for _ in range(self.rounds):
            made = self.table.record(&request, <e3d_record *>&out[0], <e3d_tile_span *>&spans[0])
        return made

    def add_small(self, const uint8_t[::1] vertices, const uint8_t[::1] indices, uint64_t triangles,
                  int32_t first, int bits, uint8_t[::1] out):
        """With several rounds, to where ``out`` ends at first."""
        check_size(vertices, sizeof(e3d_vertices))
        check_size(indices, 3 * E3D_CLUSTER_TRIANGLES)
        check_size(out, sizeof(e3d_small_triangles))
        cdef e3d_small_triangles *to = <e3d_small_triangles *>&out[0]
        cdef int32_t count = to.count
        for _ in range(self.rounds):
            to.count = count
            self.table.add_small(<const e3d_vertices *>&vertices[0], &indices[0], triangles, first, bits, to)

    def fragments(self, const uint8_t[::1] triangles, const uint8_t[::1] viewport, int tiles_x,
                  uint8_t[::1] blocks, uint8_t[::1] bins, uint32_t count):
        """Of a copy of the triangles, to ``blocks`` of which ``count`` are in use; returns how many are then, the
        fragments and the triangles that have some."""
        cdef e3d_small_triangles taken
        cdef e3d_fragment_bins out
        check_size(triangles, sizeof(e3d_small_triangles))
        check_size(viewport, sizeof(e3d_viewport))
        cdef size_t tiles = <size_t>bins.shape[0] // sizeof(e3d_bin)
        out.blocks = <e3d_fragment_block *>&blocks[0]
        out.bins = <e3d_bin *>&bins[0]
        out.count = count
        for _ in range(self.rounds):
            if <size_t>blocks.shape[0] < (out.count + e3d_fragment_blocks_most(tiles)) * sizeof(e3d_fragment_block):
                raise ValueError(f"{blocks.shape[0]} bytes are too few for the blocks")
            taken = (<const e3d_small_triangles *>&triangles[0])[0]
            self.table.fragments(&taken, <const e3d_viewport *>&viewport[0], tiles_x, &out)
        return out.count, out.fragments, out.triangles

    def raster_depth(self, const uint8_t[::1] pieces, float[::1] z, int32_t[::1] slot,
                     const uint32_t[::1] orders):
        """Here and in the next three, one piece after the other."""
        raster(self.table.raster_depth, self.rounds, pieces, z, slot, orders)

    def raster_overwrite(self, const uint8_t[::1] pieces, float[::1] z, int32_t[::1] slot,
                         const uint32_t[::1] orders):
        raster(self.table.raster_overwrite, self.rounds, pieces, z, slot, orders)

    def raster_count(self, const uint8_t[::1] pieces, float[::1] z, int32_t[::1] slot,
                     const uint32_t[::1] orders):
        raster(self.table.raster_count, self.rounds, pieces, z, slot, orders)

    def raster_mark(self, const uint8_t[::1] pieces, float[::1] z, int32_t[::1] slot,
                    const uint32_t[::1] orders):
        raster(self.table.raster_mark, self.rounds, pieces, z, slot, orders)

    def raster_visible(self, uint8_t[::1] tile, const uint8_t[:, ::1] records,
                       const uint32_t[::1] ids, const uint8_t[:, ::1] drawn=None):
        """``records`` and ``drawn`` are (workers, bytes), a power of two of workers: the table of a frame."""
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        cdef const e3d_drawn_cluster *clusters[MOST_WORKERS]
        check_size(tile, sizeof(e3d_visible_tile))
        fill_table(&table, rows, records)
        fill_drawn(&table, clusters, drawn)
        for _ in range(self.rounds):
            self.table.raster_visible(<e3d_visible_tile *>&tile[0], &table, &ids[0],
                                      <int>ids.shape[0])

    def raster_fragments(self, uint8_t[::1] tile, const uint8_t[:, ::1] records,
                         const uint8_t[:, ::1] drawn, const uint8_t[::1] block):
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        cdef const e3d_drawn_cluster *clusters[MOST_WORKERS]
        check_size(tile, sizeof(e3d_visible_tile))
        check_size(block, sizeof(e3d_fragment_block))
        fill_table(&table, rows, records)
        fill_drawn(&table, clusters, drawn)
        for _ in range(self.rounds):
            self.table.raster_fragments(<e3d_visible_tile *>&tile[0], &table,
                                        <const e3d_fragment_block *>&block[0])

    def raster_settle(self, uint8_t[::1] tile, const uint8_t[:, ::1] records, bint depths=True):
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        check_size(tile, sizeof(e3d_visible_tile))
        fill_table(&table, rows, records)
        for _ in range(self.rounds):
            self.table.raster_settle(<e3d_visible_tile *>&tile[0], &table, depths)

    def raster_measure(self, uint8_t[::1] tile, float[:, ::1] columns):
        """``columns``: the farthest depth of each column of each block."""
        check_size(tile, sizeof(e3d_visible_tile))
        if columns.shape[0] != E3D_TILE_BLOCKS or columns.shape[1] != E3D_BLOCK:
            raise ValueError("columns must be (blocks, columns)")
        for _ in range(self.rounds):
            self.table.raster_measure(<e3d_visible_tile *>&tile[0],
                                      <float (*)[E3D_BLOCK]>&columns[0, 0])

    def find_runs(self, uint8_t[::1] tile, int width, int height, uint8_t[::1] out):
        """``out`` has room for as many runs as the tile has samples, and one; returns how many, and if there are gaps."""
        cdef int count = 0, gaps = 0
        check_size(tile, sizeof(e3d_visible_tile))
        check_size(out, (E3D_TILE_SAMPLES + 1) * sizeof(e3d_run))
        for _ in range(self.rounds):
            count = self.table.find_runs(<e3d_visible_tile *>&tile[0], width, height, <e3d_run *>&out[0], &gaps)
        return count, gaps != 0

    def show_records(self, const uint8_t[::1] tile, const uint8_t[:, ::1] records,
                     const uint32_t[::1] ids, uint8_t[::1] shown):
        """With several rounds, they are listed as often, one after the other."""
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        check_size(tile, sizeof(e3d_visible_tile))
        check_size(shown, sizeof(e3d_shown))
        fill_table(&table, rows, records)
        for _ in range(self.rounds):
            self.table.show_records(<const e3d_visible_tile *>&tile[0], &table, &ids[0], <int>ids.shape[0],
                                    <e3d_shown *>&shown[0])

    def show_fragments(self, const uint8_t[::1] tile, const uint8_t[::1] block, uint8_t[::1] shown):
        """With several rounds, they are listed as often, one after the other."""
        check_size(tile, sizeof(e3d_visible_tile))
        check_size(block, sizeof(e3d_fragment_block))
        check_size(shown, sizeof(e3d_shown))
        for _ in range(self.rounds):
            self.table.show_fragments(<const e3d_visible_tile *>&tile[0],
                                      <const e3d_fragment_block *>&block[0], <e3d_shown *>&shown[0])

    def cover_records(self, uint8_t[::1] cover, const uint8_t[:, ::1] records, const uint32_t[::1] ids,
                      uint8_t[::1] shown):
        """With several rounds, they meet themselves."""
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        cdef int fits = 1
        check_size(cover, sizeof(e3d_cover))
        check_size(shown, sizeof(e3d_shown))
        fill_table(&table, rows, records)
        for _ in range(self.rounds):
            fits &= self.table.cover_records(<e3d_cover *>&cover[0], &table, &ids[0], <int>ids.shape[0],
                                             <e3d_shown *>&shown[0])
        return fits != 0

    def show_alone(self, const uint8_t[::1] cover, uint8_t[::1] shown, uint16_t[::1] rest):
        """Returns how many are left; with several rounds, the others are listed as often."""
        cdef int left = 0
        check_size(cover, sizeof(e3d_cover))
        check_size(shown, sizeof(e3d_shown))
        if rest.shape[0] < E3D_MOST_COVERING:
            raise ValueError("rest must have room for all")
        for _ in range(self.rounds):
            left = self.table.show_alone(<const e3d_cover *>&cover[0], <e3d_shown *>&shown[0], &rest[0])
        return left

    def show_layers(self, const uint8_t[::1] cover, const uint8_t[:, ::1] records, const uint16_t[::1] numbers,
                    uint8_t[::1] layers, uint8_t[::1] shown):
        """Of what the records cover, which must be these; with several rounds, they are listed as often."""
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        cdef int sure = 1
        check_size(cover, sizeof(e3d_cover))
        check_size(layers, sizeof(e3d_layers))
        check_size(shown, sizeof(e3d_shown))
        fill_table(&table, rows, records)
        for _ in range(self.rounds):
            sure &= self.table.show_layers(<const e3d_cover *>&cover[0], &table, &numbers[0],
                                           <int>numbers.shape[0], <e3d_layers *>&layers[0], <e3d_shown *>&shown[0])
        return sure != 0

    def take_runs(self, const uint8_t[::1] shown, int first, int count, int32_t piece,
                  uint8_t[::1] batch):
        """Returns how many; with several rounds, the batch is filled further."""
        cdef int taken = 0
        check_size(shown, sizeof(e3d_shown))
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            taken = self.table.take_runs(<const e3d_shown *>&shown[0], first, count, piece,
                                         <e3d_batch *>&batch[0])
        return taken

    def take_shown(self, const uint8_t[::1] shown, int first, int count, int32_t piece,
                   uint8_t[::1] batch):
        """Returns how many; with several rounds, the batch is filled further."""
        cdef int taken = 0
        check_size(shown, sizeof(e3d_shown))
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            taken = self.table.take_shown(<const e3d_shown *>&shown[0], first, count, piece,
                                          <e3d_batch *>&batch[0])
        return taken

    def project(self, uint8_t[::1] surfaces, const uint8_t[::1] viewport):
        check_size(surfaces, sizeof(e3d_surfaces))
        check_size(viewport, sizeof(e3d_viewport))
        for _ in range(self.rounds):
            self.table.project(<e3d_surfaces *>&surfaces[0], <const e3d_viewport *>&viewport[0])

    def surface(self, uint8_t[::1] surfaces, int tile_x, int tile_y, int wanted):
        """In place: with several rounds, what was transformed is transformed again."""
        check_size(surfaces, sizeof(e3d_surfaces))
        for _ in range(self.rounds):
            self.table.surface(<e3d_surfaces *>&surfaces[0], tile_x, tile_y, wanted)

    def interpolate(self, uint8_t[::1] batch, const uint8_t[::1] surfaces, int wanted):
        check_size(batch, sizeof(e3d_batch))
        check_size(surfaces, sizeof(e3d_surfaces))
        for _ in range(self.rounds):
            self.table.interpolate(<e3d_batch *>&batch[0], <const e3d_surfaces *>&surfaces[0], wanted)

    def texture(self, uint8_t[::1] batch, const uint8_t[::1] texels, int channel_bits,
                const int32_t[:, ::1] sizes, int filter, wrap, const float[::1] base,
                int anisotropy=1, float level_scale=1.0, const uint8_t[::1] surfaces=None):
        """``texels``: the levels with their borders, and 16 bytes more. ``surfaces``: where ``anisotropy`` is more than 1."""
        cdef e3d_texture_view view = texture_view(texels, channel_bits, sizes, filter, wrap)
        cdef const e3d_surfaces *of = NULL
        check_size(batch, sizeof(e3d_batch))
        view.anisotropy, view.level_scale = anisotropy, level_scale
        if surfaces is not None:
            check_size(surfaces, sizeof(e3d_surfaces))
            of = <const e3d_surfaces *>&surfaces[0]
        elif anisotropy > 1:
            raise ValueError("an anisotropic texture needs surfaces")
        for _ in range(self.rounds):
            self.table.texture(<e3d_batch *>&batch[0], of, &view, &base[0])

    def tint(self, uint8_t[::1] batch, const uint8_t[::1] surfaces, bint by_vertex, bint by_instance):
        check_size(batch, sizeof(e3d_batch))
        check_size(surfaces, sizeof(e3d_surfaces))
        for _ in range(self.rounds):
            self.table.tint(<e3d_batch *>&batch[0], <const e3d_surfaces *>&surfaces[0], by_vertex,
                            by_instance)

    def light(self, uint8_t[::1] batch, const uint8_t[::1] lights, const float[:, ::1] reach,
              const float[::1] ambient, const float[::1] clamp, const float[::1] eye,
              float shininess, const uint8_t[::1] shadow_maps=None):
        """``reach``: (5, lights + PAD); ``shadow_maps``: those of all lights, or None."""
        cdef e3d_lighting lighting = lighting_of(lights, reach, ambient, clamp, eye)
        if shadow_maps is not None:
            lighting.shadows = <const e3d_shadow_map *>&shadow_maps[0]
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            self.table.light(<e3d_batch *>&batch[0], &lighting, shininess)

    def combine(self, uint8_t[::1] batch, const float[::1] specular, const float[::1] emissive,
                float exposure=1.0):
        """``specular`` may be None."""
        cdef const float *highlight = NULL
        check_size(batch, sizeof(e3d_batch))
        if specular is not None:
            highlight = &specular[0]
        for _ in range(self.rounds):
            self.table.combine(<e3d_batch *>&batch[0], highlight, &emissive[0], exposure)

    def physical(self, uint8_t[::1] batch, dict model, const uint8_t[::1] lights,
                 const float[:, ::1] reach, const float[::1] ambient, const float[::1] eye,
                 uint8_t[::1] maps):
        """``model``: arrays of float32 by name; the coat's normals are in ``maps``."""
        cdef float[::1] clamp = array("f", (0.0, INFINITY))
        cdef e3d_lighting lighting = lighting_of(lights, reach, ambient, clamp, eye)
        cdef e3d_surface_model surface = model_of(model)
        check_size(batch, sizeof(e3d_batch))
        check_size(maps, sizeof(e3d_map_batch))
        for _ in range(self.rounds):
            self.table.physical(<e3d_batch *>&batch[0], &surface, &lighting, <e3d_map_batch *>&maps[0])

    def environment(self, const float[:, :, ::1] pixels, turn, float intensity, const float[:, ::1] direction,
                    const float[::1] level, int count, float[:, ::1] color):
        """Of an environment made of pixels; ``direction`` and ``color`` are three planes with a pad."""
        cdef e3d_environment_light light
        cdef const float *directions[3]
        cdef float *colors[3]
        fill_light(&light, pixels, turn, intensity)
        for k in range(3):
            directions[k], colors[k] = &direction[k, 0], &color[k, 0]
        for _ in range(self.rounds):
            self.table.environment(&light, directions, &level[0], count, colors)

    def irradiance(self, const float[:, :, ::1] pixels, turn, float intensity, const float[:, ::1] normal,
                   int count, float[:, ::1] color):
        cdef e3d_environment_light light
        cdef const float *normals[3]
        cdef float *colors[3]
        fill_light(&light, pixels, turn, intensity)
        for k in range(3):
            normals[k], colors[k] = &normal[k, 0], &color[k, 0]
        for _ in range(self.rounds):
            self.table.irradiance(&light, normals, count, colors)

    def backdrop(self, const float[:, :, ::1] pixels, turn, float intensity, float level, const float[:, ::1] rays,
                 int x, int y, int count, float[:, ::1] color):
        """``rays``: the corner's, and what a pixel adds along the row and down the column."""
        cdef e3d_backdrop backdrop
        cdef float *colors[3]
        fill_light(&backdrop.light, pixels, turn, intensity)
        backdrop.level = level
        for k in range(3):
            backdrop.ray[k], backdrop.across[k], backdrop.down[k] = rays[0, k], rays[1, k], rays[2, k]
            colors[k] = &color[k, 0]
        for _ in range(self.rounds):
            self.table.backdrop(&backdrop, x, y, count, colors)

    def albedo(self, int kind, const float[::1] roughness, const float[::1] cosine, int count, float[::1] out):
        """``kind``: A, B or the sheen's."""
        for _ in range(self.rounds):
            self.table.albedo(<e3d_dfg>kind, &roughness[0], &cosine[0], count, &out[0])

    def lobe(self, const uint8_t[::1] group, uint8_t[::1] block):
        check_size(group, sizeof(e3d_cell_group))
        check_size(block, sizeof(e3d_lobe_block))
        for _ in range(self.rounds):
            self.table.lobe(<const e3d_cell_group *>&group[0], <e3d_lobe_block *>&block[0])

    def fog(self, fog, const float[:, ::1] position, int count, float[:, ::1] color):
        """``fog``: as for `fog_view`; the others: (3, count + PAD). Colours are changed in place."""
        cdef e3d_fog_view view = fog_view(fog)
        cdef const float *positions[3]
        cdef float *colors[3]
        for k in range(3):
            positions[k], colors[k] = &position[k, 0], &color[k, 0]
        for _ in range(self.rounds):
            self.table.fog(&view, positions, count, colors)

    def tone(self, int mapping, float[:, ::1] color, int count):
        """``color``: (3, count + PAD), changed in place."""
        cdef float *planes[3]
        for k in range(3):
            planes[k] = &color[k, 0]
        for _ in range(self.rounds):
            self.table.tone(<e3d_tone_mapping>mapping, planes, count)

    def encode(self, const float[::1] red, const float[::1] green, const float[::1] blue, int count,
               bint srgb, uint32_t[::1] rgba):
        for _ in range(self.rounds):
            self.table.encode(&red[0], &green[0], &blue[0], count, srgb, &rgba[0])

    def put(self, const uint8_t[::1] batch, bint srgb, uint32_t[::1] rgba):
        """``rgba`` has E3D_TILE * E3D_TILE + PAD elements."""
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            self.table.put(<const e3d_batch *>&batch[0], srgb, &rgba[0])

    def keep(self, const uint8_t[::1] batch, float[:, ::1] samples):
        """``samples``: (4, E3D_TILE * E3D_TILE + PAD)."""
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            self.table.keep(<const e3d_batch *>&batch[0], samples_of(samples))

    def raster_alpha(self, const uint8_t[::1] piece, const uint8_t[:, ::1] records, const float[::1] limit,
                     const int32_t[::1] kept, uint8_t[::1] shown, float[::1] z):
        """Adds to what is shown; returns the row that comes next, and whether a sample came again."""
        cdef e3d_record_table table
        cdef const e3d_record *rows[MOST_WORKERS]
        cdef e3d_alpha_list listed
        cdef int32_t row = 0
        check_size(piece, sizeof(e3d_piece))
        check_size(shown, sizeof(e3d_shown))
        fill_table(&table, rows, records)
        memset(&listed, 0, sizeof(listed))
        listed.limit, listed.kept, listed.z = &limit[0], &kept[0], &z[0]
        listed.shown = <e3d_shown *>&shown[0]
        for _ in range(self.rounds):
            row = self.table.raster_alpha(<const e3d_piece *>&piece[0], &table, &listed)
        return row, listed.met != 0

    def alpha(self, uint8_t[::1] batch, const uint8_t[::1] surfaces, texture, float base, bint by_vertex, bint by_instance):
        """``texture``: None, or what `texture` takes, as a tuple, and whether every alpha is 255."""
        cdef e3d_varying varying
        varying.lanes = NULL
        varying.factor = base
        cdef e3d_texture_view view
        check_size(batch, sizeof(e3d_batch))
        check_size(surfaces, sizeof(e3d_surfaces))
        if texture is not None:
            texels, channel_bits, sizes, filter, wrap, opaque = texture
            view = texture_view(texels, channel_bits, sizes, filter, wrap)
            view.is_opaque = opaque
        for _ in range(self.rounds):
            self.table.alpha(<e3d_batch *>&batch[0], <const e3d_surfaces *>&surfaces[0],
                             NULL if texture is None else &view, &varying, by_vertex, by_instance)

    def lay(self, const uint8_t[::1] batch, float[:, ::1] samples):
        """``samples``: as for `keep`."""
        check_size(batch, sizeof(e3d_batch))
        for _ in range(self.rounds):
            self.table.lay(<const e3d_batch *>&batch[0], samples_of(samples))

    def lay_through(self, const uint8_t[::1] batch, const uint8_t[::1] maps, float[:, ::1] samples):
        """``samples``: as for `keep`; ``maps``: what shares of light pass."""
        check_size(batch, sizeof(e3d_batch))
        check_size(maps, sizeof(e3d_map_batch))
        for _ in range(self.rounds):
            self.table.lay_through(<const e3d_batch *>&batch[0], <const e3d_map_batch *>&maps[0], samples_of(samples))

    def blend(self, const uint32_t[::1] first, const int32_t[::1] depth, const uint32_t[::1] which,
              const float[:, ::1] color, float[:, ::1] samples, uint16_t[::1] left,
              const float[:, ::1] through=None, const float[:, ::1] light=None, float[:, ::1] lit=None, int axis=1):
        """Returns how many samples are left, which are listed. ``through`` and ``light`` are like ``color``, or None; ``lit``
        is the radiance of the tile's pixels, of axis * axis samples each."""
        cdef e3d_alpha_layers layers
        cdef int count = 0
        if first.shape[0] != E3D_TILE_SAMPLES + 1 or left.shape[0] != E3D_TILE_SAMPLES or color.shape[1] != 4:
            raise ValueError("first and left are of a tile's samples, colours have four numbers")
        layers.first, layers.depth, layers.which = &first[0], &depth[0], &which[0]
        layers.color = <const four_floats *>&color[0, 0]
        layers.through = NULL if through is None else <const four_floats *>&through[0, 0]
        layers.light = NULL if light is None else <const four_floats *>&light[0, 0]
        layers.lit, layers.axis = NULL if lit is None else <three_floats *>&lit[0, 0], axis
        if light is not None and (lit is None or lit.shape[0] != E3D_TILE_SAMPLES or lit.shape[1] != 3):
            raise ValueError("light goes to the pixels of a tile, of three numbers each")
        for _ in range(self.rounds):
            count = self.table.blend(&layers, samples_of(samples), &left[0])
        return count

    def average(self, float[:, ::1] samples, int axis, int row, int width,
                const float[::1] background, bint srgb, uint32_t[::1] rgba):
        """``samples``: as for `keep`; ``rgba`` has width + PAD elements."""
        for _ in range(self.rounds):
            self.table.average(samples_of(samples), axis, row, width, &background[0], srgb, &rgba[0])

    def paint(self, uint8_t[::1] batch, const uint8_t[::1] surfaces, int wanted, texture,
              const float[::1] base, bint by_vertex, bint by_instance, lighting, float shininess,
              const float[::1] specular, const float[::1] emissive, bint srgb, uint32_t[::1] rgba,
              float[:, ::1] samples=None, fog=None, int tone=0):
        """``texture`` and ``lighting``: None, or what `texture` and `light` take, as a tuple.
        ``specular`` and ``emissive`` may be None, too; ``rgba`` has E3D_TILE * E3D_TILE + PAD elements. ``samples``,
        as for `keep`: these are written instead. ``fog``: None, or as for `fog`.
        """
        cdef e3d_paint paint
        cdef e3d_fog_view mist
        cdef e3d_texture_view view
        cdef e3d_lighting lights
        check_size(batch, sizeof(e3d_batch))
        check_size(surfaces, sizeof(e3d_surfaces))
        if texture is not None:
            texels, channel_bits, sizes, filter, wrap = texture
            view = texture_view(texels, channel_bits, sizes, filter, wrap)
        if lighting is not None:
            of, reach, ambient, clamp, eye = lighting
            lights = lighting_of(of, reach, ambient, clamp, eye)
        paint.wanted = wanted
        paint.texture = NULL if texture is None else &view
        paint.base = &base[0]
        paint.by_vertex = by_vertex
        paint.by_instance = by_instance
        paint.lighting = NULL if lighting is None else &lights
        paint.shininess = shininess
        paint.specular = NULL if specular is None else &specular[0]
        paint.emissive = NULL if emissive is None else &emissive[0]
        paint.srgb = srgb
        paint.samples = NULL if samples is None else samples_of(samples)
        if fog is not None:
            mist = fog_view(fog)
        paint.fog = NULL if fog is None else &mist
        paint.tone = <e3d_tone_mapping>tone
        for _ in range(self.rounds):
            self.table.paint(<e3d_batch *>&batch[0], <const e3d_surfaces *>&surfaces[0],
                             &paint, &rgba[0])

    def stream(self, uint8_t[::1] to, size_t pitch, const uint8_t[::1] source, size_t step, size_t size, int count):
        """``count`` rows of ``size`` bytes, ``step`` bytes apart; they arrive ``pitch`` bytes apart."""
        cdef e3d_pixel_rows rows = rows_of(to, pitch, source, step, size, count)
        for _ in range(self.rounds):
            self.table.stream(&rows)


def jobs_alone(const double[:, ::1] rates, int64_t passed, uint8_t[::1] alone):
    """Tell which jobs are done without helpers, if each takes so many nanoseconds.

    rates: (n, 3), what a job gets of the CPUs with helpers, what its caller does who waits for them half of the time, and
    what it does alone; alone: (n,).
    """
    cdef e3d_helping helping
    cdef e3d_job_times job
    memset(&helping, 0, sizeof(helping))
    for i in range(alone.shape[0]):
        alone[i] = helping.alone
        job.passed = passed
        job.working = passed if helping.alone else passed // 2
        job.all = <int64_t>(rates[i, 2 * helping.alone] * passed)
        job.own = job.all if helping.alone else <int64_t>(rates[i, 1] * job.working)
        e3d_helping_note(&helping, &job, (i + 1) * passed)
