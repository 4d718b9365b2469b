"""What mirrors show on physically based materials and on others: R211 and R212."""

import numpy as np
import pytest
from kernels.arithmetic import ONE, ZERO
from kernels.calls import record
from kernels.harness import all_backends
from kernels.kernels import brdf_record
from kernels.layouts import BATCH_RECORD, TEXTURE_BATCH
from kernels.test_physical import PLAIN, unit

F = np.float32
COUNTS = (1, 5, 16, 37)


def batch_of(count, rng):
    batch = np.zeros(1, BATCH_RECORD)
    batch["count"] = count
    batch["normal"][0, :, :count] = unit(rng.normal(size=(count, 3))).T
    batch["position"][0, :, :count] = rng.normal(size=(3, count))
    batch["color"][0, :, :count] = rng.random((3, count))
    return batch


def mirrors_of(count, rng):
    mirrors = record("mirror_batch")
    mirrors["share"][0, :count] = rng.choice([0, 0.3, 1], count)
    for name in ("light", "reflected", "haze"):
        mirrors[name][0, :, :count] = rng.random((3, count)) * 2
    return mirrors


@all_backends
@pytest.mark.parametrize("is_physical", [0, 1])
def test_light_of_mirrors(kernels, is_physical):
    rng = np.random.default_rng(3)
    for count in COUNTS:
        batch, mirrors = batch_of(count, rng), mirrors_of(count, rng)
        color, light, reflected, haze = (
            part[0, :, :count].copy()
            for part in (batch["color"], *(mirrors[k] for k in ("light", "reflected", "haze")))
        )
        share = mirrors["share"][0, :count].copy()
        added = reflected * (light - haze) if is_physical else (light - color) * share
        kernels.mirror_light(batch, is_physical, mirrors)
        expected = np.where(share > 0, color + added, color)
        assert np.array_equal(batch["color"][0, :, :count], expected)


def fifth(cosine):
    w = ONE - np.minimum(cosine, ONE)
    w2 = w * w
    return (w2 * w2) * w


VIEW = np.array([0.6, 0, 0.8, 0], F)


def cosine(normals):
    along = (normals[0] * VIEW[0] + normals[1] * VIEW[1]) + normals[2] * VIEW[2]
    return np.maximum(np.abs(along), F(2.0**-20))


@all_backends
@pytest.mark.parametrize("coat", [0.0, 0.6])
def test_shares_of_mirrors(kernels, coat):
    rng = np.random.default_rng(4)
    for count in COUNTS:
        batch, mirrors = batch_of(count, rng), mirrors_of(count, rng)
        textures = np.zeros(1, TEXTURE_BATCH)
        textures["shading_normal"][0, :, :count] = unit(rng.normal(size=(count, 3))).T
        numbers = {"metallic": [0.4], "specular": [0.8], "coat": [coat], "roughness": [0.1]}
        values = {name: np.array(value, F) for name, value in {**PLAIN, **numbers}.items()}
        lighting = record("lighting", eye=VIEW, exposure=1)
        kernels.mirror_shares(batch, textures, brdf_record(values), lighting, mirrors)
        n, coats = batch["normal"][0, :, :count], textures["shading_normal"][0, :, :count]
        f = np.minimum(F(0.04), ONE) * F(0.8)
        f0 = f + (batch["color"][0, :, :count] - f) * F(0.4)
        f90 = F(0.8) + (ONE - F(0.8)) * F(0.4)
        share = mirrors["share"][0, :count] * (f0 + (f90 - f0) * fifth(cosine(n)))
        if coat:
            share = share * (ONE - F(coat) * (F(0.04) + F(0.96) * fifth(cosine(coats))))
        assert np.array_equal(mirrors["reflected"][0, :, :count], share)
        assert (share[:, mirrors["share"][0, :count] == 0] == ZERO).all()
