"""The kernels of one backend as methods, and the structs that they take made of arrays.

In:  the number that `rasterizer.BACKENDS` gives a backend.
Out: what the calls of one kernel wrote, in the same arrays. What a kernel expects of its arguments
     is written in csrc/kernels/each_kernel.inl.
"""

import functools

import numpy as np
from kernels.calls import at_address, function, kernels_testing, of_core, record
from kernels.layouts import HEADERS, MAX_LEVELS, layout

ROWS = HEADERS.types["e3d_kernels"].members
ENVIRONMENTS = {}
SWITCHES = ("coat", "sheen", "transmission", "thickness", "iridescence")


def _table(address):
    """What calls each kernel of the table that lies at an address."""
    addresses = at_address("size_t", address, len(ROWS)).tolist()
    return {row.name: function(row, at) for row, at in zip(ROWS, addresses, strict=True)}


def _addresses(rows):
    return np.array([row.ctypes.data for row in rows], np.uintp)


def record_table(records, drawn=None):
    """Where IDs lead to; both (workers, bytes), a power of two of workers."""
    bits = len(records).bit_length() - 1
    if len(records) != 1 << bits or (drawn is not None and len(drawn) != len(records)):
        raise ValueError(f"{len(records)} workers are not a power of two, or not all")
    given = None if drawn is None else _addresses(drawn)
    made = record("record_table", records=_addresses(records), drawn=given, bits=bits)
    made.kept += [records, drawn]
    return made


def shown_of(lights):
    """R154: what a white matt surface shows of lights, (..., 3)."""
    return lights["color"] * np.float32(1 / np.pi)


def lighting_of(lights, reach, ambient, clamp, eye, shadow_maps=None):
    """`reach`: (5, lights + PAD); `shadow_maps`: those of all lights, or None."""
    held = lights.view(layout("e3d_light"))
    given = {"lights": lights, "light_count": len(held), "reach": reach, "shadows": shadow_maps}
    given["shown"] = shown_of(held)
    return record("lighting", **given, ambient=ambient, clamp=clamp, eye=eye, exposure=1)


def texture_view(texels, channel_bits, sizes, filter, wrap, **more):
    """The levels, and 16 bytes more, lie one after the other in `texels`, each with its border;
    `sizes`: (levels, 2), width and height; `wrap`: along u and v."""
    levels, start = np.zeros(MAX_LEVELS, layout("e3d_level")), texels.ctypes.data
    for level, (width, height) in zip(levels, np.asarray(sizes).tolist(), strict=False):
        level["texels"], level["width"], level["height"] = start, width, height
        start += channel_bits // 2 * (width + 2) * (height + 2)
    given = {"level_count": len(sizes), "channel_bits": channel_bits, "filter": filter}
    given |= {"wrap": wrap, "anisotropy": 1, "level_scale": 1, **more}
    view = record("texture_view", levels=levels, **given)
    view.kept.append(texels)
    return view


def fog_view(kind, row, color, depths, density):
    """`depths`: the nearest, and 1 over the range."""
    near, scale = depths
    given = {"kind": kind, "row": row, "color": color, "near": near, "scale": scale}
    return record("fog_view", **given, density=density)


def brdf_record(values):
    """A physically based material without textures: arrays of float32 by name."""
    made, varying = record("brdf"), layout("e3d_varying")
    for name in values.keys() & set(made.dtype.names):
        kind = made.dtype[name]
        (made[name]["factor"] if kind.base == varying else made[name])[0] = (
            values[name] if kind.shape else values[name][0]
        )
    made["stretch"]["strength"] = values["anisotropy"][0]
    made["stretch"]["turn"] = values["anisotropy_turn"]
    has = {name: bool(made[name]["factor"].ravel()[0]) for name in SWITCHES}
    made["has_coat"], made["has_sheen"] = has["coat"], has["sheen"]
    made["transmits"], made["iridescent"] = has["transmission"], has["iridescence"]
    made["absorbs"] = has["transmission"] and has["thickness"]
    made["anisotropic"] = values["anisotropy"][0] != 0
    made["is_rare"] = made["transmits"] | made["anisotropic"] | made["iridescent"]
    return made


