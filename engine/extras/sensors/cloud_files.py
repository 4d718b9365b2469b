"""Files of point clouds: PCD, PLY, KITTI's .bin and NumPy's .npz.

In: arrays with a row for each point. Out: bytes, little-endian, the same everywhere.
Sources: "The PCD file format" of the Point Cloud Library, version 0.7; the PLY format of Turk 1994;
the development kit of KITTI (Velodyne points).
"""

from __future__ import annotations

import io
import os
from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...base.files.atomic_write import atomic_write, checked_path
from ...base.validation import choose

Columns: TypeAlias = Mapping[str, NDArray[Any]]

# Columns of a file, as it names them; of arrays as `LidarScan` names them.
_FIELDS = {
    **dict.fromkeys(("x", "y", "z"), ("points", "<f4")),
    "intensity": ("intensity", "<f4"),
    "ring": ("ring", "<u2"),
    "time": ("time", "<f4"),
    "object_id": ("object_id", "<i4"),
    "instance_id": ("instance_id", "<i4"),
    "face_id": ("face_id", "<i4"),
    **dict.fromkeys(("normal_x", "normal_y", "normal_z"), ("normal", "<f4")),
}
_AXES = {"x": 0, "y": 1, "z": 2}
_PLY_NAMES = {"normal_x": "nx", "normal_y": "ny", "normal_z": "nz"}
_PLY_TYPES = {"<f4": "float", "<u2": "ushort", "<i4": "int"}


def save_cloud(path: str | os.PathLike[str], arrays: Columns) -> None:
    """Write a point cloud: see `LidarScan.save`."""
    suffix = os.path.splitext(checked_path(path))[1].lstrip(".").lower()
    choose(suffix, _ENCODERS, "the suffix of a point cloud")
    data = _ENCODERS[suffix](arrays)
    with atomic_write(path) as file:
        file.write(data)


def _rows(arrays: Columns) -> NDArray[np.void]:
    """Return the points as one array of records."""
    records = np.empty(len(arrays["points"]), [(name, kind) for name, (_, kind) in _FIELDS.items()])
    for name, (source, _) in _FIELDS.items():
        values = arrays[source]
        records[name] = values if values.ndim == 1 else values[:, _AXES[name[-1]]]
    return records


def _pcd(arrays: Columns) -> bytes:
    kinds = [kind for _, kind in _FIELDS.values()]
    lines = (
        "# .PCD v0.7 - Point Cloud Data file format",
        "VERSION 0.7",
        f"FIELDS {' '.join(_FIELDS)}",
        f"SIZE {' '.join(kind[2] for kind in kinds)}",
        f"TYPE {' '.join(kind[1].upper() for kind in kinds)}",
        f"COUNT {' '.join('1' for _ in kinds)}",
        f"WIDTH {len(arrays['points'])}",
        "HEIGHT 1",
        "VIEWPOINT 0 0 0 1 0 0 0",
        f"POINTS {len(arrays['points'])}",
        "DATA binary",
    )
    return ("\n".join(lines) + "\n").encode() + _rows(arrays).tobytes()


def _ply(arrays: Columns) -> bytes:
    lines = [
        "ply",
        "format binary_little_endian 1.0",
        "comment a scan in the sensor's space: x forward, y left, z up",
        f"element vertex {len(arrays['points'])}",
        *(
            f"property {_PLY_TYPES[kind]} {_PLY_NAMES.get(name, name)}"
            for name, (_, kind) in _FIELDS.items()
        ),
        "end_header",
    ]
    return ("\n".join(lines) + "\n").encode() + _rows(arrays).tobytes()


def _bin(arrays: Columns) -> bytes:
    columns = [*arrays["points"].T, arrays["intensity"]]
    return np.stack(columns, axis=1).astype("<f4").tobytes()


def _npz(arrays: Columns) -> bytes:
    data = io.BytesIO()
    given: Any = arrays  # its stub takes every keyword for ``allow_pickle``
    np.savez(data, **given)  # compressed bytes would depend on zlib's build
    return data.getvalue()


_ENCODERS: dict[str, Callable[[Columns], bytes]] = {
    "pcd": _pcd,
    "ply": _ply,
    "bin": _bin,
    "npz": _npz,
}
