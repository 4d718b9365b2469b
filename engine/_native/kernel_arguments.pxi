# Part of kernels_testing.pyx: what kernels take, made of arrays.
#
# In:  arrays, whose sizes are checked as far as they say how many structs they hold.
# Out: the structs of csrc/kernels/types/, which point into the arrays.

cdef int check_size(const uint8_t[::1] struct, size_t size) except -1:
    if <size_t>struct.shape[0] != size:
        raise ValueError(f"a struct of {size} bytes was expected, not {struct.shape[0]}")
    return 0


cdef e3d_pixel_rows rows_of(uint8_t[::1] to, size_t pitch, const uint8_t[::1] source, size_t step, size_t size,
                            int count):
    cdef e3d_pixel_rows rows
    if (count - 1) * pitch + size > to.nbytes or (count - 1) * step + size > source.nbytes:
        raise ValueError(f"{count} rows of {size} bytes don't fit")
    rows.to = <char *>&to[0]
    rows.source = <const char *>&source[0]
    rows.bytes = size
    rows.pitch = pitch
    rows.step = step
    rows.count = count
    return rows


cdef e3d_samples *samples_of(float[:, ::1] planes) except NULL:
    if planes.nbytes != sizeof(e3d_samples):
        raise ValueError(f"{planes.nbytes} bytes, not {sizeof(e3d_samples)}")
    return <e3d_samples *>&planes[0, 0]


cdef enum:
    MOST_WORKERS = 8


cdef int fill_table(e3d_record_table *table, const e3d_record **rows,
                    const uint8_t[:, ::1] records) except -1:
    cdef Py_ssize_t workers = records.shape[0], worker
    table.bits = 0
    while 1 << table.bits < workers:
        table.bits += 1
    if 1 << table.bits != workers or workers > MOST_WORKERS:
        raise ValueError(f"{workers} workers are not a power of two up to {MOST_WORKERS}")
    for worker in range(workers):
        rows[worker] = <const e3d_record *>&records[worker, 0]
    table.records = rows
    table.drawn = NULL
    return 0


cdef int fill_drawn(e3d_record_table *table, const e3d_drawn_cluster **clusters,
                    const uint8_t[:, ::1] drawn) except -1:
    cdef Py_ssize_t worker
    if drawn is None:
        return 0
    if drawn.shape[0] != 1 << table.bits:
        raise ValueError(f"{drawn.shape[0]} workers, not {1 << table.bits}")
    for worker in range(drawn.shape[0]):
        clusters[worker] = <const e3d_drawn_cluster *>&drawn[worker, 0]
    table.drawn = clusters
    return 0


ctypedef void (*raster_kernel)(const e3d_piece *piece, const e3d_tile_buffers *tile)


cdef int raster(raster_kernel kernel, int rounds, const uint8_t[::1] pieces, float[::1] z,
                int32_t[::1] slot, const uint32_t[::1] orders) except -1:
    cdef e3d_tile_buffers tile = [&z[0], &slot[0], &orders[0]]
    cdef Py_ssize_t count = pieces.shape[0] // <Py_ssize_t>sizeof(e3d_piece), number
    check_size(pieces, <size_t>count * sizeof(e3d_piece))
    if not count:
        return 0
    cdef const e3d_piece *first = <const e3d_piece *>&pieces[0]
    for _ in range(rounds):
        for number in range(count):
            kernel(first + number, &tile)
    return 0


