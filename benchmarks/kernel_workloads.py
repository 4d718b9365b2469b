"""Calls of single kernels to measure, made from fixed random numbers.

In:  a `Kernels` object of tests/kernels/, with `rounds` calls at a time.
Out: KERNEL_WORKLOADS, name -> (unit, maker); a maker returns (elements a round, function), and the
     function takes a Kernels object and makes its rounds.

The layouts of the kernels' structs, and what is said of triangles, are those of the tests.
"""

import sys
from pathlib import Path

import numpy as np

from engine3d._native.rasterizer import FILTERS, WRAPS

sys.path.append(str(Path(__file__).resolve().parents[1] / "tests"))
from kernels.kernels import record_table
from kernels.layouts import (
    BATCH,
    BATCH_RECORD,
    CLUSTER_TRIANGLES,
    CLUSTER_VERTICES,
    LIGHT,
    PAD,
    RECORD,
    RUN,
    SURFACES,
    SURVIVORS,
    TILE,
    TILE_RECT,
    VERTICES,
    VISIBLE_TILE,
    viewport_of,
)
from kernels.pieces import Triangle, meta_of, plane_through

LANES = BATCH + PAD
COLORS = 4096
BEYOND_FAR = np.float32(1.0000001)


def transform():
    rng = np.random.default_rng(0)
    positions = rng.uniform(-1, 1, 3 * CLUSTER_VERTICES).astype(np.float32)
    matrix = np.array([1, 0.1, 0, 0, 0, 1, 0.2, 0, 0, 0, 1, 2, 0, 0.1, 1, 4], np.float32)
    viewport, out = viewport_of(1280, 720).view(np.uint8), np.zeros(1, VERTICES).view(np.uint8)
    arguments = (positions, CLUSTER_VERTICES, CLUSTER_VERTICES, matrix, viewport, False, out)
    return CLUSTER_VERTICES, lambda kernels: kernels.transform(*arguments)


def setup():
    """Small triangles, half of which look away."""
    rng = np.random.default_rng(1)
    vertices = np.zeros(1, VERTICES)
    vertices["count"] = CLUSTER_VERTICES
    for name, side in (("sx", 1280), ("sy", 720)):
        vertices[name] = 128 * side + rng.integers(-2000, 2000, CLUSTER_VERTICES)
    indices = rng.integers(0, CLUSTER_VERTICES, 3 * CLUSTER_TRIANGLES, np.uint8)
    viewport, out = viewport_of(1280, 720).view(np.uint8), np.zeros(1, SURVIVORS).view(np.uint8)
    arguments = (vertices.view(np.uint8), indices, CLUSTER_TRIANGLES, 1, True, viewport, out)
    return CLUSTER_TRIANGLES, lambda kernels: kernels.setup(*arguments)


