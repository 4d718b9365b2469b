"""Streams of meshopt, packed and unpacked one number after the other, from the specification alone.

In: elements, or a stream. Out: a stream, or elements; `Damaged` where there are none. Source: the
appendix A of KHR_meshopt_compression.
"""

from __future__ import annotations

import random

import numpy as np

BITS = {0: (0, 2, 4, 8), "0": (0, 1, 2, 4), "1": (1, 2, 4, 8)}


class Damaged(ValueError):
    pass


def _zigzag(value: int, bits: int) -> int:
    return ((value << 1) ^ -(value >> (bits - 1) & 1)) & ((1 << bits) - 1)


def _block_size(stride: int) -> int:
    return min(8192 // stride & ~15, 256)


# ---- attributes ----


def pack_attributes(elements: np.ndarray, version: int, choice: random.Random) -> bytes:
    """Pack (N, stride) uint8, in ways that the choice makes."""
    count, stride = elements.shape
    channels = stride // 4
    modes = [choice.choice([0, 1, 2]) if version else 0 for _ in range(channels)]
    turns = [choice.randrange(16) if mode == 2 else 0 for mode in modes]
    base = bytes(choice.randrange(256) for _ in range(stride))
    stream, before = bytearray([0xA0 | version]), base
    for first in range(0, count, _block_size(stride)):
        block = elements[first : first + _block_size(stride)]
        deltas = np.zeros((len(block), stride), np.uint8)
        for row, element in enumerate(block):
            deltas[row] = list(_deltas(bytes(element), before, modes, turns))
            before = bytes(element)
        stream += _pack_block(deltas, version, choice)
    tail = base + bytes(mode | turn << 4 for mode, turn in zip(modes, turns, strict=True)) * version
    return bytes(stream) + tail.rjust(24 if version else 32, b"\0")


def _deltas(element: bytes, before: bytes, modes: list[int], turns: list[int]) -> bytes:
    found = b""
    for channel, (mode, turn) in enumerate(zip(modes, turns, strict=True)):
        now, last = (held[4 * channel : 4 * channel + 4] for held in (element, before))
        if mode == 0:
            found += bytes(_zigzag((a - b) & 255, 8) for a, b in zip(now, last, strict=True))
        elif mode == 1:
            for half in (0, 2):
                a, b = (int.from_bytes(held[half : half + 2], "little") for held in (now, last))
                found += _zigzag((a - b) & 0xFFFF, 16).to_bytes(2, "little")
        else:
            value = int.from_bytes(now, "little") ^ int.from_bytes(last, "little")
            value = (value << turn | value >> (32 - turn)) & 0xFFFFFFFF
            found += value.to_bytes(4, "little")
    return found


def _pack_block(deltas: np.ndarray, version: int, choice: random.Random) -> bytes:
    stride, controls, body = deltas.shape[1], [], b""
    for column in deltas.T:
        possible = [1, 3] + [2] * (not column.any()) + [0] * bool(column.max(initial=0) < 256)
        control = choice.choice(possible)
        controls.append(control)
        if version and control == 2:
            continue
        if version and control == 3:
            body += column.tobytes()
            continue
        body += _pack_column(column, BITS[str(control)] if version else BITS[0], choice)
    header = b""
    if version:
        for k in range(0, stride, 4):
            header += bytes([sum(c << 2 * i for i, c in enumerate(controls[k : k + 4]))])
    return header + body


def _pack_column(column: np.ndarray, widths, choice: random.Random) -> bytes:
    groups = -(-len(column) // 16)
    column = np.pad(column, (0, groups * 16 - len(column))).reshape(groups, 16)
    kinds, body = [], b""
    for group in column.tolist():
        kind = choice.choice([k for k, bits in enumerate(widths) if bits or not any(group)])
        kinds.append(kind)
        body += _pack_group(group, widths[kind])
    header = bytearray(-(-groups // 4))
    for number, kind in enumerate(kinds):
        header[number // 4] |= kind << number % 4 * 2
    return bytes(header) + body


def _pack_group(group: list[int], bits: int) -> bytes:
    if bits in (0, 8):
        return bytes(group) if bits else b""
    sentinel, packed = (1 << bits) - 1, bytearray(2 * bits)
    behind = bytes(value for value in group if value >= sentinel)
    for k, value in enumerate(group):
        place, within = divmod(k, 8 // bits)
        shift = within if bits == 1 else (8 // bits - 1 - within) * bits
        packed[place] |= min(value, sentinel) << shift
    return bytes(packed) + behind


# ---- indices ----


def _leb(number: int) -> bytes:
    found = b""
    while number >= 0x80:
        found += bytes([number & 0x7F | 0x80])
        number >>= 7
    return found + bytes([number])


def pack_indices(indices: list[int], choice: random.Random) -> bytes:
    last, stream = [0, 0], b"\xd1"
    for index in indices:
        base = choice.randrange(2)
        delta = (index - last[base]) & 0xFFFFFFFF
        stream += _leb((_zigzag(delta, 32) << 1 | base) & 0xFFFFFFFF)
        last[base] = index
    return stream + bytes(4)


class _Triangles:
    """The state that both ends keep."""

    def __init__(self) -> None:
        self.next = self.last = 0
        self.edges: list[tuple[int, int]] = []
        self.vertices: list[int] = []

    def emit(self, a: int, b: int, c: int, shared: bool, pushed: list[int]) -> tuple:
        self.edges += [(c, b), (a, c)] if shared else [(b, a), (c, b), (a, c)]
        self.vertices += pushed
        return a, b, c


def random_triangles(count: int, choice: random.Random) -> tuple[bytes, list[int]]:
    """Return a stream of so many triangles, of all kinds, and their indices."""
    state, codes, data, corners = _Triangles(), b"", b"", []
    table = bytes(choice.randrange(15) << 4 | choice.randrange(15) for _ in range(14)) + b"\0\0"

    def explicit() -> int:
        nonlocal data
        index = choice.randrange(1 << 20)
        data += _leb(_zigzag((index - state.last) & 0xFFFFFFFF, 32))
        state.last = index
        return index

    def fresh() -> int:
        state.next += 1
        return state.next - 1

    def corner(kind: int) -> int:
        if kind == 0:
            return fresh()
        return explicit() if kind == 15 else state.vertices[-kind]

    for _ in range(count):
        back = choice.randrange(15)
        if back < len(state.edges) and choice.random() < 0.7:
            a, b = state.edges[-1 - back]
            kind = choice.randrange(16)
            if 0 < kind < 13 and kind >= len(state.vertices):
                kind = 0
            pushed = True
            if kind == 0:
                c = fresh()
            elif kind < 13:
                c, pushed = state.vertices[-1 - kind], False
            elif kind < 15:
                c = state.last = (state.last + (-1 if kind == 13 else 1)) & 0xFFFFFFFF
            else:
                c = explicit()
            codes += bytes([back << 4 | kind])
            corners += state.emit(a, b, c, True, [c] if pushed else [])
            continue
        known = min(len(state.vertices), 14)
        usable = [k for k in range(14) if max(table[k] >> 4, table[k] & 15) <= known]
        if usable and choice.random() < 0.5:
            code = choice.choice(usable)
            kinds, codes = table[code], codes + bytes([0xF0 | code])
            a = fresh()
        else:
            code = choice.choice([0xFE, 0xFF])
            second, third = (choice.choice([*range(known + 1), 15]) for _ in range(2))
            kinds, codes, data = (
                second << 4 | third,
                codes + bytes([code]),
                data + bytes([second << 4 | third]),
            )
            state.next = state.next if kinds else 0
            a = explicit() if code == 0xFF else fresh()
        b = corner(kinds >> 4)
        c = corner(kinds & 15)
        pushed = [a] + [b] * (kinds >> 4 in (0, 15)) + [c] * (kinds & 15 in (0, 15))
        corners += state.emit(a, b, c, False, pushed)
    return b"\xe1" + codes + data + table, corners
