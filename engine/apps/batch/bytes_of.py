"""Encodes the extra files that a script writes beside its picture.

In: a name suffix, and an array, bytes, a text, or JSON values. Out: the suffix with an extension,
and the bytes of the file.
"""

from __future__ import annotations

import io
import json
import re
from typing import Any

import numpy as np

from ...base.numbers import shown
from ...errors import InvalidArgumentError

_END = re.compile(r"\w[\w-]*(?:\.\w+)*")


def bytes_of(end: str, value: Any) -> tuple[str, bytes]:
    """Return the suffix of a file's name, with an extension, and its bytes.

    Raises
    ------
    InvalidArgumentError
    """
    if not (isinstance(end, str) and _END.fullmatch(end)):
        raise InvalidArgumentError(f"files: {shown(end)} is no end of a file's name")
    if isinstance(value, (bytes, bytearray, memoryview)):
        return end, bytes(value)
    if isinstance(value, str):
        return _with(end, ".txt"), value.encode("utf-8")
    if isinstance(value, np.ndarray) and not value.dtype.hasobject:
        data = io.BytesIO()
        np.save(data, value)
        return _with(end, ".npy"), data.getvalue()
    try:
        text = json.dumps(value, ensure_ascii=False, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InvalidArgumentError(f"files: {end} cannot be written: {error}") from None
    return _with(end, ".json"), f"{text}\n".encode()


def _with(end: str, extension: str) -> str:
    return end if "." in end else end + extension
