"""transform and take_clip against R3, R4, R5 and R8."""

import numpy as np
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
    out.check_gaps()


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
                planes(p[number], stride), stride, count, m[number].ravel(), view, out
            )

        run_and_check(rng, viewport, to_screen(clip, viewport), call)


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


@all_backends
def test_take_clip(kernels):
    for seed in range(ROUNDS):
        rng = np.random.default_rng(seed)
        viewport = viewports(rng)
        clip = worst_clip_positions(rng, viewport)
        expected = to_screen([clip[:, k] for k in range(4)], viewport)
        strides = random_strides(rng)

        def call(number, count, view, out, clip=clip, strides=strides):
            stride = int(strides[number])
            kernels.take_clip(planes(clip[number], stride), stride, count, view, out)

        run_and_check(rng, viewport, expected, call)
