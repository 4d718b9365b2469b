"""Random surfaces and batches of samples for the shading kernels."""

import numpy as np
from kernels.harness import Records, every_count, hostile
from kernels.layouts import BATCH, BATCH_RECORD, BATCH_SURFACES, PAD, SURFACES, TILE

BATCHES = 514  # of one round: twice every length
ROUNDS = 9  # with BATCHES: 10^6 samples and more
LANES = BATCH + PAD
WORDS = ("p", "px", "py", "position", "normal", "uv", "color", "instance_color", "slope")


def random_surfaces(rng):
    """Most are what triangles give; the others hold any finite numbers."""
    surfaces = np.zeros((), SURFACES)
    surfaces["count"] = BATCH_SURFACES
    for name in WORDS:
        surfaces[name] = hostile(rng, surfaces[name].shape, 2.0, 0.03, finite=True)
    order = rng.permutation(BATCH_SURFACES)  # batches mostly show the first surfaces
    surfaces["p"] = np.abs(surfaces["p"])
    tame = rng.random(surfaces["p"].shape[-1]) < 0.8
    for name in ("px", "py"):
        surfaces[name][:, tame] *= np.float32(0.01)
    for name in ("base_x", "base_y"):
        values = [0, 5, 63, -1, -64, -1000, -65536]
        surfaces[name] = rng.choice(values, surfaces[name].shape)
    for name in ("p", "px", "py"):
        surfaces[name][:, order[:3]] = 0  # no weights but the least
    tiny = 2.0 ** rng.integers(-68, -60, (3, 20))  # weights around the least
    surfaces["p"][:, order[9:29]] = tiny
    for name in ("px", "py"):
        surfaces[name][:, order[9:29]] = 0
    surfaces["normal"][..., order[3:6]] = 0
    surfaces["normal"][..., order[6:9]] = np.float32(3e38)  # of infinite length
    surfaces["back"] = rng.integers(0, 2, surfaces["back"].shape)
    return surfaces


def bytes_of(surfaces):
    return surfaces.reshape(1).view(np.uint8)


def at(surfaces, elements):
    """The words of the surfaces with these numbers: the elements' shape, then each word's own."""
    words = {}
    for name in SURFACES.names:
        word = surfaces[name]
        if word.shape[-1:] == (BATCH_SURFACES + PAD,):
            word = word[..., elements]
            words[name] = np.moveaxis(word, range(-elements.ndim, 0), range(elements.ndim))
    return words


def random_batches(rng):
    """Poisoned records with counts, samples and ascending surfaces: many short runs, or long ones.

    Whole vectors read `sample` and `surface`, so these repeat their last up to the pad's end.
    """
    batches = Records(BATCH_RECORD, BATCHES)
    fields = batches.fields
    fields["pattern"] = fields["finest"] = 0
    fields["count"] = every_count(rng, BATCH, BATCHES)
    rate = rng.choice([1, 1 / 2, 1 / 7, 1 / 20, 1 / 100], (BATCHES, 1))
    step = rng.random((BATCHES, LANES)) < rate
    step[:, 0] = False
    surface = np.minimum(np.cumsum(step, axis=1), BATCH_SURFACES - 1)
    sample = rng.integers(0, TILE * TILE, (BATCHES, LANES))
    last = np.minimum(np.arange(LANES), np.maximum(fields["count"], 1)[:, None] - 1)
    fields["sample"] = np.take_along_axis(sample, last, axis=1)
    fields["surface"] = np.take_along_axis(surface, last, axis=1)
    return batches


def fill(batches, name, values):
    """Give a field of all batches; what lies beyond each count stays poison."""
    field = batches.fields[name]
    given = np.arange(LANES) < batches.fields["count"].reshape((-1,) + (1,) * (field.ndim - 1))
    field[...] = np.where(given, values, field)


def planes(array):
    """(batches, components, lanes) as a list of components."""
    return [array[:, k] for k in range(array.shape[1])]
