"""The C structs of csrc/kernels/types/ as NumPy record types, field by field."""

import numpy as np

from engine3d._native.rasterizer import TEXTURE_SLOTS

try:
    from engine3d._native import kernels_testing
except ImportError:
    import pytest  # which benchmarks do without

    built = 'it is built in place only: pip install -e ".[test]"'
    pytest.skip(built, allow_module_level=True)

PAD = kernels_testing.LIMITS["PAD"]
TILE = kernels_testing.LIMITS["TILE"]
BLOCK = 8  # samples a side of what has depth bounds of its own
CLUSTER_TRIANGLES = kernels_testing.LIMITS["CLUSTER_TRIANGLES"]
CLUSTER_VERTICES = kernels_testing.LIMITS["CLUSTER_VERTICES"]
BATCH = kernels_testing.LIMITS["BATCH"]
SMALLS = kernels_testing.LIMITS["SMALLS"]
MOST_FRAGMENTS = kernels_testing.LIMITS["MOST_FRAGMENTS"]
BLOCK_FRAGMENTS = kernels_testing.LIMITS["BLOCK_FRAGMENTS"]
MOST_COVERING = kernels_testing.LIMITS["MOST_COVERING"]
COVER_ROWS = kernels_testing.LIMITS["COVER_ROWS"]
FRAGMENT_ID = kernels_testing.LIMITS["FRAGMENT_ID"]
BATCH_SURFACES = kernels_testing.LIMITS["BATCH_SURFACES"]

# Outcodes (R4, R5, R8).
NEAR, FAR, LEFT, RIGHT, BOTTOM, TOP = 1, 2, 4, 8, 16, 32
OUTSIDE, BEHIND, BEYOND_GUARD, NONFINITE, BAD_SCREEN = 63, 64, 128, 256, 512
NEEDS_CLIPPING = NEAR | BEHIND | BEYOND_GUARD

# Flags of a record, and where the number of its corners or its cover begins.
RECORD_BACK, RECORD_SWAPPED, RECORD_CUT, RECORD_FACE, RECORD_TINY = 1, 2, 4, 8, 16
RECORD_SHIFT = 5

# What interpolation is asked for.
WANT_POSITION, WANT_NORMAL, WANT_UV, WANT_FLAT, WANT_LEVEL = 1, 2, 4, 8, 16
WANT_SURFACE, WANT_WEIGHTS, WANT_FACET = 32, 64, 512

