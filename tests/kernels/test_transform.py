"""transform and take_clip against R3, R4, R5 and R8."""

import numpy as np
import pytest
from kernels import layouts
from kernels.arithmetic import clamp, round_even
from kernels.harness import Records, all_backends, check_lanes, every_count, hostile
from kernels.layouts import CLUSTER_VERTICES, VERTICES, viewport_of

CALLS = 4200
ROUNDS = 3  # with CALLS: 10^6 vertices and more
SIZES = [(1, 1), (1, 65536), (65536, 1), (1280, 720), (256, 256), (1023, 7), (16384, 16384)]


def viewports(rng):
    sizes = SIZES + [tuple(size) for size in rng.integers(1, 65537, (9, 2))]
    return np.concatenate([viewport_of(*size) for size in sizes])[rng.integers(0, 16, CALLS)]


def to_screen(clip, viewport):
    """Every field of the output, from four arrays (calls, vertices) of clip coordinates."""
    x, y, z, w = clip
    scale_x, scale_y, guard_x, guard_y = (
        viewport[name][:, None] for name in ("scale_x", "scale_y", "guard_x", "guard_y")
    )
    iw = np.float32(1) / w
    zn = z * iw
    most = np.float32(2.0**26)
    across, down = (x * iw) * scale_x + scale_x, scale_y - (y * iw) * scale_y
    guard = (x > guard_x * w) | (x < -(guard_x * w)) | (y > guard_y * w) | (y < -(guard_y * w))
    finite = np.isfinite(x) & np.isfinite(y) & np.isfinite(z) & np.isfinite(w)
    flags = [
        (layouts.NEAR, z < -w),
        (layouts.FAR, z > w),
        (layouts.LEFT, x < -w),
        (layouts.RIGHT, x > w),
        (layouts.BOTTOM, y < -w),
        (layouts.TOP, y > w),
        (layouts.BEHIND, w < np.float32(2.0**-20)),
        (layouts.BEYOND_GUARD, guard),
        (layouts.NONFINITE, ~finite),
        (layouts.BAD_SCREEN, ~np.isfinite(zn)),
    ]
    return {
        "x": x,
        "y": y,
        "z": z,
        "w": w,
        "iw": iw,
        "zn": zn,
        "sx": round_even(clamp(across, -most, most)),
        "sy": round_even(clamp(down, -most, most)),
        "code": sum(bit * flag.astype(np.int32) for bit, flag in flags).astype(np.int32),
    }


def run_and_check(rng, viewport, expected, call):
    """`call(number, count, viewport, out)` runs the kernel for one record."""
    counts = every_count(rng, CLUSTER_VERTICES, CALLS)
    out = Records(VERTICES, CALLS)
    for number, (count, row) in enumerate(zip(counts, out.rows, strict=True)):
        call(number, int(count), viewport[number : number + 1].view(np.uint8), row)
    for name, values in expected.items():
        check_lanes(name, out.fields[name], values, counts)
    assert np.array_equal(out.fields["count"], counts)
    check_special(out.fields["special"], expected["code"], counts)
    out.check_gaps()


