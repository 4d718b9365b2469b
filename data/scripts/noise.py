"""Random-looking smooth functions of space that are the same everywhere and for ever.

In: arrays of coordinates. Out: float64 in about [-1, 1]. Made of 32-bit integer hashes and single
IEEE operations, with no random generator whose stream might change. Source: Perlin 2002 (lattice
gradients replaced by lattice values, which is enough for landscapes and pigments).
"""

import numpy as np


def hash01(x, y, z, seed=0):
    """Hash integer lattice points to float64 in [0, 1)."""
    with np.errstate(over="ignore"):  # products wrap round, as they shall
        h = np.full(np.shape(x), seed, np.uint32) * np.uint32(0x9E3779B1)
        for coordinate in (x, y, z):
            lattice = np.asarray(coordinate).astype(np.int64).astype(np.uint32)
            h = (h ^ lattice) * np.uint32(0x85EBCA6B)
            h = (h ^ (h >> np.uint32(13))) * np.uint32(0xC2B2AE35)
            h = h ^ (h >> np.uint32(16))
    return h / 2.0**32


def fade(t):
    """Ease from 0 to 1 with first and second derivative 0 at both ends."""
    return t * t * t * (t * (t * 6.0 - 15.0) + 10.0)


def value_noise(x, y, z, seed=0):
    """Interpolate hashed lattice values smoothly, in [-1, 1]."""
    corner = [np.floor(c) for c in (x, y, z)]
    fx, fy, fz = (fade(c - base) for c, base in zip((x, y, z), corner, strict=True))
    ix, iy, iz = corner
    total = 0.0
    for dx, wx in ((0, 1.0 - fx), (1, fx)):
        for dy, wy in ((0, 1.0 - fy), (1, fy)):
            for dz, wz in ((0, 1.0 - fz), (1, fz)):
                total = total + wx * wy * wz * hash01(ix + dx, iy + dy, iz + dz, seed)
    return 2.0 * total - 1.0


def fractal_noise(x, y, z, octaves=5, seed=0, gain=0.5):
    """Add octaves of value noise, each of twice the frequency; in about [-1, 1]."""
    total, amplitude, frequency, sum_of_amplitudes = 0.0, 1.0, 1.0, 0.0
    for octave in range(octaves):
        # The irrational-looking offset keeps the octaves' lattices from coinciding.
        shift = 17.31 * octave
        layer = value_noise(
            x * frequency + shift, y * frequency - shift, z * frequency + shift, seed + octave
        )
        total = total + amplitude * layer
        sum_of_amplitudes += amplitude
        amplitude *= gain
        frequency *= 2.0
    return total / sum_of_amplitudes


def ridged_noise(x, y, z, octaves=5, seed=0):
    """Fractal noise folded at zero into sharp crests, in [0, 1]."""
    total, amplitude, frequency, sum_of_amplitudes = 0.0, 1.0, 1.0, 0.0
    for octave in range(octaves):
        shift = 9.17 * octave
        layer = value_noise(
            x * frequency - shift, y * frequency + shift, z * frequency + shift, seed + octave
        )
        total = total + amplitude * (1.0 - np.abs(layer))
        sum_of_amplitudes += amplitude
        amplitude *= 0.5
        frequency *= 2.0
    return total / sum_of_amplitudes