VIEWPORT = np.dtype(
    [
        ("width", "i4"),
        ("height", "i4"),
        ("scale_x", "f4"),
        ("scale_y", "f4"),
        ("guard_x", "f4"),
        ("guard_y", "f4"),
        ("reach", "i4"),
        ("unused", "i4"),
        ("pattern", "u8"),  # an address, or 0
    ]
)
CLUSTER = np.dtype(
    [("positions", "u8"), ("first", "i4")]
    + [(name, "u1") for name in ("triangles", "vertices", "stride", "any_finite")]
    + [(name, "f4", 3) for name in ("lo", "hi", "axis")]
    + [(name, "f4") for name in ("cosine", "altitude", "radius")]
)
FACING = np.dtype([("eye", "f4", 3), ("sign", "i4"), ("length", "f4", 4), ("scale", "f4")])
VERTICES = np.dtype(
    [(name, "f4", CLUSTER_VERTICES) for name in ("x", "y", "z", "w", "iw", "zn")]
    + [(name, "i4", CLUSTER_VERTICES) for name in ("sx", "sy", "code")]
    + [("count", "i4"), ("special", "i4"), ("unused", "i4", 14)]
)
SURVIVORS = np.dtype([("draw", "u8"), ("small", "u8"), ("clip", "u8")])
RECORD = np.dtype(
    [("x", "i4", 3), ("y", "i4", 3)]
    + [(name, "f4") for name in ("z0", "gx", "gy", "zmin", "zmax")]
    + [("iw", "f4", 3), ("order", "u4"), ("meta", "u4")]
)
TILE_SPAN = np.dtype([("first", "u4"), ("last", "u4")])
SMALL_TRIANGLES = np.dtype(
    [("x", "i4", (3, SMALLS + PAD)), ("y", "i4", (3, SMALLS + PAD)), ("id", "i4", SMALLS + PAD)]
    + [("zn", "f4", (3, SMALLS + PAD)), ("count", "i4")]
)
BIN = np.dtype([("first", "u4"), ("last", "u4")])
FRAGMENT_BLOCK = np.dtype(
    [("next", "u4"), ("count", "u4"), ("z", "f4", BLOCK_FRAGMENTS), ("id", "i4", BLOCK_FRAGMENTS)]
    + [("sample", "u2", BLOCK_FRAGMENTS), ("unused", "u2")]
)
DRAWN_CLUSTER = np.dtype(
    [("faces", "u8"), ("order", "u4"), ("instance", "i4"), ("draw", "i4"), ("mirrored", "i4")]
)
PIECE = np.dtype(
    [("e", "i4", 3), ("a", "i4", 3), ("b", "i4", 3)]
    + [(name, "i4") for name in ("x0", "y0", "x1", "y1")]
    + [(name, "f4") for name in ("z0", "gx", "gy", "zmin", "zmax")]
    + [("base_x", "i4"), ("base_y", "i4"), ("slot", "u4"), ("order", "u4")]
)
_BLOCKS = (TILE // BLOCK) ** 2
VISIBLE_TILE = np.dtype(
    [("z", "f4", TILE * TILE + PAD), ("id", "i4", TILE * TILE + PAD)]
    + [("zmin", "f4", _BLOCKS), ("zmax", "f4", _BLOCKS), ("noted_id", "i4", _BLOCKS)]
    + [("noted", "u8"), ("stale", "u8"), ("x", "i4"), ("y", "i4"), ("unused", "i4", 10)]
)
RUN = np.dtype([("owner", "i4"), ("sample", "u2"), ("length", "u2")])
SHOWN_ROOM = TILE * TILE + TILE
SHOWN = np.dtype(
    [("sample", "i4", SHOWN_ROOM + 2 * PAD), ("of", "i4", SHOWN_ROOM + 2 * PAD)]
    + [("piece", [("id", "u4"), ("first", "i4")], SHOWN_ROOM + 1)]
    + [(name, "i4") for name in ("count", "pieces", "runs", "unused")]
    + [("pattern", "u8")]
)
RUN_LENGTH = 16  # of a run in that list: the bit that its length begins at
COVERING = np.dtype([("record", "u8"), ("id", "u4"), ("y0", "i4"), ("y1", "i4"), ("at", "i4")])
COVER = np.dtype(
    [(name, "i4") for name in ("x", "y", "width", "height", "count", "used")]
    + [("once", "u8", TILE + PAD), ("twice", "u8", TILE + PAD)]
    + [("record", COVERING, MOST_COVERING), ("span", "i4", COVER_ROWS + PAD)]
)
LAYERS = np.dtype(
    [("covered", "u8", TILE + PAD), ("hidden", "u8", TILE + PAD), ("left", "u8", COVER_ROWS + PAD)]
    + [("open", [("zmax", "f4"), ("number", "i4")], MOST_COVERING)]
    + [("opened", "i4"), ("contested", "i4"), ("taken", "i4"), ("unused", "i4")]
)
_ELEMENTS = BATCH_SURFACES + PAD
SURFACES = np.dtype(
    [("project", "i4", _ELEMENTS)]
    + [("x", "i4", (3, _ELEMENTS)), ("y", "i4", (3, _ELEMENTS)), ("iw", "f4", (3, _ELEMENTS))]
    + [("swapped", "i4", _ELEMENTS), ("matrix", "i4", _ELEMENTS)]
    + [("clip", "f4", (16, _ELEMENTS)), ("world", "f4", (12, _ELEMENTS))]
    + [("normals", "f4", (9, _ELEMENTS))]
    + [("position", "f4", (3, 3, _ELEMENTS)), ("normal", "f4", (3, 3, _ELEMENTS))]
    + [("uv", "f4", (2, 3, _ELEMENTS)), ("color", "f4", (3, 3, _ELEMENTS))]
    + [("instance_color", "f4", (3, _ELEMENTS))]
    + [("alpha", "f4", (3, _ELEMENTS)), ("instance_alpha", "f4", _ELEMENTS)]
    + [("back", "i4", _ELEMENTS)]
    + [(name, "f4", (3, _ELEMENTS)) for name in ("p", "px", "py")]
    + [("base_x", "f4", _ELEMENTS), ("base_y", "f4", _ELEMENTS)]
    + [("slope", "f4", (2, 3, _ELEMENTS))]
    + [("not_read", "i4", (2, _ELEMENTS))]  # identities
    + [(name, "i4") for name in ("count", "matrices", "irregular", "projected")]
    + [("texels", "f4", 2), ("reach", "i4")]
)
_LANES = BATCH + PAD
BATCH_RECORD = np.dtype(
    [
        ("sample", "i4", _LANES),
        ("surface", "i4", _LANES),
        ("steps", "i4", _LANES),
        ("weight", "f4", (3, _LANES)),
        ("r", "f4", _LANES),
        ("position", "f4", (3, _LANES)),
        ("normal", "f4", (3, _LANES)),
        ("uv", "f4", (2, _LANES)),
        ("color", "f4", (3, _LANES)),
        ("place", "f4", (3, _LANES)),
        ("lod", "i4", _LANES),
        ("energy", "f4", (3, _LANES)),
        ("shine", "f4", (3, _LANES)),
        ("alpha", "f4", _LANES),
        ("hidden_lights", "u4", _LANES),
        ("visibility", "f4", _LANES),
        ("reached", "f4", (2, _LANES)),
        ("sun", "i4", 2),
        ("count", "i4"),
        ("facets", "i4"),
        ("unmapped_normal", "u8"),  # an address, or 0
        ("pattern", "u8"),  # likewise
        ("number", "i4", _LANES),
        ("shift", "f4", (2, _LANES)),
    ],
    align=True,
)
_PLACES, _SLOTS = len(TEXTURE_SLOTS) + 1, len(TEXTURE_SLOTS)
MAP_BATCH = np.dtype(
    [("uv", "f4", (_PLACES, 2, _LANES)), ("lod", "i4", (_PLACES, _LANES))]
    + [("texel", "f4", (_SLOTS, 4, _LANES)), ("tangent", "f4", (4, _LANES))]
    + [("shading_normal", "f4", (3, _LANES)), ("coat_normal", "f4", (3, _LANES))]
    + [("metallic_roughness", "f4", (2, _LANES)), ("emissive", "f4", (3, _LANES))]
    + [("direct", "f4", (3, _LANES)), ("coat", "f4", (3, _LANES)), ("fuzz", "f4", (3, _LANES))]
    + [("depth", "f4", _LANES), ("through", "f4", (3, _LANES))]
)
LIGHT_MAPS = np.dtype(
    [
        ("first", "i4"),
        ("count", "i4"),
        ("size", "i4"),
        ("taps", "i4"),
        ("bias", "f4"),
        ("normal_bias", "f4"),
        ("step", "i4"),
        ("margin", "f4"),
        ("axes", "f4", (3, 3)),
        ("depth", "f4", 2),
        ("depths", "u8"),  # addresses
        ("ranges", "u8"),
    ],
    align=True,
)
LIGHT_SHADOW = np.dtype([("kind", "i4"), ("exact", "i4"), ("maps", LIGHT_MAPS)], align=True)
SHADOW_MAP = np.dtype([(name, "f4") for name in ("scale", "x", "y", "texel")])
LIGHT = np.dtype(
    [
        ("kind", "i4"),
        ("falloff", "i4"),
        ("color", "f4", 3),
        ("to_light", "f4", 3),
        ("position", "f4", 3),
        ("range", "f4"),
        ("lux", "f4", 3),
        ("cone", "f4", 2),
        ("shadow", LIGHT_SHADOW),
    ],
    align=True,
)
CELLS, LOBE_TEXELS = 4, 16
CELL_GROUP = np.dtype(
    [
        ("direction", "f4", (3, CELLS)),
        ("weight", "f4", CELLS),
        ("light", "f4", (3, CELLS)),
        ("middle", "f4", 3),
    ]
)
LOBE_BLOCK = np.dtype(
    [
        ("normal", "f4", (3, LOBE_TEXELS)),
        ("sums", "f4", (4, LOBE_TEXELS)),
        ("square", "f4"),
        ("rest", "f4"),
    ]
)

STRUCTS = {
    "cluster": CLUSTER,
    "facing": FACING,
    "viewport": VIEWPORT,
    "vertices": VERTICES,
    "survivors": SURVIVORS,
    "record": RECORD,
    "tile_span": TILE_SPAN,
    "small_triangles": SMALL_TRIANGLES,
    "bin": BIN,
    "fragment_block": FRAGMENT_BLOCK,
    "drawn_cluster": DRAWN_CLUSTER,
    "piece": PIECE,
    "visible_tile": VISIBLE_TILE,
    "run": RUN,
    "cover": COVER,
    "layers": LAYERS,
    "shown": SHOWN,
    "surfaces": SURFACES,
    "batch": BATCH_RECORD,
    "light": LIGHT,
    "light_shadow": LIGHT_SHADOW,
    "shadow_map": SHADOW_MAP,
    "map_batch": MAP_BATCH,
    "cell_group": CELL_GROUP,
    "lobe_block": LOBE_BLOCK,
}


def viewport_of(width, height):
    """A viewport record: sizes in samples, and the guard factors of section 2 of the rules; one
    sample a pixel."""
    guard_x, guard_y = (2.0 ** np.floor(np.log2(65536 / size)) for size in (width, height))
    return np.array(
        [(width, height, 128 * width, 128 * height, guard_x, guard_y, 0, 0, 0)], VIEWPORT
    )
