# Part of rasterizer.pyx: what a frame draws, as arrays of the core's own structs.
#
# In:  handles of meshes and textures, colours and poses; then, for each frame, the rows of the nodes.
# Out: the draws, materials and lights that NativeRenderer.render hands to the core.
# Always: what the structs point to is held in `borrowed`, `trees` and `textures`.

cdef int copy_vector(float *to, value, int count) except -1:
    for k in range(count):
        to[k] = value[k]
    return 0


cdef void *grown(void *items, int count, int *capacity, size_t size) except NULL:
    """Room for one more item."""
    if count < capacity[0]:
        return items
    cdef int wanted = capacity[0] * 2 if capacity[0] else 16
    cdef void *moved = resized(items, wanted, size)
    capacity[0] = wanted
    return moved


cdef void *resized(void *items, size_t count, size_t size) except NULL:
    cdef void *moved = realloc(items, count * size)
    if moved == NULL:
        raise OutOfMemoryError("no memory for the list of what to draw")
    return moved


cdef class NativeRows:
    """The arrays of nodes that draw lists read, by the names of `NodeArrays`: held, and looked at once."""

    cdef e3d_node_rows rows
    cdef const double *bounds
    cdef const uint32_t *versions
    cdef int32_t room
    cdef list held

    def __cinit__(self, dict columns not None):
        cdef const uint8_t[::1] flags = columns["flags"], unshadowed = columns["unshadowed"]
        cdef const int32_t[::1] object = columns["object"], id = columns["object_id"], anchor = columns["anchor"]
        cdef const double[:, ::1] world = columns["world"], bounds = columns["bounds"]
        cdef const uint32_t[::1] versions = columns["world_version"]
        self.held = [flags, object, id, world, anchor, unshadowed, bounds, versions]
        self.room = <int32_t>min(map(len, self.held))
        require(world.shape[1] == 12, "world must be (nodes, 12)")
        require(bounds.shape[1] == E3D_BOX, "bounds must be (nodes, 7)")
        if self.room:
            self.rows.flags, self.rows.object, self.rows.id = &flags[0], &object[0], &id[0]
            self.rows.world, self.rows.anchor, self.rows.unshadowed = &world[0, 0], &anchor[0], &unshadowed[0]
            self.bounds, self.versions = &bounds[0, 0], &versions[0]

    cdef int first(self, int32_t count, const uint64_t[::1] selection, e3d_node_rows *rows) except -1:
        """Fill in the rows of the first nodes."""
        require(0 <= count <= self.room, "the arrays of nodes are too short")
        require(selection is None or 64 * selection.shape[0] >= count, "a selection has a bit a node")
        rows[0] = self.rows
        rows.count = count
        return 0


def find_casters(
    NativeRows arrays not None, int32_t count, const uint64_t[::1] selection, int32_t[:, ::1] found not None
) -> int:
    """Write slot, object and version of each node that shows and casts shadows; return how many there are.

    Of all nodes, or of those whose bit is set in a selection.
    """
    cdef e3d_node_rows rows
    cdef const uint64_t *bits = NULL
    arrays.first(count, selection, &rows)
    require(found.shape[0] >= count and found.shape[1] == 3, "found must be (nodes, 3)")
    if not count:
        return 0
    if selection is not None:
        bits = &selection[0]
    rows.casting = True
    return e3d_graph_casters(&rows, bits, arrays.versions, &found[0, 0])


