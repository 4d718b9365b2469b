"""The record types of the tests are the structs of the C headers."""

import numpy as np
import pytest
from kernels import layouts
from kernels.layouts import kernels_testing


@pytest.mark.parametrize("name", layouts.STRUCTS)
def test_sizes(name):
    assert layouts.STRUCTS[name].itemsize == kernels_testing.STRUCT_SIZES[name]


def test_all_structs_are_known():
    assert set(layouts.STRUCTS) == set(kernels_testing.STRUCT_SIZES)


def test_the_scalar_reference_has_no_kernels():
    with pytest.raises(LookupError):
        kernels_testing.Kernels(0)


def test_a_struct_of_another_size_is_refused():
    kernels = kernels_testing.Kernels(1)
    floats = np.zeros(4, np.float32)
    with pytest.raises(ValueError, match="40 bytes"):
        kernels.take_clip(floats, 1, 0, np.zeros(27, np.uint8), np.zeros(4608, np.uint8))
