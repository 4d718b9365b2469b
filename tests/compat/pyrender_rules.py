"""R146 to R150 and R152 of docs/exactness in NumPy: what visible triangles show, to the bit.

Written from the rules, array by array: each operation is one of IEEE, in the rules' order.
Everything is float32 unless it says otherwise; a fragment is a row.
"""

import numpy as np

F = np.float32
PATTERN = np.array([(-32, 96), (96, 32), (-96, -32), (32, -96), (0, 0)]) / 256.0  # y down
CENTRE = 4
THRESHOLDS = (((np.arange(255) + 0.5) / 255.0) ** 2.2).astype(F)
_LOG2 = [
    *("0x1.c5507p-2", "-0x1.1d270ep-2", "0x1.99e72p-3", "-0x1.2cc076p-3"),
    *("0x1.823526p-4", "-0x1.5a65f6p-5", "0x1.2b619ap-7"),
]
_LOG2 = [F(float.fromhex(term)) for term in _LOG2]


def dot(a, b):
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]


def clamp(x, low, high):
    return np.minimum(np.maximum(x, F(low)), F(high))


def rows_times(m, v):
    """Four rows of a matrix times (x, y, z, 1), float64."""
    return np.stack([((r[0] * v[0] + r[1] * v[1]) + r[2] * v[2]) + r[3] for r in m])


def product(a, b):
    return np.stack(
        [((r[0] * b[0] + r[1] * b[1]) + r[2] * b[2]) + r[3] * b[3] for r in a.astype(np.float64)]
    )


def unit_or_zero(v):
    square = dot(v, v)
    with np.errstate(divide="ignore"):
        scale = np.where(square > 0, F(1) / np.sqrt(square), F(0))
    return v * scale


# ---- R146 ----


def normal_matrix(m):
    rows = [[0, 1, 2], [1, 2, 0], [2, 0, 1]]
    cofactors = np.empty((3, 3))
    for r in range(3):
        for c in range(3):
            (r1, r2), (c1, c2) = rows[r][1:], rows[c][1:]
            cofactors[r, c] = m[r1, c1] * m[r2, c2] - m[r1, c2] * m[r2, c1]
    determinant = dot(m[0], cofactors[0])
    most = np.abs(cofactors).max()
    return (cofactors * ((-1 if determinant < 0 else 1) / most)).astype(F)


class Vertices:
    """What becomes of the vertices of a draw."""

    def __init__(self, draw, clip_from_world):
        p = draw["positions"].T.astype(np.float64)
        self.clip = rows_times(product(clip_from_world, draw["world"]), p)
        self.world = rows_times(draw["world"][:3], p).astype(F)
        self.normal = None
        if draw["normals"] is not None:
            m, n = normal_matrix(draw["world"]), draw["normals"].T
            self.normal = unit_or_zero(np.stack([dot(row, n) for row in m]))


def weights(vertices, corner, x, y, size):
    """Weights of three corners, float64, and z there: `corner` (3, N), x and y in pixels."""
    across, down = 2.0 / size[0], -2.0 / size[1]
    clip, b = vertices.clip, []
    for k in range(3):
        i, j = clip[:, corner[(k + 1) % 3]], clip[:, corner[(k + 2) % 3]]
        cx, cy = i[1] * j[3] - i[3] * j[1], i[3] * j[0] - i[0] * j[3]
        cw = i[0] * j[1] - i[1] * j[0]
        b.append(((cx * across) * x + (cy * down) * y) + ((cw - cx) + cy))
    scale = 1 / ((b[0] + b[1]) + b[2])
    b = [one * scale for one in b]
    w, z = (
        (b[0] * c[corner[0]] + b[1] * c[corner[1]]) + b[2] * c[corner[2]]
        for c in (clip[3], clip[2])
    )
    return np.stack(b).astype(F), z / w


def mixed(array, corner, weight):
    """What vertices carry, (C, V), at fragments."""
    return (weight[0] * array[:, corner[0]] + weight[1] * array[:, corner[1]]) + weight[2] * array[
        :, corner[2]
    ]


# ---- R147 ----


def code(v):
    total = clamp(v, 0, 1) * F(255 / 256) + F(32768)
    return (total.view(np.int32) & 255).astype(np.int64)


def light_code(v):
    return np.where(v > 0, np.searchsorted(THRESHOLDS, v, side="right"), 0)


def metric(z, frame):
    near, far = frame["near"], frame["far"]
    if frame["straight"]:
        depth = near + (z + 1) * 0.5 * (far - near)
    elif np.isinf(far):
        depth = 2 * near / (1 - z)
    else:
        depth = 2 * near * far / (far + near - z * (far - near))
    return np.where(z <= 1, depth, 0).astype(F)


