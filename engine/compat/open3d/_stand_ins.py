"""Stand-ins for shared libraries that Open3D names but that the machine lacks.

Open3D's library is linked with libGL, libEGL, libX11 and others, so ``import open3d`` fails without
them, even in programs that call none of their functions. In: the folder of the package. Out:
libraries of the missing names in memory, whose functions all return failure. Linux only, on x86-64
and AArch64.

The layout is that of ELF's specification (System V ABI, chapters 4 and 5).
"""

from __future__ import annotations

import ctypes
import os
import platform
import re
import struct
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

#: Libraries that may be missing: how their functions' names begin, what these return, and the
#: version of their symbols, if any. 0 is no display, no context, no device; libusb's and libidn2's
#: failures are negative.
_LIBRARIES = {
    "libGL.so.1": ("gl", 0, ""),
    "libEGL.so.1": ("egl", 0, ""),
    "libX11.so.6": ("X", 0, ""),
    "libudev.so.1": ("udev_", 0, "LIBUDEV_183"),
    "libidn2.so.0": ("idn2_", -1, "IDN2_0.0.0"),
    "libusb-1.0.so.0": ("libusb_", -1, ""),
}
#: Number of the machine in ELF, and the code of a function that returns 0, or -1.
_MACHINES = {
    "x86_64": (62, {0: "31c0c3", -1: "48c7c0ffffffffc3"}),
    "aarch64": (183, {0: "000080d2c0035fd6", -1: "00008092c0035fd6"}),
}
_PAGE = 0x10000
_NEEDED, _HASH, _STRTAB, _SYMTAB, _STRSZ, _SYMENT, _SONAME = 1, 4, 5, 6, 10, 11, 14
_VERSYM, _VERDEF, _VERDEFNUM = 0x6FFFFFF0, 0x6FFFFFFC, 0x6FFFFFFD
_SYMBOL = np.dtype([("name", "<u4"), ("kind", "V2"), ("section", "<u2"), ("value", "V16")])
#: What keeps the memory files open, so that their libraries stay.
_kept: list[int] = []


def provide_missing(package: str) -> list[str]:
    """Load stand-ins for the missing libraries of a package; return their names.

    Parameters
    ----------
    package : str
        Folder of the package ``open3d``.
    """
    if not sys.platform.startswith("linux") or platform.machine() not in _MACHINES:
        return []
    paths = [
        path
        for path in sorted(Path(package).glob("**/*.so*"))
        if re.match(r"(libOpen3D|pybind)", path.name)
    ]
    needed = {name for path in paths for name in _strings(path, _needed)}
    missing = [name for name in _LIBRARIES if name in needed and not _loads(name)]
    wanted = {name for path in paths if missing for name in _strings(path, _undefined)}
    for name in missing:
        prefix, result, version = _LIBRARIES[name]
        functions = sorted(one for one in wanted if one.startswith(prefix))
        _load(name, _library(name, functions, result, version))
    return missing


def _loads(name: str) -> bool:
    try:
        ctypes.CDLL(name)
    except OSError:
        return False
    return True


def _load(name: str, content: bytes) -> None:
    file = os.memfd_create(name)
    _kept.append(file)
    os.write(file, content)
    ctypes.CDLL(f"/proc/self/fd/{file}")


def _strings(path: Path, rows_of: Callable[[int, np.ndarray], np.ndarray | None]) -> set[str]:
    """Return names that a shared object lists.

    Parameters
    ----------
    path : Path
    rows_of : callable
        Takes the kind of a section and its bytes; returns where names begin, None for other kinds.
    """
    data = np.memmap(path, np.uint8, "r")
    if bytes(data[:6]) != b"\x7fELF\x02\x01":
        return set()
    start = int.from_bytes(bytes(data[40:48]), "little")
    size, count = struct.unpack_from("<HH", bytes(data[58:62]))
    sections = [
        struct.unpack_from("<IIQQQQIIQQ", bytes(data[at : at + size]))
        for at in range(start, start + size * count, size)
    ]
    found: set[str] = set()
    for _, kind, _, _, offset, length, link, *_ in sections:
        places = rows_of(kind, data[offset : offset + length])
        if places is not None:
            names = bytes(data[sections[link][4] : sections[link][4] + sections[link][5]])
            found |= {names[at : names.index(b"\0", at)].decode() for at in places.tolist()}
    return found


