"""glTF 2.0, as .gltf and .glb.

In: the bytes of a file, and the buffers and images that it names. Out: a `Document` with one object
for each primitive of each node of the scene. What the file says besides (skins, animations, further
maps, extensions) is told in warnings. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

from ..geometry.mesh import Mesh
from .documents import Document
from .gltf_buffers import GltfBuffers
from .gltf_extensions import check_extensions, warn_of_unread
from .gltf_file import GLB, GltfFile
from .gltf_materials import GltfMaterials
from .gltf_nodes import placed_meshes
from .gltf_primitives import GltfPrimitives
from .posed_parts import PosedPart, counts_of, document_objects
from .registry import Reader
from .sources import Source
from .undrawn import warn_of_undrawn
from .warning_list import WarningList

# Each takes some kilobytes, or a part of a millisecond, however little the file says of it.
_MAX_OBJECTS = 50_000
_MAX_PRIMITIVES = 10_000


def read_gltf(source: Source, split: bool = False) -> Document:
    """Read a glTF file.

    Parameters
    ----------
    source : Source
    split : bool
        Keep the nodes' poses apart; otherwise they are applied.

    Raises
    ------
    FileFormatError
        It is damaged, or needs an extension that is not read.
    """
    file = GltfFile(source)
    warnings = WarningList(source.path)
    check_extensions(file, warnings)
    placed = placed_meshes(file, warnings)
    buffers = GltfBuffers(file, source)
    materials = GltfMaterials(file, buffers, warnings)
    primitives = GltfPrimitives(file, buffers, materials)
    meshes: dict[int, list[Mesh]] = {}
    parts, made = [], 0
    for node in placed:
        if node.mesh not in meshes:
            meshes[node.mesh] = _meshes(file, primitives, node.mesh)
            made += len(meshes[node.mesh])
            if made > _MAX_PRIMITIVES:
                raise file.error(f"more than {_MAX_PRIMITIVES} primitives")
        shown = meshes[node.mesh]
        names = [node.name] if len(shown) == 1 else [f"{node.name}_{k}" for k in range(len(shown))]
        parts += [PosedPart(*pair, node.pose) for pair in zip(names, shown, strict=True)]
        if len(parts) > _MAX_OBJECTS:
            raise file.error(f"more than {_MAX_OBJECTS} objects")
    objects = document_objects(source, parts, buffers.limit, split)
    if primitives.left_out:
        first, count = primitives.left_out[0], len(primitives.left_out)
        warnings.add(f"{first} has no positions; {count} such primitives left out")
    warn_of_undrawn(materials.undrawn(), warnings)
    warn_of_unread(file, {node.mesh for node in placed}, warnings)
    counts = {**counts_of(objects), "materials": materials.names()}
    return Document(file.kind, objects, counts=counts, warnings=warnings.messages())


def _meshes(file: GltfFile, primitives: GltfPrimitives, index: int) -> list[Mesh]:
    """One mesh for each primitive of a mesh."""
    entry = file.entries("meshes")[index]
    where = f"meshes[{index}]"
    found = []
    entries = file.entries("primitives", entry, f"{where}.")
    if len(entries) > _MAX_PRIMITIVES:
        raise file.error(f"{where} has more than {_MAX_PRIMITIVES} primitives")
    for number, primitive in enumerate(entries):
        name = str(entry.get("name") or f"mesh_{index}")
        mesh = primitives.read(primitive, f"{where}.primitives[{number}]", name)
        if mesh is not None:
            found.append(mesh)
    return found


def _is_glb(head: bytes) -> bool:
    return head.startswith(GLB)


def _resembles_gltf(head: bytes, size: int) -> bool:
    return head.lstrip().startswith(b"{") and b'"asset"' in head


READERS = (
    Reader("gltf", "glTF 2.0", "mesh", (".gltf", ".glb"), read_gltf, _is_glb, _resembles_gltf),
)