# ---- R148 ----


def wrapped(i, size, wrap):
    if wrap == "clamp":
        return np.clip(i, 0, size - 1)
    if wrap == "repeat":
        return i % size
    rest = i % (2 * size)
    return np.where(rest < size, rest, 2 * size - 1 - rest)


def between(a, b, share):
    return a + (((b - a) * (share + (share >> 7)) + 128) >> 8)


def level_texels(texels, uv, wrap, linear):
    """One level at one point, (C,) int."""
    height, width, _ = texels.shape
    at = [int(np.rint(c * F(n) * F(256))) for c, n in zip(uv, (width, height), strict=True)]
    if not linear:
        x, y = (wrapped(p >> 8, n, w) for p, n, w in zip(at, (width, height), wrap, strict=True))
        return texels[y, x].astype(int)
    x, y = (p - 128 for p in at)
    columns = [wrapped((x >> 8) + k, width, wrap[0]) for k in (0, 1)]
    low, high = (
        between(*texels[wrapped((y >> 8) + k, height, wrap[1]), columns].astype(int), x & 255)
        for k in (0, 1)
    )
    return between(low, high, y & 255)


def log2(v):
    mantissa, power = np.frexp(v)
    t = F(mantissa) * F(2) - F(1)
    total = _LOG2[6]
    for term in _LOG2[5::-1]:
        total = total * t + term
    return F(power - 1) + (t + (t * (F(1) - t)) * total)


def texel(texture, uv, change):
    """A texture at one point, (4,), in 0 .. 1."""
    levels = texture["levels"]
    height, width, channels = levels[0].shape
    most = F(0)
    for along in (0, 1):
        u, v = change[along, 0] * F(width), change[along, 1] * F(height)
        most = max(most, u * u + v * v)
    detail, level, share = np.sqrt(most), 0, 0
    if detail > 1:
        lod = log2(detail)
        level = int(lod)
        if level >= len(levels) - 1:
            level = len(levels) - 1
        else:
            share = int((lod - F(level)) * F(256))
    linear = texture["linear_far"] if detail > 1 else texture["linear_near"]
    if not texture["blends"] and share > 128:
        level += 1
    found = level_texels(levels[level], uv, texture["wrap"], linear)
    if texture["blends"] and share > 0:
        other = level_texels(levels[level + 1], uv, texture["wrap"], linear)
        found = between(found, other, share)
    out = np.full(4, 255)
    out[:channels] = found
    return out.astype(F) * F(F(1) / F(255))


def srgb_light(v):
    c = (np.arange(256) / 255.0).astype(float)
    table = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4).astype(F)
    return table[(v * F(255) + F(0.5)).astype(int)]


class Textured:
    """Coordinates and their changes, of fragments of a draw."""

    def __init__(self, draw, vertices, corner, weight, x, y, size):
        self.uv = mixed(draw["uvs"].T, corner, weight)
        left, low = x & ~1, (size[1] - 1 - y) & ~1
        px, py = left + 0.5, (size[1] - 1 - low) + 0.5
        found = []
        for dx, dy in ((0, 0), (1, 0), (0, -1)):
            w = weights(vertices, corner, px + dx, py + dy, size)[0]
            found.append((mixed(draw["uvs"].T, corner, w), mixed(vertices.world, corner, w)))
        self.change = np.stack([found[k][0] - found[0][0] for k in (1, 2)])  # (2, 2, N)
        self.moved = np.stack([found[k][1] - found[0][1] for k in (1, 2)])  # (2, 3, N)

    def read(self, texture):
        each = zip(self.uv.T, np.moveaxis(self.change, 2, 0), strict=True)
        return np.stack([texel(texture, uv, change) for uv, change in each], axis=1)

    def normal(self, texture, n):
        """A mapped normal."""
        sample, (du, dv), (right, up) = self.read(texture), self.change, self.moved
        determinant = du[0] * dv[1] - dv[0] * du[1]
        t = (dv[1] * right - du[1] * up) / determinant
        n = unit_or_zero(n)
        t = unit_or_zero(t - n * dot(n, t))
        across = [n[c - 2] * t[c - 1] - n[c - 1] * t[c - 2] for c in range(3)]
        b = unit_or_zero(np.stack(across))
        s = F(2) * sample - F(1)
        return (t * s[0] + b * s[1]) + n * s[2]


# ---- R149, R150 ----


