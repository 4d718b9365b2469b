"""tone and fog against R117 … R121, and the tone mappers against their published formulas."""

import numpy as np
from kernels.arithmetic import ONE, ZERO, clamp, dot, exp2, greatest, least
from kernels.harness import POISON, all_backends, bits, every_count, hostile
from kernels.kernels import Kernels
from kernels.layouts import BATCH, BATCH_RECORD, PAD, SURFACES

from engine3d._native.rasterizer import BACKENDS, TONE_MAPPINGS

F = np.float32
MOST = F(2.0**16)
LINEAR, EXPONENTIAL = 1, 2


def rows(matrix):
    return np.array(matrix, np.float64).astype(F)


# The published matrices, row by row; sources are named in csrc/data/tone_tables.h.
ACES_IN = [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
ACES_OUT = [
    [1.60475, -0.53108, -0.07367],
    [-0.10208, 1.10813, -0.00605],
    [-0.00327, -0.07276, 1.07602],
]
REC2020 = [[0.6274, 0.3293, 0.0433], [0.0691, 0.9195, 0.0113], [0.0164, 0.0880, 0.8956]]
SRGB = [[1.6605, -0.5876, -0.0728], [-0.1246, 1.1329, -0.0083], [-0.0182, -0.1006, 1.1187]]
INSET = [
    [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
    [0.137318972929847, 0.761241990602591, 0.101439036467562],
    [0.11189821299995, 0.0767994186031903, 0.811302368396859],
]
OUTSET = [
    [1.1271005818144368, -0.11060664309660323, -0.016493938717834573],
    [-0.1413297634984383, 1.157823702216272, -0.016493938717834257],
    [-0.14132976349843826, -0.11060664309660294, 1.2519364065950405],
]
CURVE = (15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232)
LEAST_STOPS, MOST_STOPS = -12.47393, 4.026069
# log2(m) - (m - 1) is about this of m, from the constant on; w**2.2 is w * w times the other of
# the root of w.
_LOG = ("-0x1.2753b3p+0", "0x1.062114p+1", "-0x1.0d47bp+0", "0x1.4417e6p-3")
LOG = [float.fromhex(word) for word in _LOG]
_POWER = ("0x1.930fbcp-2", "0x1.b7f576p-1", "-0x1.065e02p-2")
POWER = [float.fromhex(word) for word in _POWER]


# ---- the published formulas, in float64, of (3, n) arrays ----


def published_neutral(color):
    x = color.min(axis=0)
    color = color - np.where(x < 0.08, x - 6.25 * x * x, 0.04)
    peak = color.max(axis=0)
    new = 1 - 0.24**2 / (peak + 0.24 - 0.76)
    g = 1 - 1 / (0.15 * (peak - new) + 1)
    with np.errstate(invalid="ignore", divide="ignore"):
        bright = color * (new / peak)
    bright = bright * (1 - g) + new * g
    return np.where(peak < 0.76, color, bright)


def published_aces(color):
    v = np.array(ACES_IN) @ (color / 0.6)
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)
    return np.array(ACES_OUT) @ v


def published_agx(color):
    v = np.array(INSET) @ (np.array(REC2020) @ color)
    v = (np.log2(np.maximum(v, 1e-10)) - LEAST_STOPS) / (MOST_STOPS - LEAST_STOPS)
    v = np.array(OUTSET) @ np.polyval(CURVE, np.clip(v, 0, 1))
    return np.array(SRGB) @ np.maximum(v, 0) ** 2.2


PUBLISHED = {"neutral": published_neutral, "aces": published_aces, "agx": published_agx}


# ---- the rules, in float32 ----


def limited(color):
    return clamp(color, ZERO, MOST)


def multiply(matrix, v):
    return np.stack([dot(row, v) for row in matrix])


def neutral(color):
    x = least(least(color[0], color[1]), color[2])
    color = color - np.where(x < F(0.08), x - F(6.25) * x * x, F(0.04))
    peak = greatest(greatest(color[0], color[1]), color[2])
    dark = peak < F(0.76)
    peak = np.where(dark, ONE, peak)
    lower = ONE - F(0.0576) / (peak - F(0.52))
    whiter = ONE - ONE / (F(0.15) * (peak - lower) + ONE)
    scaled = color * (lower / peak)
    return np.where(dark, color, scaled + (lower - scaled) * whiter)


def aces(color):
    v = multiply(rows(np.array(ACES_IN) / 0.6), color)
    a = v * (v + F(0.0245786)) - F(0.000090537)
    b = v * (F(0.983729) * v + F(0.432951)) + F(0.238081)
    return multiply(rows(ACES_OUT), a / b)


def agx(color):
    """R119: the published numbers, arranged as the rule says."""
    inset, outset = np.array(INSET) @ np.array(REC2020), np.array(OUTSET)
    own = np.diag(inset)
    r, g, b = color
    m = rows(inset / own[:, None])
    light = (r + m[0, 1] * g) + m[0, 2] * b, (m[1, 0] * r + g) + m[1, 2] * b
    v = np.stack([*light, (m[2, 0] * r + m[2, 1] * g) + b])
    span, middle = MOST_STOPS - LEAST_STOPS, (MOST_STOPS + LEAST_STOPS) / 2
    least, most = (rows(2.0**stops / own)[:, None] for stops in (LEAST_STOPS, MOST_STOPS))
    words = clamp(v, least, most).view(np.uint32)
    stops = (words >> 9 | 0x44000000).view(F)
    m = ((words & 0x7FFFFF) | 0x3F800000).view(F)
    start = rows(LOG[0] - 512 - 127 + np.log2(own) - middle)[:, None]
    u = stops + (((F(LOG[3]) * m + F(LOG[2])) * m + F(LOG[1])) * m + start)
    curve = np.poly1d(CURVE)(np.poly1d([1 / span, 0.5])).coeffs  # of stops from the middle
    q = u + F(curve[1] / curve[0])
    for coefficient in curve[2:]:
        q = q * u + F(coefficient / curve[0])
    alike = outset[0, 0] - outset[1, 0]
    o = rows(np.array([outset[1, 0], outset[0, 1], outset[0, 2]]) / alike)
    w = greatest(q + dot(o, q), ZERO)
    scale = curve[0] * alike
    whole, half = POWER[0] / (POWER[2] * scale), POWER[1] / (POWER[2] * scale**0.5)
    power = (w * w) * ((w + F(whole)) + F(half) * np.sqrt(w))
    return multiply(rows(np.array(SRGB) * (POWER[2] * scale**3)), power)


def mapped(name, color):
    mapper = {"neutral": neutral, "aces": aces, "agx": agx}.get(name)
    if name != "agx":  # which has limits of its own
        color = limited(color)
    with np.errstate(all="ignore"):
        return clamp(color if mapper is None else mapper(color), ZERO, ONE)


def run(kernels, name, color):
    """The mapped colours, (3, n); beyond the pad nothing is written."""
    count = color.shape[1]
    room = np.full((3, count + 2 * PAD), POISON, np.uint32).view(np.float32)
    room[:, :count] = color
    kernels.tone(TONE_MAPPINGS[name], room, count)
    assert (room.view(np.uint32)[:, count + PAD :] == POISON).all()
    return room[:, :count]


@all_backends
def test_tone_mappers(kernels):
    rng = np.random.default_rng(11)
    for name in TONE_MAPPINGS:
        for count in every_count(rng, 2 * PAD + 1, 60):
            color = hostile(rng, (3, count), 2.0)
            assert np.array_equal(bits(run(kernels, name, color)), bits(mapped(name, color))), name
        bright = np.float32(2.0) ** rng.uniform(-20, 20, (3, 5000)).astype(np.float32)
        assert np.array_equal(run(kernels, name, bright), mapped(name, bright)), name


def codes(linear):
    """sRGB of 8 bits, before it is rounded."""
    curve = 1.055 * np.maximum(linear, 0.0031308) ** (1 / 2.4) - 0.055
    return 255 * np.where(linear < 0.0031308, 12.92 * linear, curve)


@all_backends
def test_formulas_that_were_published(kernels):
    """To 1e-5, AgX to half a code: colours of all brightness and of all hues, grey ones too."""
    rng = np.random.default_rng(12)
    color = (2.0 ** rng.uniform(-14, 7, (3, 20000))).astype(np.float32)
    color[:, ::3] = color[:1, ::3]
    color[:, ::50] = 0
    for name, formula in PUBLISHED.items():
        expected = np.clip(formula(color.astype(np.float64)), 0, 1)
        got = run(kernels, name, color)
        if name == "agx":
            off = codes(got.astype(np.float64)) - codes(expected)
            assert np.abs(off).max() < 0.42 and np.sqrt((off * off).mean()) < 0.2
        else:
            assert np.abs(got - expected).max() < 1e-5, name


def test_light_that_shows_is_the_way_back():
    """A mapper makes a colour of the light that shows as it, where any does."""
    from engine3d.rendering._tone_inverse import light_that_shows

    kernels = Kernels(BACKENDS["portable"])
    greys = np.repeat(np.linspace(0.01, 0.95, 40), 3).reshape(-1, 3)
    soft = 0.25 + 0.35 * np.random.default_rng(13).random((200, 3))
    for name in TONE_MAPPINGS:
        for color in np.concatenate([greys, soft]):
            light = np.float32(light_that_shows(tuple(color), name))
            shown = run(kernels, name, light[:, None])[:, 0]
            assert np.abs(shown - color).max() < 1e-4, (name, color)


# ---- fog ----


def share(kind, row, position, near, scale, density):
    """R120"""
    depth = greatest(ZERO - (dot(row[:3], position) + row[3]), ZERO)
    if kind == LINEAR:
        return clamp((depth - near) * scale, ZERO, ONE)
    u = depth * density
    return ONE - exp2(u * u * F(float.fromhex("-0x1.715476p+0")))


@all_backends
def test_fog(kernels):
    rng = np.random.default_rng(14)
    with np.errstate(all="ignore"):
        for count in every_count(rng, 3 * PAD, 200):
            position, before = (hostile(rng, (3, count + 2 * PAD), s, 0.02) for s in (9.0, 3.0))
            row, color = rng.uniform(-1, 1, 4).astype(F), rng.random(3).astype(F)
            near, scale, density = rng.random(3).astype(F)
            for kind in (LINEAR, EXPONENTIAL):
                got = before.copy()
                kernels.fog(
                    (kind, row.tolist(), color.tolist(), (near, scale), density),
                    position,
                    count,
                    got,
                )
                f = share(kind, row, position[:, :count], near, scale, density)
                bright = limited(before[:, :count])
                expected = bright + (color[:, None] - bright) * f
                assert np.array_equal(bits(got[:, :count]), bits(expected))
                assert np.array_equal(bits(got[:, count + PAD :]), bits(before[:, count + PAD :]))


@all_backends
def test_paint_does_both(kernels):
    """The pixels of a batch under fog and a mapper are those of each kernel in turn."""
    rng = np.random.default_rng(15)
    count = BATCH - 3
    position = hostile(rng, (3, BATCH + PAD), 5.0, 0.0)
    position[:, count:] = position[:, count - 1 : count]
    fog = (EXPONENTIAL, [0.1, 0.2, -1.0, -2.0], [0.5, 0.6, 0.7], (0.0, 1.0), 0.3)
    for srgb, name in ((s, n) for s in (False, True) for n in TONE_MAPPINGS):
        batch = np.zeros(1, BATCH_RECORD)
        batch["count"], batch["position"][0] = count, position
        batch["sample"][0] = np.minimum(np.arange(BATCH + PAD), count - 1)
        base = (2 * rng.random(3)).astype(F)
        color = np.repeat(base[:, None], BATCH + PAD, axis=1)
        kernels.fog(fog, position, count, color)
        kernels.tone(TONE_MAPPINGS[name], color, count)
        expected, got = (np.zeros(64 * 64 + PAD, np.uint32) for _ in range(2))
        kernels.encode(*color, count, srgb, expected)
        surfaces = np.zeros(1, SURFACES)
        arguments = (0, None, base, False, False, None, 0.0, None, None, srgb, got)
        mapping = TONE_MAPPINGS[name]
        kernels.paint(batch.view(np.uint8), surfaces, *arguments, None, fog, mapping)
        assert np.array_equal(got[:count], expected[:count])
