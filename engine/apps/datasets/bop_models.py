"""The models of a BOP data set: the shape and size of each object.

In: things of pictures, drawn by whichever process. Out: a shape for each thing, named by a hash of
its geometry, so that each is written once, by whoever draws it first; at the end, where all things
of a category have one shape, ``obj_NUMBER.ply`` and ``models_info.json`` in ``models`` and
``models_eval``. Shapes have triangles and normals, in millimetres and the coordinates of the
thing's node, but no colours: these may differ from picture to picture.
Source: docs/bop_datasets_format.md and scripts/calc_model_info.py of bop_toolkit, written anew.
"""

from __future__ import annotations

import functools
import hashlib
import io
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...base import linalg
from ...base.files import json_records
from ...base.files.atomic_write import atomic_write
from ...base.files.hashing import hash_of_file
from ...base.files.making_folders import make_folder_of
from ...base.files.stamps import FileStamp, file_stamp
from ...errors import FileAccessError, FileFormatError, warn
from ...io.writing.rows import write_float_rows, write_integers
from ...model.geometry.mesh import Mesh
from ...model.scene.instances import InstancedMesh, instance_matrices
from ...model.scene.nodes import Node
from .samples import Thing
from .writer import Shared

#: Where models are written. What is evaluated is exactly what was drawn.
_PLACES = "models", "models_eval"
STORE = ".models"  # shapes by their hashes, which resumed batches rely on
_HEXADECIMAL, _DIGITS = "0123456789abcdef", 32
_SIZES = tuple(f"{what}_{axis}" for axis in "xyz" for what in ("min", "size"))
_RECORD = json_records.members(
    {
        "ply": json_records.sound_text,
        "info": json_records.members(dict.fromkeys(("diameter", *_SIZES), json_records.number)),
    }
)
_BLOCK = 256  # points whose distances are computed together
_HEADER = """ply
format ascii 1.0
comment written by engine3d, in millimetres
element vertex {vertices}
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face {faces}
property list uchar int vertex_indices
end_header
"""


def shape_name(value: Any) -> str | None:
    """Accept the name of a shape, as a shape of `json_records`."""
    is_name = isinstance(value, str) and len(value) == _DIGITS and set(value) <= set(_HEXADECIMAL)
    return None if is_name else ""