def record():
    """What setup leaves of a cluster: triangles of a few samples, of which every other is tiny."""
    rng = np.random.default_rng(6)
    vertices = np.zeros(1, VERTICES)
    vertices["zn"], vertices["iw"] = rng.uniform(0, 1, (2, 1, CLUSTER_VERTICES))
    vertices["count"] = CLUSTER_VERTICES
    spread = np.repeat([200, 1500], CLUSTER_VERTICES // 2)
    for name, side in (("sx", 1280), ("sy", 720)):
        vertices[name] = 128 * side + rng.integers(-spread, spread)
    indices = rng.integers(0, CLUSTER_VERTICES // 2, (3, CLUSTER_TRIANGLES), np.uint8)
    indices[:, 1::2] += CLUSTER_VERTICES // 2
    triangles = np.arange(CLUSTER_TRIANGLES + PAD, dtype=np.uint8) % CLUSTER_TRIANGLES
    faces = np.arange(CLUSTER_TRIANGLES, dtype=np.int32)
    out = np.zeros(CLUSTER_TRIANGLES, RECORD).view(np.uint8)
    spans = np.zeros(CLUSTER_TRIANGLES, TILE_RECT).view(np.uint8)
    asked = (triangles, CLUSTER_TRIANGLES, True, 0, False, 0, faces)
    viewport = viewport_of(1280, 720).view(np.uint8)
    arguments = (vertices.view(np.uint8), indices.ravel(), *asked, viewport, out, spans)
    return CLUSTER_TRIANGLES, lambda kernels: kernels.record(*arguments)


def random_record(rng, extent, least):
    """A triangle of about `extent` samples somewhere in a tile, and how many it covers."""
    rows, columns = np.mgrid[0:TILE, 0:TILE]
    while True:
        centre = rng.uniform(0, TILE, 2)
        corners = (256 * (centre + rng.uniform(-extent, extent, (3, 2)))).astype(np.int64)
        triangle = Triangle(corners[:, 0], corners[:, 1], TILE, TILE)
        meta = None if triangle.empty else meta_of(triangle)
        covered = int(triangle.covers(columns, rows).sum())
        if meta is not None and covered >= least:
            break
    made, zn = np.zeros(1, RECORD), rng.random(3, np.float32)
    made["x"], made["y"], made["meta"] = triangle.x, triangle.y, meta
    made["z0"], made["gx"], made["gy"] = plane_through(triangle, zn)
    made["zmin"], made["zmax"] = zn.min(), zn.max()
    return made, covered


def empty_tile():
    """A tile of which nothing is written, at a cache line as in a frame."""
    room = np.zeros(VISIBLE_TILE.itemsize + 64, np.uint8)
    start = -room.ctypes.data % 64
    tile = room[start : start + VISIBLE_TILE.itemsize]
    fields = tile.view(VISIBLE_TILE)
    fields["zmin"] = fields["zmax"] = BEYOND_FAR
    fields["noted_id"], fields["noted"] = -1, 2**64 - 1
    return tile


def visible(extent, least, count, counted):
    """Triangles over each other in a tile that is empty first; `counted` are the elements."""
    rng = np.random.default_rng(2)
    made = [random_record(rng, extent, least) for _ in range(count)]
    records = np.concatenate([row for row, _ in made])
    records["order"] = np.arange(count)
    table = record_table(records.view(np.uint8)[None])
    ids = np.arange(count + PAD, dtype=np.uint32)
    tile = empty_tile()
    blocks = VISIBLE_TILE.fields["zmin"][1]  # where what is known of blocks begins
    empty = tile[blocks:].copy()

    def run(kernels):
        draw = kernels.prepared("raster_visible", tile, table, ids, count)
        settle = kernels.prepared("raster_settle", tile, table, True)
        for _ in range(kernels.rounds):
            tile[blocks:] = empty
            draw()
            settle()

    covered = sum(samples for _, samples in made)
    return (covered if counted == "samples" else count), run


def find_runs():
    rng = np.random.default_rng(3)
    tile, out = np.zeros(1, VISIBLE_TILE), np.zeros(TILE * TILE + 1, RUN).view(np.uint8)
    tile["id"] = np.repeat(rng.integers(-1, 9, 700), 6)[: TILE * TILE + PAD]
    tile = tile.view(np.uint8)
    return TILE * TILE, lambda kernels: kernels.find_runs(tile, TILE, TILE, out)


def shading_inputs():
    """A full batch of samples in runs of 16, and its surfaces."""
    rng = np.random.default_rng(4)
    surfaces = np.zeros(1, SURFACES)
    for name in ("p", "position", "normal", "uv", "color", "instance_color"):
        surfaces[name] = rng.uniform(0.1, 1, surfaces[name].shape)
    for name in ("px", "py"):
        surfaces[name] = rng.uniform(-1e-3, 1e-3, surfaces[name].shape)
    batch = np.zeros(1, BATCH_RECORD)
    batch["count"] = BATCH
    batch["sample"] = np.arange(LANES)
    batch["surface"] = np.arange(LANES) // 16  # 16 surfaces and the pad
    for name in ("weight", "position", "normal", "uv", "energy", "shine"):
        batch[name] = rng.uniform(0.05, 1, batch[name].shape)
    batch["r"] = batch["color"] = 1
    return rng, batch.view(np.uint8), surfaces.view(np.uint8)


def interpolate():
    _, batch, surfaces = shading_inputs()
    return BATCH, lambda kernels: kernels.interpolate(batch, surfaces, 7)


def textured(filter_name):
    """Rough noise, read along a line as surfaces do."""
    rng, batch, _ = shading_inputs()
    sizes = np.array([(256, 256), (128, 128), (64, 64)], np.int32)
    texels = rng.integers(0, 2**15, 4 * 258 * 258 * 2, np.uint16).view(np.uint8)
    fields = batch.view(BATCH_RECORD)
    fields["uv"][0] = np.linspace(0.1, 1.3, LANES) + np.array([[0], [0.4]])
    fields["lod"] = rng.integers(0, 512, LANES)
    levels = sizes if filter_name == "trilinear" else sizes[:1]
    wraps = (WRAPS["repeat"], WRAPS["repeat"])
    arguments = (texels, 16, levels, FILTERS[filter_name], wraps, np.ones(3, np.float32))
    return BATCH, lambda kernels: kernels.texture(batch, *arguments)


def light():
    rng, batch, _ = shading_inputs()
    lights = np.zeros(3, LIGHT)
    lights["kind"] = [0, 1, 1]
    lights["color"], lights["range"] = 0.5, 100
    lights["to_light"] = (0.36, 0.48, 0.8)
    lights["position"] = rng.uniform(-4, 4, (3, 3))
    ambient, clamp = np.full(3, 0.1, np.float32), np.array([0, np.inf], np.float32)
    reach = np.full((5, 3 + PAD), np.nan, np.float32)  # none is out of it
    eye = np.float32([0, 0, 5, 1])
    arguments = (batch, lights.view(np.uint8), reach, ambient, clamp, eye, 32.0)
    return BATCH, lambda kernels: kernels.light(*arguments)


def encode():
    rng = np.random.default_rng(5)
    planes = [rng.random(COLORS + PAD, np.float32) for _ in range(3)]
    rgba = np.empty(COLORS + PAD, np.uint32)
    return COLORS, lambda kernels: kernels.encode(*planes, COLORS, True, rgba)


KERNEL_WORKLOADS = {
    "transform": ("vertex", transform),
    "setup": ("triangle", setup),
    "record": ("triangle", record),
    "visible, whole tiles": ("sample", lambda: visible(4000.0, TILE * TILE, 100, "samples")),
    "visible, big triangles": ("sample", lambda: visible(64.0, 400, 300, "samples")),
    "visible, small triangles": ("triangle", lambda: visible(4.0, 0, 2000, "triangles")),
    "visible, tiny triangles": ("triangle", lambda: visible(1.0, 1, 2000, "triangles")),
    "runs": ("sample", find_runs),
    "interpolate": ("sample", interpolate),
    "texture, bilinear": ("sample", lambda: textured("bilinear")),
    "texture, trilinear": ("sample", lambda: textured("trilinear")),
    "light, 3 lights": ("sample", light),
    "encode": ("pixel", encode),
}