cdef class NativeDrawList:
    """What a frame draws: objects, drawn wherever nodes place them, materials and lights.

    Besides it has what a map of shadows draws, after `place_casters`, and the maps of the lights.
    """

    cdef e3d_placed *objects
    cdef e3d_draw_list placed, casting, hiding
    cdef e3d_casters casters
    cdef int exact_light_count
    cdef e3d_totals totals
    cdef e3d_aperture apertures[E3D_MAX_APERTURES]
    cdef int32_t aperture_count
    cdef e3d_material *materials
    cdef e3d_material *casting_materials
    cdef e3d_material *unlit_materials
    cdef e3d_light *lights
    cdef e3d_shadow_map *shadow_maps
    cdef int shadow_map_count, shadow_map_capacity
    cdef bint casts_others  # the materials are others than those that maps are drawn with
    cdef list depths  # of the maps
    cdef e3d_ambient_light ambient_light
    cdef readonly int object_count, material_count, light_count
    cdef int object_capacity, material_capacity, light_capacity
    cdef dict borrowed, rims, trees  # by the number of the object
    cdef dict textures  # by that of the material
    cdef public int64_t node_boxes_tested  # for the selection that `place` was given last

    def __cinit__(self):
        self.borrowed, self.rims, self.trees = {}, {}, {}
        self.textures = {}
        self.depths = []

    def __dealloc__(self):
        free(self.objects)
        e3d_draw_list_free(&self.placed)
        e3d_draw_list_free(&self.casting)
        e3d_draw_list_free(&self.hiding)
        free(self.materials)
        free(self.casting_materials)
        free(self.unlit_materials)
        free(self.shadow_maps)
        free(self.lights)

    def clear(self):
        """Forget objects, draws, materials and lights, and let go of their arrays."""
        self.object_count = self.material_count = self.light_count = 0
        self.casts_others = True
        self.clear_shadows()
        self.forget_places()
        self.borrowed, self.rims, self.trees = {}, {}, {}
        self.textures = {}

    cdef void forget_places(self) noexcept:
        self.placed.count = self.placed.order_count = self.placed.nodes = 0
        self.casting.count = self.casting.order_count = self.casting.nodes = 0
        self.hiding.count = self.hiding.order_count = self.hiding.nodes = 0
        self.casters.version = 0

    def clear_lights(self):
        self.light_count = 0

    def set_ambient_light(self, terms):
        """Light from all around by direction: nine terms of three channels (e3d_ambient_light), or None."""
        self.ambient_light.is_given = terms is not None
        if terms is not None:
            for k in range(E3D_AMBIENT_TERMS):
                copy_vector(self.ambient_light.terms[k], terms[k], 3)

    def set_object(
        self, int index, NativeMesh mesh, int32_t material_base, bint encloses=False, const int32_t[::1] rim_ends=None,
        const double[:, ::1] rims=None,
    ):
        """Say what nodes refer to by a number, or by the next one; None is never drawn.

        Of an object that encloses a volume but for holes, the points round these, and where the points of each end.
        Nothing is drawn until `place`.
        """
        cdef Py_ssize_t holes = 0 if rim_ends is None else rim_ends.shape[0]
        if holes:
            require(rims is not None and rims.shape[1] == 3 and rims.shape[0] == rim_ends[holes - 1], "rims: (points, 3)")
        require(0 <= index <= self.object_count, "no such object")
        self.forget_places()
        if index == self.object_count:
            self.objects = <e3d_placed *>grown(
                self.objects, self.object_count, &self.object_capacity, sizeof(e3d_placed)
            )
            self.object_count += 1
        cdef e3d_placed *entry = &self.objects[index]
        memset(entry, 0, sizeof(e3d_placed))
        if mesh is not None:
            entry.draw.mesh = mesh.handle
        entry.draw.instances = 1
        entry.draw.material_base = material_base
        entry.encloses, entry.holes = encloses, <int32_t>holes
        if holes:
            entry.rim_ends, entry.rims = &rim_ends[0], &rims[0, 0]
        self.rims[index] = rim_ends, rims
        self.borrowed[index] = mesh, None
        self.trees.pop(index, None)

    def set_meshes(self, const int32_t[::1] numbers not None, list poses not None):
        """Say that objects of some numbers, which are listed, are drawn by `NativePose` as they are now."""
        cdef Py_ssize_t k
        cdef NativePose pose
        require(numbers.shape[0] == len(poses), "a pose a number")
        self.forget_places()
        for k in range(numbers.shape[0]):
            require(0 <= numbers[k] < self.object_count, "no such object")
            pose = poses[k]
            self.objects[numbers[k]].draw.mesh = pose.current.handle
            self.borrowed[numbers[k]] = pose.current, None

    def place(
        self,
        NativeRows arrays not None,
        int32_t count,
        const uint64_t[::1] selection,
        clip_from_world: NDArray[np.float64] | None,
        double widen,
        bint flat,
        bint batch,
        bint moved,
    ):
        """Draw the objects of the first nodes: those that show, or of these those whose bit is set.

        With a matrix, instances outside of what it shows are left out as well; ``flat`` tests their
        boxes one by one. With ``batch``, nodes of the same object are one draw. ``moved`` tells that something else is in the scene,
        or elsewhere, since the last time.
        """
        cdef e3d_node_rows rows
        cdef e3d_view_volume volume
        cdef const e3d_view_volume *view = NULL
        arrays.first(count, selection, &rows)
        if clip_from_world is not None:
            require(copy_matrix(&volume.clip_from_world[0], clip_from_world), "a matrix is 4x4")
            volume.widen, volume.flat = widen, flat
            view = &volume
        if moved:
            self.totals = e3d_graph_totals(&rows, self.objects, self.object_count)
        self.list_draws(&self.placed, &rows, selection, view, batch)

    def close_apertures(self):
        """Let no back show that is culled."""
        self.aperture_count = 0

    def open_apertures(
        self,
        NativeRows arrays not None,
        int32_t count,
        clip_from_world: NDArray[np.float64],
        view_from_world: NDArray[np.float64],
        int width,
        int height,
    ) -> int | None:
        """Let backs show where one may look into holes of what was placed last; return how many apertures there are.

        None if the near plane may cut what encloses a volume: backs may show anywhere then.
        """
        cdef e3d_node_rows rows
        cdef e3d_looking looking
        cdef int32_t found
        arrays.first(count, None, &rows)
        require(copy_matrix(&looking.clip_from_world[0], clip_from_world), "a matrix is 4x4")
        require(copy_matrix(&looking.view_from_world[0], view_from_world), "a matrix is 4x4")
        looking.width, looking.height = width, height
        found = e3d_find_apertures(&self.placed, &rows, arrays.bounds, self.objects, &looking, self.apertures)
        self.aperture_count = max(found, 0)
        return None if found < 0 else found

    def place_casters(
        self,
        NativeRows arrays not None,
        int32_t count,
        const uint64_t[::1] selection not None,
        clip_from_world: NDArray[np.float64],
    ):
        """List what a map of shadows draws: of the nodes whose bit is set those that cast shadows."""
        cdef e3d_node_rows rows
        cdef e3d_view_volume volume
        require(copy_matrix(&volume.clip_from_world[0], clip_from_world), "a matrix is 4x4")
        volume.widen, volume.flat = 1.0, False
        arrays.first(count, selection, &rows)
        rows.casting = True
        self.list_draws(&self.casting, &rows, selection, &volume, True)
        self.find_casting_materials()

    def place_hiding(
        self, NativeRows arrays not None, int32_t count, int64_t version, const uint32_t[::1] spared_lights=None
    ):
        """List what may hide lights with exact shadows: all nodes that show and cast shadows.

        ``version`` is another one whenever anything of that is other than before. Of each node, bit n of
        ``spared_lights`` is set where it does not hide the n-th of these lights.
        """
        cdef e3d_node_rows rows
        arrays.first(count, None, &rows)
        if spared_lights is not None and count:
            require(spared_lights.shape[0] >= count, "spared_lights: a row a node")
            rows.spared_lights = &spared_lights[0]
        rows.casting = True
        self.list_draws(&self.hiding, &rows, None, NULL, True)
        self.casters.version = version

    def hiding_faces(self):
        """How many faces `place_hiding` has listed, in all their places."""
        cdef int64_t count = 0
        cdef int32_t d
        for d in range(self.hiding.count):
            count += <int64_t>e3d_mesh_view(self.hiding.draws[d].mesh).faces_count * self.hiding.draws[d].instances
        return count

    cdef const e3d_casters *casters_now(self) except? NULL:
        """What may hide lights; NULL where no light has an exact shadow."""
        if not self.exact_light_count:
            return NULL
        self.find_casting_materials()
        self.casters.draws, self.casters.draw_count = self.hiding.draws, self.hiding.count
        self.casters.materials, self.casters.material_count = self.casting_materials, self.material_count
        return &self.casters

    cdef int list_draws(self, e3d_draw_list *placed, const e3d_node_rows *rows, const uint64_t[::1] selection,
                        const e3d_view_volume *view, bint batch) except -1:
        cdef const uint64_t *bits = NULL
        if selection is not None and rows.count:
            bits = &selection[0]
        if not e3d_graph_draws(placed, rows, bits, view, self.objects, self.object_count, batch):
            raise OutOfMemoryError("no memory for the list of what to draw")
        return 0

    def refracts(self) -> bool:
        """Whether something that was placed last bends or blurs what is behind it, in mode lit."""
        cdef e3d_frame frame
        memset(&frame, 0, sizeof(e3d_frame))
        frame.mode = E3D_MODE_LIT
        frame.materials, frame.material_count = self.materials, self.material_count
        frame.draws, frame.draw_count = self.placed.draws, self.placed.count
        return e3d_refracts(&frame)

    cdef int find_unlit_materials(self) except -1:
        """Materials as mode unlit draws them: what is black shows its emission, if it has one."""
        cdef e3d_material *material
        if not self.material_count:
            return 0
        self.unlit_materials = <e3d_material *>resized(
            self.unlit_materials, self.material_count, sizeof(e3d_material)
        )
        memcpy(self.unlit_materials, self.materials, self.material_count * sizeof(e3d_material))
        for k in range(self.material_count):
            material = &self.unlit_materials[k]
            if material.color[0] or material.color[1] or material.color[2]:
                continue
            # The texture of the colour decides what has holes.
            if material.alpha_mode == E3D_ALPHA_OPAQUE:
                material.texture = material.emissive_texture
                memcpy(material.color, material.emissive, sizeof(material.color))
        return 0

    cdef int find_casting_materials(self) except -1:
        """Materials as maps of shadows draw them: what is blended is there where it is half opaque."""
        if not self.casts_others or not self.material_count:
            return 0
        self.casting_materials = <e3d_material *>resized(
            self.casting_materials, self.material_count, sizeof(e3d_material)
        )
        memcpy(self.casting_materials, self.materials, self.material_count * sizeof(e3d_material))
        for k in range(self.material_count):
            if self.casting_materials[k].alpha_mode == E3D_ALPHA_BLEND:
                self.casting_materials[k].alpha_mode = E3D_ALPHA_MASK
                self.casting_materials[k].alpha_cutoff = 0.5
        self.casts_others = False
        return 0

    def set_instance_tree(self, int index, NativeTree tree):
        """Let instances be left out by a tree of their boxes, or by none.

        None also where the tree is of others than are listed: those came a moment ago.
        """
        require(0 <= index < self.object_count, "no such object")
        if tree is not None and tree.count != self.objects[index].draw.instances:
            tree = None
        self.objects[index].instances = NULL if tree is None else tree.tree
        self.trees[index] = tree

    def set_instances(
        self,
        int index,
        const float[:, ::1] poses not None,
        const uint8_t[:, ::1] colors_u8=None,
        const float[:, ::1] colors_f32=None,
        const int32_t[::1] ids=None,
    ):
        """Draw the mesh once for each row of `poses`: (N, 16) matrices or (N, 4) offset and scale."""
        require(0 <= index < self.object_count, "no such object")
        cdef e3d_draw *draw = &self.objects[index].draw
        require(poses.shape[1] in (4, 16), "poses must be (N, 16) or (N, 4)")
        self.forget_places()
        draw.pose_kind = E3D_POSE_MATRIX if poses.shape[1] == 16 else E3D_POSE_OFFSET_SCALE
        draw.instances = <int32_t>poses.shape[0]
        draw.poses = &poses[0, 0] if poses.shape[0] else NULL
        draw.instance_ids = NULL
        if ids is not None and poses.shape[0]:
            require(ids.shape[0] == poses.shape[0], "ids: (N,)")
            draw.instance_ids = &ids[0]
        draw.instance_colors_u8 = NULL
        draw.instance_colors_f32 = NULL
        if colors_u8 is not None and poses.shape[0]:
            require(colors_u8.shape[0] == poses.shape[0] and colors_u8.shape[1] == 4, "colors: (N, 4)")
            draw.instance_colors_u8 = &colors_u8[0, 0]
        elif colors_f32 is not None and poses.shape[0]:
            require(colors_f32.shape[0] == poses.shape[0] and colors_f32.shape[1] == 4, "colors: (N, 4)")
            draw.instance_colors_f32 = &colors_f32[0, 0]
        self.borrowed[index] = self.borrowed[index][0], (poses, colors_u8, colors_f32, ids)

    def set_material(self, int index, dict numbers not None, dict physical, dict textures not None):
        """Say what a material is, or the next one.

        ``numbers`` are those of e3d_material, by name; ``physical`` all of e3d_physical, or None where the material is
        none. ``textures`` are by the names of `TEXTURE_SLOTS`: a NativeTexture, the number of its set of coordinates,
        and the six numbers of the matrix that these are moved by, or None.
        """
        require(0 <= index <= self.material_count, "no such material")
        self.casts_others = True
        self.materials = <e3d_material *>grown(
            self.materials, self.material_count, &self.material_capacity, sizeof(e3d_material)
        )
        cdef e3d_material *material = &self.materials[index]
        memset(material, 0, sizeof(e3d_material))
        copy_vector(material.color, numbers["color"], 3)
        copy_vector(material.specular, numbers["specular"], 3)
        copy_vector(material.emissive, numbers["emissive"], 3)
        material.shininess = numbers["shininess"]
        material.id = numbers["id"]
        material.two_sided = numbers["two_sided"]
        material.flat = numbers["flat"]
        material.is_unlit = numbers["is_unlit"]
        material.normal_scale = numbers["normal_scale"]
        material.alpha = numbers["alpha"]
        material.alpha_mode = <e3d_alpha_mode><int>numbers["alpha_mode"]
        material.alpha_cutoff = numbers["alpha_cutoff"]
        material.mirror = numbers["mirror"]
        if physical is not None:
            material.is_physical = True
            material.physical = physical
        cdef e3d_texture_use use
        for slot, (texture, uv_set, matrix) in textures.items():
            memset(&use, 0, sizeof(use))
            use.texture = (<NativeTexture?>texture).handle
            use.uv_set = uv_set
            use.is_moved = matrix is not None
            if matrix is not None:
                copy_vector(use.matrix, matrix, 6)
            e3d_material_set_texture(material, TEXTURE_SLOTS[slot], &use)
        self.textures[index] = textures
        self.material_count = max(self.material_count, index + 1)

    def add_light(self, int kind, color, *, float range, int falloff, cone):
        """Add a light, which is then moved and turned to where it is.

        ``color`` is times the intensity: lux of lights without a position, candela of points, nits of areas.
        """
        self.lights = <e3d_light *>grown(self.lights, self.light_count, &self.light_capacity, sizeof(e3d_light))
        cdef e3d_light *light = &self.lights[self.light_count]
        memset(light, 0, sizeof(e3d_light))
        light.kind = <e3d_light_kind>kind
        copy_vector(light.color, color, 3)
        light.range = range
        light.falloff = <e3d_falloff>falloff
        copy_vector(light.cone, cone, 2)
        self.light_count += 1

    cdef e3d_light *light_at(self, int number) except NULL:
        if not 0 <= number < self.light_count:
            raise InvalidArgumentError("no such light")
        return &self.lights[number]

    def turn_light(self, int number, to_light):
        """Set against which way a light shines."""
        copy_vector(self.light_at(number).to_light, to_light, 3)

    def move_light(self, int number, position):
        """Set where a light is."""
        copy_vector(self.light_at(number).position, position, 3)

    def extend_light(self, int number, vectors, float radius):
        """Set the extent of an area light: two vectors of the world, and the radius of a tube."""
        cdef e3d_light *light = self.light_at(number)
        for k in range(2):
            copy_vector(light.extent[k], vectors[k], 3)
        light.radius = radius

    def clear_shadows(self):
        """Let no light have a shadow."""
        for k in range(self.light_count):
            self.lights[k].shadow.kind = E3D_SHADOW_NONE
        self.shadow_map_count = self.exact_light_count = 0
        self.depths = []

    def set_shadow(
        self, int number, const float[:, :, ::1] depths not None, list places not None, *, int taps, int step,
        float margin, float bias, float normal_bias, axes, depth, const uint32_t[:, :, ::1] ranges=None,
        float soft=0.0, float widest=1.0, float nearest=0.0,
    ):
        """Give a light its maps: (maps, size, size), the numbers of e3d_shadow_map of each, and their ranges, if these are found."""
        cdef e3d_light *light = self.light_at(number)
        cdef e3d_light_maps *maps = &light.shadow.maps
        cdef e3d_shadow_map *map
        require(depths.shape[0] == len(places) and depths.shape[1] == depths.shape[2] > 0, "maps are square")
        memset(maps, 0, sizeof(e3d_light_maps))
        maps.first, maps.count = self.shadow_map_count, <int32_t>depths.shape[0]
        maps.size, maps.taps, maps.step = <int32_t>depths.shape[1], taps, step
        maps.bias, maps.normal_bias, maps.margin = bias, normal_bias, margin
        for k in range(3):
            copy_vector(maps.axes[k], axes[k], 3)
        copy_vector(maps.depth, depth, 2)
        maps.soft, maps.widest, maps.nearest = soft, widest, nearest
        reach = abs(maps.depth[e3d_light_traits_of(light.kind).has_position])
        for scale, x, y in places:
            self.shadow_maps = <e3d_shadow_map *>grown(
                self.shadow_maps, self.shadow_map_count, &self.shadow_map_capacity, sizeof(e3d_shadow_map)
            )
            map = &self.shadow_maps[self.shadow_map_count]
            map.scale, map.x, map.y, map.texel, map.spread = scale, x, y, 1.0 / scale, scale / reach
            self.shadow_map_count += 1
        self.depths.append(depths)
        maps.depths = &depths[0, 0, 0]
        if ranges is not None:
            require_ranges(ranges[0], maps.size)
            require(ranges.shape[0] == depths.shape[0] * (2 if soft > 0.0 else 1), "each map has its ranges")
            self.depths.append(ranges)
            maps.ranges = &ranges[0, 0, 0]
        light.shadow.kind = E3D_SHADOW_MAP

    def set_exact_shadow(self, int number, float soft):
        """Give a light of a size (R196) an exact shadow; lights get theirs in their order."""
        cdef e3d_light_shadow *shadow = &self.light_at(number).shadow
        require(self.exact_light_count < E3D_MAX_EXACT_LIGHTS,
                f"at most {E3D_MAX_EXACT_LIGHTS} lights of a frame may have an exact shadow")
        shadow.kind, shadow.exact, shadow.soft = E3D_SHADOW_EXACT, self.exact_light_count, soft
        self.exact_light_count += 1