def shadow(light, p, n):
    """What of a light its map lets through, at one point; `p`, `n` (3,)."""
    clip = rows_times(light["shadow_from_world"], p.astype(np.float64))
    toward = light["position"] - p
    if light["kind"] == "directional":
        toward = F(0) - light["direction"]
    cosine = clamp(dot(n, toward) / np.sqrt(dot(n, n) * dot(toward, toward)), 0, 1)
    bias = np.maximum(F(0.001) * (F(1) - cosine), F(0.0001)) / F(clip[3])
    depth = clip[2] / clip[3] * 0.5 + 0.5
    if depth > 1:
        return F(1)
    size = light["map"].shape[0]
    at = [F(F(clip[k] / clip[3] * 0.5 + 0.5) * F(size) + F(0.5)) for k in (0, 1)]
    cell = [int(np.floor(a)) for a in at]
    shares = [(F(1) - f, F(1), F(1), f) for f in (a - np.floor(a) for a in at)]
    total, compared = F(0), F(depth) - bias
    for row in range(4):
        for column in range(4):
            x, y = (cell[0] + column - 1) % size, (cell[1] + row - 1) % size
            z = min(light["map"][size - 1 - y, x] * 0.5 + 0.5, 1.0)
            hides = compared > F(np.floor(z * 16777215.0) / 16777215.0)
            total = total + (shares[0][column] * shares[1][row]) * F(hides)
    return F(1) - total * F(F(1) / F(9))


def unit(v):
    return v * (F(1) / np.sqrt(np.maximum(dot(v, v), F(2.0**-120))))


def lit(surface, frame, lights):
    """The light that fragments send to the eye, (3, N)."""
    p, base = surface["world"], surface["base"]
    metallic = clamp(surface["metallic"], 0, 1)
    dielectric, roughness = F(1) - metallic, clamp(surface["roughness"], 0.04, 1)
    alpha, r = roughness * roughness, roughness + F(1)
    squared, k = alpha * alpha, (r * r) * F(0.125)
    diffuse = (base[:3] * (F(1) - F(0.04))) * dielectric
    f0 = F(0.04) * dielectric + base[:3] * metallic
    n, v = unit(surface["normal"]), unit(frame["eye"][:, None] - p)
    nv = clamp(np.abs(dot(n, v)), 0.001, 1)
    total = np.zeros_like(diffuse)
    for light in lights:
        toward, strength = np.broadcast_to((F(0) - light["direction"])[:, None], p.shape), F(1)
        if light["map"] is not None:
            each = zip(p.T, surface["normal"].T, strict=True)
            strength = np.array([shadow(light, a, b) for a, b in each], F)
        if light["kind"] != "directional":
            axis, toward = toward, light["position"][:, None] - p
            strength = strength / np.maximum(dot(toward, toward), F(2.0**-120))
            toward = unit(toward)
            if light["kind"] == "spot":
                inside = clamp(dot(axis, toward), 0, 1) * light["scale"] + light["offset"]
                inside = clamp(inside, 0, 1)
                strength = strength * (inside * inside)
        h = unit(toward + v)
        nl, nh, vh = clamp(dot(n, toward), 0.001, 1), clamp(dot(n, h), 0, 1), clamp(dot(v, h), 0, 1)
        away = F(1) - vh
        fresnel = ((away * away) * (away * away)) * away
        masking = (nv / (nv * (F(1) - k) + k)) * (nl / (nl * (F(1) - k) + k))
        around = (nh * nh) * (squared - F(1)) + F(1)
        distribution = squared / ((F(3.14159265359) * around) * around)
        mirrored = (masking * distribution) / ((F(4) * nl) * nv + F(0.001))
        reflected = f0 + (F(1) - f0) * fresnel
        scattered = ((F(1) - reflected) * diffuse) * F(0.31830988618)
        color = light["color"][:, None]
        total = total + (nl * (strength * color)) * (scattered + reflected * mirrored)
    shone = (total + base[:3] * frame["ambient"][:, None]) * surface["occlusion"]
    return (shone + surface["emissive"]) * surface["vertex_color"][:3]


