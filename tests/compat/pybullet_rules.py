"""Rules R268 to R270 once more, in NumPy over whole pictures."""

import numpy as np

f4 = np.float32


def shaded(own, normals, light, share=1.0):
    """R268: (H, W, 4) uint8."""
    direction, color, ambient, diffuse, specular = light
    x, y, z = (f4(part) for part in direction)
    facing = (normals[..., 0] * x + normals[..., 1] * y) + normals[..., 2] * z
    glance = np.maximum((normals[..., 2] * facing) * f4(2) - z, f4(0))
    lit = np.maximum(facing, f4(0)) * f4(diffuse) + (glance * glance) * f4(specular)
    lit = lit * share
    channels = [(lit * f4(c) + f4(ambient)) * own[..., k] for k, c in enumerate(color)]
    codes = np.trunc(np.clip(np.stack(channels, axis=-1), 0, 255)).astype(np.uint8)
    return np.concatenate([codes, np.full_like(own[..., :1], 255)], axis=-1)


def share_of_light(positions, shadows, clip, lens):
    """R269: (H, W) float32."""
    height, width = shadows.shape
    is_parallel, scale, offset = lens
    rows = [
        ((positions[..., 0] * r[0] + positions[..., 1] * r[1]) + positions[..., 2] * r[2]) + r[3]
        for r in clip.reshape(4, 4)
    ]
    with np.errstate(all="ignore"):
        columns = _texel(rows[0] / rows[3], width)
        nearest = shadows[height - 1 - _texel(rows[1] / rows[3], height), columns]
        z = nearest if is_parallel else nearest * f4(scale) / (nearest + f4(offset))
    own = (rows[2] + rows[3]) * f4(0.5) - f4(0.05)
    return np.where(np.isinf(nearest) | (z > own), f4(1), f4(0.8))


def _texel(ratio, count):
    place = (ratio + f4(1)) * f4(0.5 * count)
    place = np.where(place < count - 1, place, f4(count - 1))
    return np.where(place > 0, place, f4(0)).astype(np.int32)


def window_depths(depths, lens):
    """R270: (H, W) float32."""
    is_parallel, scale, offset = (f4(part) for part in lens)
    if not is_parallel:
        return np.where(depths < 1, depths, f4(1)) * f4(0.5) + f4(0.5)
    scale, offset = float(scale), float(offset)
    near, far = scale / (offset - 1), scale / (offset + 1)
    z = np.where(np.isinf(depths), far, depths.astype(np.float64))
    share = (far * (near + z) / (2 * far * near + far * z - near * z)).astype(f4)
    return np.where(np.isnan(share), f4(1), share)