def check_special(got, code, counts):
    """Whether a vertex has outcodes; whole vectors are looked at, whose padding repeats some."""
    lanes = np.arange(CLUSTER_VERTICES)
    some = ((code != 0) & (lanes < counts[:, None])).any(axis=1)
    padded = ((code != 0) & (lanes < -(-counts[:, None] // layouts.PAD) * layouts.PAD)).any(axis=1)
    assert (got[some] != 0).all() and (got[~padded] == 0).all()


def random_strides(rng):
    """Planes as far apart as a mesh stores them, and farther."""
    return CLUSTER_VERTICES + 16 * rng.integers(0, 3, CALLS)


def planes(values, stride):
    """(components, vertices) as flat planes `stride` apart; the gaps hold NaN."""
    flat = np.full(len(values) * stride, np.nan, np.float32)
    for component, plane in enumerate(values):
        flat[component * stride : component * stride + CLUSTER_VERTICES] = plane
    return flat


@all_backends
def test_transform(kernels):
    for seed in range(ROUNDS):
        rng = np.random.default_rng(seed)
        positions = hostile(rng, (CALLS, 3, CLUSTER_VERTICES), 4.0, 0.02)
        matrices = hostile(rng, (CALLS, 4, 4), 2.0, 0.01)
        matrices[::2, 3] = [0, 0, -1, 0]
        x, y, z = (positions[:, k] for k in range(3))
        rows = [[matrices[:, r, c, None] for c in range(4)] for r in range(4)]
        clip = [((m[0] * x + m[1] * y) + m[2] * z) + m[3] for m in rows]
        viewport = viewports(rng)
        strides = random_strides(rng)

        def call(number, count, view, out, p=positions, m=matrices, strides=strides):
            stride = int(strides[number])
            kernels.transform(
                planes(p[number], stride), stride, count, m[number].ravel(), view, False, out
            )

        run_and_check(rng, viewport, to_screen(clip, viewport), call)


@all_backends
def test_transform_inside(kernels):
    """Vertices in the frustum; some aren't finite, and some calls come too near to the eye."""
    rng = np.random.default_rng(4)
    positions = rng.uniform(-1, 1, (CALLS, 3, CLUSTER_VERTICES)).astype(np.float32)
    rate = rng.choice([0, 0, 0.01], (CALLS, 1, 1))
    strange = rng.choice(np.float32([np.nan, np.inf, -np.inf]), positions.shape)
    positions = np.where(rng.random(positions.shape) < rate, strange, positions)
    viewport, counts = viewports(rng), every_count(rng, CLUSTER_VERTICES, CALLS)
    given = (np.arange(CLUSTER_VERTICES) < counts[:, None])[:, None]
    positions = np.where(given, positions, positions[..., :1])  # what a mesh pads with
    matrices = rng.uniform(-0.24, 0.24, (CALLS, 4, 4)).astype(np.float32)
    matrices[:, 3, 3] += 2
    matrices *= 2.0 ** rng.choice([0, 3, -21, -22], (CALLS, 1, 1))
    x, y, z = (positions[:, k] for k in range(3))
    rows = [[matrices[:, r, c, None] for c in range(4)] for r in range(4)]
    out = Records(VERTICES, CALLS)
    for n in range(CALLS):
        view = viewport[n : n + 1].view(np.uint8)
        flat = planes(positions[n], CLUSTER_VERTICES)
        kernels.transform(
            flat, CLUSTER_VERTICES, int(counts[n]), matrices[n].ravel(), view, True, out.rows[n]
        )
    out.check_gaps()
    with np.errstate(all="ignore"):
        clip = [((m[0] * x + m[1] * y) + m[2] * z) + m[3] for m in rows]
        expected = to_screen(clip, viewport)
    special = (expected["code"] != 0).any(axis=1) & (counts > 0)
    assert CALLS / 4 < special.sum() < 3 * CALLS / 4
    assert np.array_equal(out.fields["special"] != 0, special)
    for name, values in expected.items():
        if name in ("iw", "zn", "sx", "sy"):
            check_lanes(name, out.fields[name], values, counts)
        check_lanes(name, out.fields[name][special], values[special], counts[special])


def worst_clip_positions(rng, viewport):
    """(calls, 4, vertices): on the planes of the volume and guard band, at ties of snapping."""
    shape = (CALLS, CLUSTER_VERTICES)
    w = np.where(rng.random(shape) < 0.7, 2.0 ** rng.integers(-22, 8, shape), rng.random(shape) * 9)
    w = np.where(rng.random(shape) < 0.05, -w, w)
    clip = np.empty((CALLS, 4, CLUSTER_VERTICES), np.float32)
    clip[:, 3] = w.astype(np.float32)
    for k, (scale, guard) in enumerate([("scale_x", "guard_x"), ("scale_y", "guard_y")]):
        steps = (
            rng.integers(-8, 9, shape) * 0.5 + rng.integers(-2, 3, shape) * viewport[scale][:, None]
        )
        on_ties = steps / viewport[scale][:, None]
        on_planes = rng.choice([-1.0, 1.0], shape)
        on_guard = on_planes * viewport[guard][:, None]
        inside = rng.uniform(-1.5, 1.5, shape)
        choices = [on_ties, on_planes, on_guard, inside]
        clip[:, k] = np.choose(rng.integers(0, 4, shape), choices) * w
    clip[:, 2] = np.where(
        rng.random(shape) < 0.3, rng.choice([-1.0, 0, 1.0], shape), rng.random(shape)
    )
    clip[:, 2] *= clip[:, 3]
    nudged = np.nextafter(clip, rng.choice(np.float32([-np.inf, np.inf]), clip.shape))
    clip = np.where(rng.random(clip.shape) < 0.2, nudged, clip)
    return np.where(rng.random(clip.shape) < 0.01, hostile(rng, clip.shape, rate=1.0), clip)


@pytest.fixture(scope="module")
def clip_positions():
    """For all backends: each round's viewports, clip coordinates, strides, and what comes out."""
    made = []
    for seed in range(ROUNDS):
        rng = np.random.default_rng(seed)
        viewport = viewports(rng)
        with np.errstate(all="ignore"):
            clip = worst_clip_positions(rng, viewport)
            expected = to_screen([clip[:, k] for k in range(4)], viewport)
        made.append((viewport, clip, random_strides(rng), expected))
    return made


@all_backends
def test_take_clip(kernels, clip_positions):
    for seed, (viewport, clip, strides, expected) in enumerate(clip_positions):

        def call(number, count, view, out, clip=clip, strides=strides):
            stride = int(strides[number])
            kernels.take_clip(planes(clip[number], stride), stride, count, view, out)

        run_and_check(np.random.default_rng(seed), viewport, expected, call)
