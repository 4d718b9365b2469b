"""Calls kernels, and other functions of the core that no module offers, as headers declare them.

Arguments are arrays, whose types and sizes are checked as far as the headers tell; what a kernel
expects beyond that is for the caller to keep: an index out of range,
and it crashes. Where the core was built without what tests need, whoever imports this is skipped.
"""

import ctypes

import numpy as np
from kernels.layouts import HEADERS, layout

try:
    from engine3d._native import kernels_testing
except ImportError:
    import pytest  # which benchmarks do without

    built = 'it is built in place only: pip install -e ".[test]"'
    pytest.skip(built, allow_module_level=True)


class Record(np.ndarray):
    """A struct, and the arrays that it points to."""

    kept = ()


def record(name, **members):
    """The struct e3d_NAME with these members, the others being 0: numbers, arrays, records."""
    made = np.zeros(1, layout(f"e3d_{name}")).view(Record)
    made.kept = []
    for member in HEADERS.types[f"e3d_{name}"].members:
        if member.name in members:
            value = _converted(member, members.pop(member.name), made.kept)
            made[member.name] = 0 if value is None else value
    if members:
        raise TypeError(f"e3d_{name} has no member {', '.join(members)}")
    return made


def function(declared, address):
    """What calls the function at an address with arrays and numbers; `prepared` calls it later."""
    gives = _c_type(declared.type, declared.stars)
    takes = [_c_type(one.type, _is_address(one) or one.sizes) for one in declared.parameters]
    call = ctypes.CFUNCTYPE(gives, *takes)(address)

    def prepared(*arguments):
        kept = []
        pairs = zip(declared.parameters, arguments, strict=True)
        values = [_converted(one, value, kept, is_parameter=True) for one, value in pairs]
        return lambda kept=kept: call(*values)

    def called(*arguments):
        return prepared(*arguments)()

    called.prepared = prepared
    return called


def _c_type(name, is_address):
    if is_address or name == "void":
        return ctypes.c_void_p if is_address else None
    return np.ctypeslib.as_ctypes_type(layout(name))


def _is_address(declared):
    return declared.is_pointer or (declared.stars and not declared.sizes)


def _converted(declared, value, kept, is_parameter=False):
    """A value as a member or a parameter holds it; the arrays it points to go to `kept`."""
    if declared.stars and declared.sizes:  # pointers
        rows = np.array([_address(declared, row, kept) for row in value], np.uintp)
        kept.append(rows)
        return rows.ctypes.data if is_parameter else rows
    if _is_address(declared) or (declared.sizes and is_parameter):
        return _address(declared, value, kept)
    return value


def _address(declared, array, kept):
    """Where an array is, whose type must be what the pointer says that it points to."""
    if array is None or isinstance(array, int):
        return array
    if not (declared.const or array.flags.writeable) or not array.flags.c_contiguous:
        raise ValueError(f"{declared.name} must be contiguous, and writable unless it is const")
    if declared.type not in ("void", "char") and declared.stars in ("*", ""):
        kind = layout(declared.type)
        if kind.names and array.nbytes % kind.itemsize:
            raise ValueError(f"a struct of {kind.itemsize} bytes was expected, not {array.nbytes}")
        if not kind.names and array.dtype != kind.base:
            raise ValueError(f"{declared.name} must be of {kind.base}, not {array.dtype}")
    kept.append(array)
    return array.ctypes.data


def of_core(name):
    """A function of the core by its name."""
    return function(HEADERS.functions[name], kernels_testing.ADDRESSES[name])


def at_address(name, address, count=1):
    """The structs e3d_NAME, or other types of C, that lie at an address."""
    kind = layout(name)
    return np.frombuffer((ctypes.c_char * (kind.itemsize * count)).from_address(address), kind)