def surface_of(draw, frame, vertices, corner, x, y):
    weight, _ = weights(vertices, corner, x + 0.5, y + 0.5, frame["size"])
    ones = np.ones(len(x), F)
    s = {"base": draw["color"][:, None] * ones, "vertex_color": np.ones((4, len(x)), F)}
    if draw["colors"] is not None:
        s["vertex_color"] = mixed(draw["colors"].T, corner, weight)
    s["world"] = mixed(vertices.world, corner, weight)
    s["normal"] = frame["eye"][:, None] - s["world"]
    if vertices.normal is not None:
        s["normal"] = mixed(vertices.normal, corner, weight)
    s["metallic"], s["roughness"] = draw["metallic"] * ones, draw["roughness"] * ones
    s["occlusion"], s["emissive"] = ones, (draw["emissive"] * draw["emissive"])[:, None] * ones
    if draw["uvs"] is None:
        return s
    textured = Textured(draw, vertices, corner, weight, x, y, frame["size"])
    base, rough, normal, occlusion, emissive = draw["textures"]
    if base is not None:
        sample = textured.read(base)
        if frame["shading"] == "lit":
            sample[:3] = srgb_light(sample[:3])
        s["base"] = s["base"] * sample
    if rough is not None:
        sample = textured.read(rough)
        s["roughness"], s["metallic"] = s["roughness"] * sample[0], s["metallic"] * sample[1]
    if normal is not None and vertices.normal is not None:
        s["normal"] = textured.normal(normal, s["normal"])
    if occlusion is not None:
        s["occlusion"] = textured.read(occlusion)[0]
    if emissive is not None:
        s["emissive"] = s["emissive"] * srgb_light(textured.read(emissive)[:3])
    return s


def fragment_codes(frame, number, triangle, x, y):
    """Codes (N, 4) of triangles of one draw at the centres of pixels."""
    draw, vertices = frame["draws"][number], frame["vertices"][number]
    corner = draw["indices"][triangle].T
    if frame["shading"] == "plain":
        return np.tile(code(draw["color"]), (len(x), 1))
    s = surface_of(draw, frame, vertices, corner, x, y)
    flat = s["base"] * s["vertex_color"]
    if frame["shading"] == "flat":
        return code(flat).T
    lights = [frame["lights"][k] for k in draw["lights"]]
    return np.concatenate([light_code(lit(s, frame, lights)), code(flat[3:])]).T


# ---- R152 ----


def is_calm(draw, triangle):
    if draw["uvs"] is not None:
        return False
    corner = draw["indices"][triangle]
    for a, b in ((0, 1), (1, 2), (2, 0)):
        if draw["normals"] is not None:
            m, n = draw["normals"][corner[a]], draw["normals"][corner[b]]
            d = m - n
            if not dot(d, d) <= min(dot(m, m), dot(n, n)) * F(1 / 64):
                return False
        if draw["colors"] is not None:
            change = np.abs(draw["colors"][corner[a]] - draw["colors"][corner[b]])
            if not (change <= F(1 / 64)).all():
                return False
    return True


def is_one_fragment(frame, a, b):
    if a == b:
        return True
    if a[0] != b[0]:
        return False
    draw = frame["draws"][a[0]]
    shared = set(draw["indices"][a[1]].tolist()) & set(draw["indices"][b[1]].tolist())
    return bool(shared) and is_calm(draw, a[1]) and is_calm(draw, b[1])


def picture(frame, shown):
    """Colours (H, W, 4) and depths of `shown`: at each place (H, W, 2), draw and triangle or -1."""
    width, height = frame["size"]
    frame["vertices"] = [Vertices(draw, frame["clip_from_world"]) for draw in frame["draws"]]
    samples = len(shown) - 1 or 1
    what = np.full((samples, height, width, 2), -1)
    for y in range(height):
        for x in range(width):
            at = [tuple(place[y, x].tolist()) for place in shown]
            first = next((one for one in reversed(at) if one[0] >= 0), None)
            for s in range(samples):
                one = at[s] if at[s][0] < 0 or not is_one_fragment(frame, first, at[s]) else first
                what[s, y, x] = one
    codes = np.tile(code(frame["background"]), (samples, height, width, 1))
    for number in range(len(frame["draws"])):
        s, y, x = np.nonzero(what[..., 0] == number)
        if len(s):
            codes[s, y, x] = fragment_codes(frame, number, what[s, y, x, 1], x, y)
    color = (codes.sum(axis=0) + samples // 2) // samples
    return color.astype(np.uint8), depths(frame, shown)


def depths(frame, shown):
    width, height = frame["size"]
    place = frame["depth_place"]
    at, offset = shown[place if len(shown) > 1 else 0], PATTERN[place]
    out = np.zeros((height, width), F)
    for number, draw in enumerate(frame["draws"]):
        y, x = np.nonzero(at[..., 0] == number)
        corner = draw["indices"][at[y, x, 1]].T
        vertices = frame["vertices"][number]
        _, z = weights(vertices, corner, x + 0.5 + offset[0], y + 0.5 + offset[1], frame["size"])
        out[y, x] = metric(z, frame)
    return out