def shape_of(thing: Thing, millimetres: float) -> tuple[str | None, dict[str, Shared]]:
    """Return the hash of a thing's shape, None without triangles, and the shape's files.

    Parameters
    ----------
    thing : Thing
    millimetres : float
        How long the scene's unit is.
    """
    placed = [one for part in thing.parts for one in _placed(part, thing.node)]
    placed = [(mesh, pose) for mesh, pose in placed if len(mesh.faces)]
    if not placed:
        return None, {}
    digest = hashlib.blake2b(repr(millimetres).encode(), digest_size=_DIGITS // 2)
    for mesh, pose in placed:
        arrays = (pose, mesh.positions, mesh.faces, *([mesh.normals] * mesh.has_normals))
        for array in arrays:
            digest.update(repr((array.shape, mesh.crease_angle)).encode())
            digest.update(np.ascontiguousarray(array))
    name = digest.hexdigest()

    def joined() -> Mesh:
        meshes, poses = zip(*placed, strict=True)
        return Mesh.concatenate(meshes, poses=poses).with_creases()

    @functools.cache
    def ply() -> bytes:
        return _ply(joined(), millimetres)

    def record() -> bytes:
        said = {"ply": hashlib.sha256(ply()).hexdigest(), "info": _info(joined(), millimetres)}
        return json_records.sealed(said)

    path = f"{STORE}/{name}"
    return name, {
        f"{path}.ply": Shared(ply, lambda target: _info_of(target) is not None),
        f"{path}.json": Shared(record, lambda target: _info_of(target) is not None),
    }


def has_shapes(folder: str, names: Iterable[str | None]) -> bool:
    """Return whether a data set's folder has complete files of these shapes."""
    paths = (os.path.join(folder, STORE, f"{name}.json") for name in set(names) - {None})
    return all(_info_of(path) is not None for path in paths)


def _info_of(path: str) -> dict[str, float] | None:
    """Return the stored numbers of a shape from its files; None if one is incomplete."""
    stem = os.path.splitext(path)[0]
    stamps = file_stamp(f"{stem}.json"), file_stamp(f"{stem}.ply")
    return None if None in stamps else _checked_info(stem, stamps)


@functools.lru_cache(1 << 16)
def _checked_info(stem: str, stamps: tuple[FileStamp | None, ...]) -> dict[str, float] | None:
    path = f"{stem}.json"
    try:
        record = json_records.read_sealed(path, _RECORD)
        if hash_of_file(f"{stem}.ply", hashlib.sha256()) == record["ply"]:
            return record["info"]
        path, error = f"{stem}.ply", "damaged: not what its record says"
    except (FileAccessError, FileFormatError) as problem:
        return _damaged(str(problem))
    except OSError as problem:
        error = f"cannot read: {problem.strerror}"
    return _damaged(f"{path}: {error}")


def _damaged(reason: str) -> None:
    warn(f"{reason}: the shape is written again")


def write_models(
    folder: str,
    numbers: dict[str, int],
    shapes: Iterable[tuple[str, str | None]],
    symmetries: Mapping[str, Mapping[str, Any]] = MappingProxyType({}),
) -> Iterator[str]:
    """Write the models of categories; yield the paths of their files.

    Parameters
    ----------
    folder : str
        Of the data set.
    numbers : dict of str to int
        ``obj_id`` of each category.
    shapes : iterable of (category, hash of a shape)
        Of all things in all pictures.
    symmetries : mapping
        Members of models_info.json, by category.
    """
    found: dict[str, set[str | None]] = {}
    for category, name in shapes:
        found.setdefault(category, set()).add(name)
    _warn_of_lacking(found)
    infos = {}
    for category, names in sorted(found.items(), key=lambda one: numbers[one[0]]):
        (name, *others) = names
        if name is None or others:
            continue
        number, store = numbers[category], os.path.join(folder, STORE, name)
        info = _info_of(f"{store}.json")
        if info is None:
            raise FileFormatError("damaged while the data set was made", f"{store}.json")
        infos[str(number)] = {**info, **symmetries.get(category, {})}
        with open(f"{store}.ply", "rb") as file:
            model = file.read()
        for place in _PLACES:
            yield _written(folder, f"{place}/obj_{number:06d}.ply", model)
    if infos:
        lines = (f'  "{number}": {json.dumps(info)}' for number, info in infos.items())
        text = "{\n" + ",\n".join(lines) + "\n}\n"
        for place in _PLACES:
            yield _written(folder, f"{place}/models_info.json", text.encode())


def _warn_of_lacking(found: dict[str, set[str | None]]) -> None:
    """Warn about categories without a model, by name."""
    several = sorted(category for category, names in found.items() if len(names) > 1)
    if several:
        warn(
            f"the things of {', '.join(map(repr, several))} have several shapes each, but an "
            "object of BOP has one: models lacks them"
        )
    empty = sorted(category for category, names in found.items() if names == {None})
    if empty:
        warn(
            f"the things of {', '.join(map(repr, empty))} have no triangles, which models of BOP "
            "are made of: models lacks them"
        )


def _written(folder: str, path: str, data: bytes) -> str:
    target = os.path.join(folder, path)
    make_folder_of(target, below=folder)
    with atomic_write(target, below=folder) as file:
        file.write(data)
    return path


def _placed(part: Node, top: Node) -> Iterator[tuple[Mesh, NDArray[np.float64]]]:
    """Return the meshes of a part, each with its pose relative to the top node."""
    pose = np.eye(4)
    node: Node | None = part
    # World poses would add rounding, which differs in each picture.
    while node is not None and node is not top:
        pose = linalg.multiply(node.pose, pose)
        node = node.parent
    if isinstance(part.object, InstancedMesh):
        for instance in instance_matrices(part.object.poses):
            yield part.object.mesh, linalg.multiply(pose, instance)
    else:
        yield part.object, pose


def _points(mesh: Mesh, millimetres: float) -> NDArray[np.float32]:
    return (mesh.positions.astype(np.float64) * millimetres).astype(np.float32)


def _ply(mesh: Mesh, millimetres: float) -> bytes:
    file = io.BytesIO()
    points = _points(mesh, millimetres)
    file.write(_HEADER.format(vertices=len(points), faces=len(mesh.faces)).encode())
    rows = np.concatenate([points, mesh.normals], axis=1)
    write_float_rows(file, [b"", *[b" "] * (rows.shape[1] - 1), b"\n"], rows)
    write_integers(file, "3 %d %d %d", mesh.faces)
    return file.getvalue()


def _info(mesh: Mesh, millimetres: float) -> dict[str, float]:
    """Return a model's entry of models_info.json."""
    points = _points(mesh, millimetres).astype(np.float64)
    low, high = points.min(axis=0), points.max(axis=0)
    said = {"diameter": diameter(points)}
    for axis, start, size in zip("xyz", low.tolist(), (high - low).tolist(), strict=True):
        said |= {f"min_{axis}": start, f"size_{axis}": size}
    return said


def diameter(points: NDArray[np.float64]) -> float:
    """Return the largest distance between any two of some points, (N, 3).

    Points are visited from the farthest from their centre on, in blocks, until the sum of two
    remaining distances from the centre cannot exceed the best distance found. So spheres and slim
    things need few blocks, and nothing needs more than all.
    """
    points = np.unique(points, axis=0)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    away = _lengths(points - middle)
    order = np.argsort(-away, kind="stable")
    points, away, best = points[order], away[order], 0.0
    for start in range(0, len(points), _BLOCK):
        if 2.0 * away[start] <= best:
            break
        block = points[start : start + _BLOCK]
        # no farther point can improve the result
        reach = np.searchsorted(-away, away[start] - best, side="right")
        others = points[start : max(int(reach), start + 1)]
        for one in range(0, len(others), 16 * _BLOCK):
            apart = block[:, np.newaxis] - others[np.newaxis, one : one + 16 * _BLOCK]
            best = max(best, float(_lengths(apart).max()))
    return best


def _lengths(vectors: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, z = vectors[..., 0], vectors[..., 1], vectors[..., 2]
    return np.sqrt(x * x + y * y + z * z)