def environment_light(pixels, turn, intensity):
    """Of an environment that is made of pixels: the last one is kept, since that takes long."""
    pixels = np.asarray(pixels)
    if id(pixels) not in ENVIRONMENTS:
        for _, made in ENVIRONMENTS.values():
            of_core("e3d_environment_destroy")(int(made[0]))
        ENVIRONMENTS.clear()
        made, (height, width) = np.zeros(1, np.uintp), pixels.shape[:2]
        assert of_core("e3d_environment_create")(pixels, width, height, 1, made) == 0
        ENVIRONMENTS[id(pixels)] = pixels, made
    made = int(ENVIRONMENTS[id(pixels)][1][0])
    given = {"environment": made, "intensity": intensity}
    return record("environment_light", **given, cosine=turn[0], sine=turn[1])


class Kernels:
    """The kernels of one backend, by their names; some take plain arrays in place of a struct.

    Each is called `rounds` times with the same arguments: once, unless a benchmark sets it.

    Raises
    ------
    LookupError
        This build or CPU has no such kernels.
    """

    def __init__(self, backend):
        self.rounds = 1
        self._backend = backend
        self._once = _table(kernels_testing.kernels(backend))
        self._repeated = _table(kernels_testing.REPEATED)

    def __getattr__(self, name):
        """What calls a kernel with what its row says."""
        if name.startswith("_") or name not in self._once:
            raise AttributeError(name)
        return functools.partial(self._call, name)

    def _call(self, name, *arguments):
        if self.rounds == 1:
            return self._once[name](*arguments)
        kernels_testing.repeat(self._backend, self.rounds)
        return self._repeated[name](*arguments)

    def prepared(self, name, *arguments):
        """What calls a kernel once, at no more cost than that of the call."""
        return self._once[name].prepared(*arguments)

    def face_away(self, clusters, *others):
        """A bit for each cluster."""
        count = clusters.nbytes // layout("e3d_cluster").itemsize
        return self._call("face_away", clusters, count, *others)

    def record(self, *arguments):
        """The members of the request, then `out` and `spans`: room for a cluster's triangles."""
        *members, out, spans = arguments
        names = [member.name for member in HEADERS.types["e3d_record_request"].members]
        request = record("record_request", **dict(zip(names, members, strict=True)))
        return self._call("record", request, out, spans)

    def fragments(self, triangles, viewport, tiles_x, links, bins, count):
        """Of a copy of the triangles, to `links` of which `count` are in use; returns how many are
        then, the fragments and the triangles that have some."""
        out = record("fragment_bins", links=links, bins=bins, count=count)
        self._call("fragments", triangles.copy(), viewport, tiles_x, out)
        return tuple(int(out[name][0]) for name in ("count", "fragments", "triangles"))

    def _raster(self, name, pieces, z, slot, orders):
        """One piece after the other."""
        tile = record("tile_buffers", z=z, slot=slot, orders=orders)
        for piece in pieces.reshape(-1, layout("e3d_piece").itemsize):
            self._call(name, piece, tile)

    raster_depth = functools.partialmethod(_raster, "raster_depth")
    raster_overwrite = functools.partialmethod(_raster, "raster_overwrite")
    raster_count = functools.partialmethod(_raster, "raster_count")
    raster_mark = functools.partialmethod(_raster, "raster_mark")

    def raster_visible(self, tile, records, ids, drawn=None):
        self._call("raster_visible", tile, record_table(records, drawn), ids, len(ids))

    def raster_fragments(self, tile, records, drawn, link):
        self._call("raster_fragments", tile, record_table(records, drawn), link)

    def raster_settle(self, tile, records, depths=True):
        self._call("raster_settle", tile, record_table(records), depths)

    def find_runs(self, tile, width, height, out):
        """Returns how many, and if there are gaps."""
        gaps = np.zeros(1, np.int32)
        return self._call("find_runs", tile, width, height, out, gaps), bool(gaps[0])

    def show_records(self, tile, records, ids, shown):
        self._call("show_records", tile, record_table(records), ids, len(ids), shown)

    def cover_records(self, cover, records, ids, shown):
        """Returns whether they fit."""
        return self._call("cover_records", cover, record_table(records), ids, len(ids), shown)

    def show_layers(self, cover, records, numbers, layers, shown):
        """Of what the records cover, which must be these; returns whether it was worth it."""
        table = record_table(records)
        return self._call("show_layers", cover, table, numbers, len(numbers), layers, shown)

    def texture(
        self, batch, texels, channel_bits, sizes, filter, wrap, base, most=1, scale=1.0, of=None
    ):
        """`most`, `scale`: the anisotropy, the scale of levels; `of`: surfaces, if it has any."""
        more = {"anisotropy": most, "level_scale": scale}
        view = texture_view(texels, channel_bits, sizes, filter, wrap, **more)
        self._call("texture", batch, of, view, base)

    def light(self, batch, lights, reach, ambient, clamp, eye, shininess, shadow_maps=None):
        lighting = lighting_of(lights, reach, ambient, clamp, eye, shadow_maps)
        self._call("light", batch, lighting, shininess)

    def combine(self, batch, specular, emissive, exposure=1.0):
        self._call("combine", batch, specular, emissive, exposure)

    def physical(self, batch, brdf, lights, reach, ambient, eye, textures):
        """`brdf`: as for `brdf_record`; the coat's normals are in `textures`."""
        lighting = lighting_of(lights, reach, ambient, (0, np.inf), eye)
        self._call("physical", batch, brdf_record(brdf), lighting, textures)

    def environment(self, pixels, turn, intensity, *others):
        """Of an environment made of pixels."""
        self._call("environment", environment_light(pixels, turn, intensity), *others)

    def irradiance(self, pixels, turn, intensity, *others):
        self._call("irradiance", environment_light(pixels, turn, intensity), *others)

    def backdrop(self, pixels, turn, intensity, level, rays, *others):
        """`rays`: the corner's, and what a pixel adds along the row and down the column."""
        light = environment_light(pixels, turn, intensity)
        ray, across, down = rays
        given = {"light": light, "level": level, "ray": ray, "across": across, "down": down}
        self._call("backdrop", record("backdrop", **given), *others)

    def fog(self, fog, *others):
        """`fog`: as for `fog_view`."""
        self._call("fog", fog_view(*fog), *others)

    def raster_alpha(self, piece, records, limit, kept, shown, z):
        """Adds to what is shown; returns the next row, and whether a sample came again."""
        listed = record("alpha_list", limit=limit, kept=kept, shown=shown, z=z)
        row = self._call("raster_alpha", piece, record_table(records), listed)
        return row, bool(listed["met"][0])

    def alpha(self, batch, surfaces, texture, base, by_vertex, by_instance):
        """`texture`: None, or as for `texture_view`, as a tuple, and whether every alpha is 255."""
        view = None
        if texture is not None:
            *given, is_opaque = texture
            view = texture_view(*given, is_opaque=is_opaque)
        varying = record("varying", factor=base)
        self._call("alpha", batch, surfaces, view, varying, by_vertex, by_instance)

    def blend(
        self, first, depth, which, color, samples, left, through=None, light=None, lit=None, axis=1
    ):
        """Returns how many samples are left, which are listed. `through` and `light` are like
        `color`, or None; `lit`: the radiance of the tile's pixels, of axis * axis samples each."""
        given = {"first": first, "depth": depth, "which": which, "color": color}
        given |= {"through": through, "light": light, "lit": lit, "axis": axis}
        return self._call("blend", record("alpha_layers", **given), samples, left)

    def paint(
        self,
        batch,
        surfaces,
        wanted,
        texture,
        base,
        by_vertex,
        by_instance,
        lighting,
        shininess,
        specular,
        emissive,
        srgb,
        rgba,
        samples=None,
        fog=None,
        tone=0,
    ):
        """`texture`, `lighting`, `fog`: None, or as for their structs, as a tuple."""
        given = {
            "wanted": wanted,
            "texture": None if texture is None else texture_view(*texture),
            "base": base,
            "by_vertex": by_vertex,
            "by_instance": by_instance,
            "lighting": None if lighting is None else lighting_of(*lighting),
            "shininess": shininess,
            "specular": specular,
            "emissive": emissive,
            "srgb": srgb,
            "samples": samples,
            "fog": None if fog is None else fog_view(*fog),
            "tone": tone,
        }
        self._call("paint", batch, surfaces, record("paint", **given), rgba)

    def stream(self, to, pitch, source, step, size, count):
        """`count` rows of `size` bytes, `step` bytes apart; they arrive `pitch` bytes apart."""
        last = count - 1
        if last * pitch + size > to.nbytes or last * step + size > source.nbytes:
            raise ValueError(f"{count} rows of {size} bytes don't fit")
        given = {"to": to, "from": source, "bytes": size, "pitch": pitch, "step": step}
        self._call("stream", record("pixel_rows", **given, count=count))