def _needed(kind: int, section: np.ndarray) -> np.ndarray | None:
    """Return where the names of needed libraries are."""
    if kind != 6:  # SHT_DYNAMIC
        return None
    rows = section.view("<i8").reshape(-1, 2)
    return rows[rows[:, 0] == _NEEDED, 1]


def _undefined(kind: int, section: np.ndarray) -> np.ndarray | None:
    """Return where the names of functions of other libraries are."""
    if kind != 11:  # SHT_DYNSYM
        return None
    rows = section.view(_SYMBOL)
    return rows["name"][rows["section"] == 0]


def _library(name: str, functions: list[str], result: int, version: str) -> bytes:
    """Return a shared object of a name whose functions all run the same code.

    One page holds the code and the tables, the next one, which the loader writes to, what ELF calls
    the dynamic section.
    """
    machine, codes = _MACHINES[platform.machine()]
    code = bytes.fromhex(codes[result]).ljust(16, b"\0")
    strings, places = b"\0", []
    for one in (name, version, *functions):
        places.append(len(strings))
        strings += one.encode() + b"\0"
    at_code, count = 64 + 3 * 56, len(functions) + 1
    symbols = bytes(24) + b"".join(
        struct.pack("<IBBHQQ", place, 0x12, 0, 1, at_code, len(code)) for place in places[2:]
    )
    chain = [0, *range(2, count), 0][:count]  # one bucket: each symbol names the next
    tables = {
        0: code,
        _SYMTAB: symbols,
        _HASH: struct.pack(f"<{3 + count}I", 1, count, min(1, count - 1), *chain),
        _STRTAB: strings,
    }
    if version:
        tables[_VERSYM] = struct.pack(f"<{count}H", 0, *[2] * len(functions))
        tables[_VERDEF] = b"".join(
            struct.pack("<HHHHIIIII", 1, flags, number, 1, _hash(one), 20, following, place, 0)
            for flags, number, one, following, place in (
                (1, 1, name, 28, places[0]),
                (0, 2, version, 0, places[1]),
            )
        )
    body, at = b"", {}
    for kind, table in tables.items():
        at[kind] = at_code + len(body)
        body += table.ljust(-(-len(table) // 8) * 8, b"\0")
    rows = [*((kind, place) for kind, place in at.items() if kind), (_SONAME, places[0])]
    rows += [(_STRSZ, len(strings)), (_SYMENT, 24), *([(_VERDEFNUM, 2)] if version else ()), (0, 0)]
    dynamic = b"".join(struct.pack("<QQ", *row) for row in rows)
    end = at_code + len(body)
    at_dynamic = -(-end // _PAGE) * _PAGE
    header = struct.pack(
        *("<16sHHIQQQIHHHHHH", b"\x7fELF\x02\x01\x01", 3, machine, 1, 0, 64, 0, 0),
        *(64, 56, 3, 64, 0, 0),
    )
    segments = b"".join(
        struct.pack("<IIQQQQQQ", kind, flags, start, start, start, size, size, align)
        for kind, flags, start, size, align in (
            (1, 5, 0, end, _PAGE),  # PT_LOAD: read, execute
            (1, 6, at_dynamic, len(dynamic), _PAGE),  # PT_LOAD: read, write
            (2, 6, at_dynamic, len(dynamic), 8),  # PT_DYNAMIC
        )
    )
    return (header + segments + body).ljust(at_dynamic, b"\0") + dynamic


def _hash(name: str) -> int:
    """Return ELF's hash of a name."""
    value = 0
    for byte in name.encode():
        value = (value << 4) + byte
        high = value & 0xF0000000
        value = (value ^ high >> 24) & ~high
    return value
