"""project against R3, R8 and R9: the corners on the screen of what has no record."""

import numpy as np
from kernels.arithmetic import dot
from kernels.harness import all_backends, bits, hostile
from kernels.layouts import SURFACES, viewport_of
from kernels.surfaces import bytes_of
from kernels.test_surface import COUNTS, random_surfaces

SIZES = [(1, 1), (640, 480), (65536, 65536), (37, 23)]


def random_input(rng, count):
    """What is projected lies mostly in view and is small; positions may be anything."""
    surfaces = random_surfaces(rng, count)
    shape = surfaces["matrix"].shape
    surfaces["project"] = rng.choice([0, 1, 3], shape)
    surfaces["projected"] = 1
    surfaces["clip"] = rng.uniform(-1, 1, surfaces["clip"].shape)
    surfaces["clip"][15] += 3
    centre, around = rng.uniform(-1, 1, (3, 1, *shape)), rng.uniform(-0.1, 0.1, (3, 3, *shape))
    surfaces["position"] = centre + around
    wild = rng.random(shape) < rng.choice([0, 0.1])
    surfaces["position"][..., wild] = hostile(rng, (3, 3, wild.sum()), 2.0, 0.3)
    return surfaces


def snap(v):
    """To the nearest whole number, as far as snapped coordinates reach."""
    low = np.where(v > np.float32(-(2.0**26)), v, np.float32(-(2.0**26)))
    return np.rint(np.where(low < np.float32(2.0**26), low, np.float32(2.0**26))).astype(np.int64)


def expectation(s, viewport):
    """{name: words} of the elements that are projected."""
    rows = []
    for row in (0, 1, 3):
        m = s["clip"][4 * row : 4 * row + 4][:, s["matrix"]]
        rows.append(np.stack([dot(m[:3], s["position"][:, v]) + m[3] for v in range(3)]))
    iw = np.float32(1) / rows[2]
    x = snap((rows[0] * iw) * viewport["scale_x"] + viewport["scale_x"])
    y = snap(viewport["scale_y"] - (rows[1] * iw) * viewport["scale_y"])
    area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0])
    swapped = area.astype(np.int32) < 0
    words = {"x": x.astype(np.int32), "y": y.astype(np.int32), "iw": iw}
    for name, v in words.items():
        words[name] = np.where(swapped, v[[0, 2, 1]], v)
    front = swapped != (s["project"] == 3)
    return words | {"swapped": swapped.astype(np.int32), "back": (~front).astype(np.int32)}


@all_backends
def test_project(kernels):
    for seed in range(40):
        rng = np.random.default_rng(seed)
        count = COUNTS[seed % len(COUNTS)]
        surfaces = random_input(rng, count)
        given = surfaces.copy()
        viewport = viewport_of(*SIZES[seed % len(SIZES)])
        kernels.project(bytes_of(surfaces), viewport.view(np.uint8))
        with np.errstate(all="ignore"):
            expected = expectation(given, viewport[0])
        chosen = given["project"] != 0
        chosen[count:] = False
        for name in SURFACES.names:
            got, before = surfaces[name], given[name]
            if name in expected:
                want = np.where(chosen, expected[name], before)
                got, before = got[..., :count], want[..., :count]
            assert np.array_equal(bits(got), bits(before)), name
