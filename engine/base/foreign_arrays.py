"""Arrays of other libraries, such as PyTorch, JAX and CuPy, by the protocols that they share.

In: any value. Out: a NumPy array over the same memory if it offers DLPack, else the value itself,
for NumPy to convert: it knows ``__array__``, ``__array_interface__`` and buffers. Memory that the
processor cannot read is an error that says how to copy it.

DLPack is the standard of the Python array API: ``__dlpack__`` and ``__dlpack_device__``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import InvalidArgumentError

#: Devices whose memory the processor reads, by their numbers in dlpack.h: the processor's own, and
#: memory that CUDA or ROCm pinned or manages.
_READABLE = (1, 3, 11, 13)
_TO_HOST = (
    "copy it to the host first, by tensor.cpu() of PyTorch, cupy.asnumpy(array) or "
    "jax.device_get(array)"
)


def on_host(value: Any, what: str) -> Any:
    """Return a value that NumPy can convert; quick for what is NumPy's or Python's.

    Raises
    ------
    InvalidArgumentError
        It is on a device, or its library does not hand it over.
    """
    if isinstance(value, (np.ndarray, list, tuple, float, int, np.generic)):
        return value
    if not is_foreign_array(value):
        return value
    try:
        device = value.__dlpack_device__()[0] if hasattr(value, "__dlpack_device__") else 0
        if device not in _READABLE and (device or hasattr(value, "__cuda_array_interface__")):
            raise InvalidArgumentError(f"{what} is in the memory of another device: {_TO_HOST}")
        return _exported(value) if device else value
    except InvalidArgumentError:
        raise
    # Libraries raise errors of many types: for tensors with gradients, for types of their own.
    except Exception as error:
        said = " ".join(str(error).split())
        kind = f"{type(value).__module__.partition('.')[0]}.{type(value).__name__}"
        message = f"{what}: {kind} does not hand its numbers over: {said}"
        raise InvalidArgumentError(message) from error


def _exported(value: Any) -> Any:
    """Return an array over the memory of another; a copy if its types are not DLPack's."""
    try:
        return np.from_dlpack(value)
    except Exception:
        if not hasattr(value, "__array__"):
            raise
        return np.asarray(value)


def is_foreign_array(value: Any) -> bool:
    """Return whether a value is an array of another library than NumPy, on whatever device."""
    if isinstance(value, (np.ndarray, np.generic)):
        return False
    return hasattr(value, "__dlpack__") or hasattr(value, "__cuda_array_interface__")


def without_axes(value: Any, what: str) -> Any:
    """Return the number in an array without axes, as a tensor's element is; else the value itself.

    Raises
    ------
    InvalidArgumentError
        As `on_host`.
    """
    if isinstance(value, np.generic) or getattr(value, "shape", None) != ():
        return value
    return np.asarray(on_host(value, what)).item()
