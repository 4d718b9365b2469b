"""Random surfaces and batches of samples for the shading kernels."""

import numpy as np
from kernels.harness import Records, every_count, hostile
from kernels.layouts import BATCH, BATCH_RECORD, PAD, SURFACE, TILE

SURFACES = 200
BATCHES = 514  # of one round: twice every length
ROUNDS = 9  # with BATCHES: 10^6 samples and more
LANES = BATCH + PAD
WORDS = ("p", "px", "py", "position", "normal", "uv", "color", "instance_color")


def random_surfaces(rng):
    """Most are what triangles give; the others hold any finite numbers."""
    surfaces = np.zeros(SURFACES, SURFACE)
    for name in WORDS:
        values = hostile(rng, surfaces[name].shape, 2.0, 0.03, finite=True)
        surfaces[name] = values
    surfaces["p"] = np.abs(surfaces["p"])
    tame = rng.random(SURFACES) < 0.8
    for name in ("px", "py"):
        surfaces[name][tame] *= np.float32(0.01)
    for name in ("base_x", "base_y"):
        surfaces[name] = rng.choice([0, 5, 63, -1, -64, -1000, -65536], SURFACES)
    surfaces["p"][:3] = surfaces["px"][:3] = surfaces["py"][:3] = 0  # no barycentrics at all
    tiny = 2.0 ** rng.integers(-130, -123, (20, 3))  # sums around the least that has an inverse
    surfaces["p"][9:29] = tiny
    surfaces["px"][9:29] = surfaces["py"][9:29] = 0
    surfaces["normal"][3:6] = 0
    surfaces["normal"][6:9] = np.float32(3e38)  # of infinite length
    surfaces["back"] = rng.integers(0, 2, SURFACES)
    return surfaces


def random_batches(rng):
    """Poisoned records with counts, samples and surfaces; runs of one surface, and mixtures.

    Whole vectors read `sample` and `surface`, so these have sense up to the pad's end.
    """
    batches = Records(BATCH_RECORD, BATCHES)
    fields = batches.fields
    fields["count"] = every_count(rng, BATCH, BATCHES)
    fields["sample"] = rng.integers(0, TILE * TILE, (BATCHES, LANES))
    mixed = rng.integers(0, SURFACES, (BATCHES, LANES))
    length = rng.choice([1, 7, 16, 64, LANES], BATCHES)
    run = np.arange(LANES) // length[:, None]
    fields["surface"] = np.take_along_axis(mixed, run, axis=1)
    return batches


def fill(batches, name, values):
    """Give a field of all batches; what lies beyond each count stays poison."""
    field = batches.fields[name]
    given = np.arange(LANES) < batches.fields["count"].reshape((-1,) + (1,) * (field.ndim - 1))
    field[...] = np.where(given, values, field)


def planes(array):
    """(batches, components, lanes) as a list of components."""
    return [array[:, k] for k in range(array.shape[1])]