cdef e3d_lighting lighting_of(const uint8_t[::1] lights, const float[:, ::1] reach,
                              const float[::1] ambient, const float[::1] clamp,
                              const float[::1] eye):
    cdef e3d_lighting lighting
    cdef int row
    lighting.light_count = <int>(lights.shape[0] // sizeof(e3d_light))
    lighting.lights = <const e3d_light *>&lights[0] if lighting.light_count else NULL
    for row in range(5):
        lighting.reach[row] = &reach[row, 0]
    memcpy(lighting.ambient, &ambient[0], sizeof(lighting.ambient))
    memcpy(lighting.clamp, &clamp[0], sizeof(lighting.clamp))
    memcpy(lighting.eye, &eye[0], sizeof(lighting.eye))
    lighting.exposure = 1.0
    lighting.environment = NULL
    lighting.shadows = NULL
    lighting.ambient_terms = NULL
    lighting.has_visibility = 0
    return lighting


cdef int set_varying(e3d_varying *varying, const float[::1] values, int count) except -1:
    """Constants of a model: a value each."""
    if values.shape[0] != count:
        raise ValueError(f"a model takes {count} values, not {values.shape[0]}")
    for k in range(count):
        varying[k].factor = values[k]
    return 0


cdef e3d_surface_model model_of(dict values):
    """A physically based material without textures: arrays of float32 by name."""
    cdef e3d_surface_model model
    memset(&model, 0, sizeof(model))
    set_varying(&model.metallic, values["metallic"], 1)
    set_varying(&model.roughness, values["roughness"], 1)
    set_varying(model.reflectance, values["reflectance"], 3)
    set_varying(&model.specular, values["specular"], 1)
    set_varying(model.emissive, values["emissive"], 3)
    set_varying(&model.coat, values["coat"], 1)
    set_varying(&model.coat_roughness, values["coat_roughness"], 1)
    set_varying(model.sheen, values["sheen"], 3)
    set_varying(&model.sheen_roughness, values["sheen_roughness"], 1)
    model.has_coat = model.coat.factor != 0
    model.has_sheen = model.sheen[0].factor != 0
    set_varying(&model.transmission, values["transmission"], 1)
    set_varying(&model.thickness, values["thickness"], 1)
    for k in range(3):
        model.absorption[k] = values["absorption"][k]
    model.transmits = model.transmission.factor != 0
    model.absorbs = model.transmits and model.thickness.factor != 0
    model.stretch.strength = values["anisotropy"][0]
    model.stretch.turn[0], model.stretch.turn[1] = values["anisotropy_turn"]
    model.anisotropic = model.stretch.strength != 0
    set_varying(&model.iridescence, values["iridescence"], 1)
    set_varying(&model.film, values["film"], 1)
    model.film_ior = values["film_ior"][0]
    model.iridescent = model.iridescence.factor != 0
    model.is_rare = model.transmits or model.anisotropic or model.iridescent
    return model


cdef e3d_texture_view texture_view(const uint8_t[::1] texels, int channel_bits,
                                   const int32_t[:, ::1] sizes, int filter, wrap):
    """The levels lie one after the other in `texels`; `sizes` is (levels, 2): width and height; `wrap` is along u and v."""
    cdef e3d_texture_view view
    cdef Py_ssize_t start = 0, level
    view.level_count = <int32_t>sizes.shape[0]
    view.channel_bits = channel_bits
    view.is_opaque = 0
    view.filter = <e3d_filter>filter
    view.wrap[0], view.wrap[1] = <e3d_wrap>(<int>wrap[0]), <e3d_wrap>(<int>wrap[1])
    view.anisotropy, view.level_scale = 1, 1.0
    for level in range(sizes.shape[0]):
        view.levels[level].texels = &texels[start]
        view.levels[level].width = sizes[level, 0]
        view.levels[level].height = sizes[level, 1]
        start += channel_bits // 2 * (<Py_ssize_t>sizes[level, 0] + 2) * (sizes[level, 1] + 2)
    return view


cdef e3d_fog_view fog_view(fog) except *:
    """`fog`: the kind, the row of view_from_world, the colour, near and scale, the density."""
    cdef e3d_fog_view view
    kind, row, color, depths, density = fog
    view.kind = <e3d_fog_kind><int>kind
    for k in range(4):
        view.row[k] = row[k]
    for k in range(3):
        view.color[k] = color[k]
    view.near, view.scale = depths
    view.density = density
    return view
