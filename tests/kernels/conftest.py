"""The kernels of each backend, and silence about the NaN and infinities that tests feed them."""

import numpy as np
import pytest
from kernels.harness import kernels_of


@pytest.fixture
def kernels(request):
    return kernels_of(request.param)


@pytest.fixture(autouse=True)
def no_float_warnings():
    with np.errstate(all="ignore"):
        yield
