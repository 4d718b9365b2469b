"""Reader of glTF 2.0, as .gltf and .glb.

In: the bytes of a file, and the buffers and images that it names. Out: a `Document` whose tree
holds the file as plain data, and whose objects are those of the default scene. Warnings name
unsupported content. Source: Khronos, "glTF 2.0 Specification", 2021.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...reading.documents import Document
from ...reading.reader_registry import Reader
from ...reading.sources import Source
from ...scenes.document_trees import TreeRecord
from ...scenes.tree_objects import tree_counts, tree_objects
from ...scenes.tree_posing import shown_nodes
from .gltf_accessors import GltfAccessors
from .gltf_buffers import GltfBuffers
from .gltf_draco import GltfDraco
from .gltf_extensions import check_extensions
from .gltf_file import GltfFile
from .gltf_lenses import read_cameras, read_lights
from .gltf_materials import GltfMaterials
from .gltf_meshes import GltfMeshes
from .gltf_motion import read_clips, read_skins
from .gltf_nodes import read_nodes, read_roots, with_fitting
from .gltf_primitives import GltfPrimitives
from .gltf_textures import GltfTextures
from .gltf_vrm import facing_forward

# One of these words occurs near the start of a glTF file, whichever list comes first.
_WORDS = (b'"asset"', b'"accessors"', b'"bufferView"', b'"extensionsUsed"')


def read_gltf(source: Source, split: bool = False) -> Document:
    """Read a glTF file, as `Reader.read`.

    With ``split``, poses are kept apart and meshes stay as stored; otherwise poses, skins and morph
    targets are applied.
    """
    file = GltfFile(source)
    check_extensions(file)
    buffers = GltfBuffers(file, source)
    tree, own = _read_tree(file, buffers, source.values)
    if file.lost is not None and not any(_draws(tree)):
        raise file.lost
    objects = tree_objects(source, tree, buffers.limit, split)
    counts = tree_counts(tree, objects)
    return Document(
        file.kind,
        objects,
        counts=counts,
        warnings=file.warnings.messages(),
        tree=tree,
        unit="m",
        arrays={"vertices": own, "faces": []},
    )


def _read_tree(file: GltfFile, buffers: GltfBuffers, values: bool) -> tuple[TreeRecord, list[str]]:
    """Return the tree, and the names of custom attributes."""
    accessors = GltfAccessors(file, buffers)
    lists = {
        "skins": read_skins(file, accessors),
        "cameras": read_cameras(file),
        "lights": read_lights(file),
    }
    nodes = read_nodes(file, accessors, lists)
    roots = read_roots(file, nodes)
    materials = GltfMaterials(file, GltfTextures(file, buffers))
    draco = GltfDraco(file, buffers)
    primitives = GltfPrimitives(file, accessors, materials, draco, values)
    meshes = GltfMeshes(file, buffers, primitives, materials).all()
    if primitives.left_out:
        first, count = primitives.left_out[0], len(primitives.left_out)
        file.warnings.add(f"{first} has no positions; {count} such primitives left out")
    nodes = with_fitting(file, nodes, meshes, lists["skins"].records)
    tree = TreeRecord(
        nodes=nodes,
        roots=roots,
        meshes=meshes,
        skins=lists["skins"].records,
        clips=read_clips(file, accessors, nodes, meshes, lists),
        cameras=lists["cameras"].records,
        lights=lists["lights"].records,
        materials=materials.all(),
        made_materials=materials.made(),
        variants=materials.variant_names(),
        extras=file.tree.get("extras"),
    )
    return facing_forward(file, tree), sorted(primitives.own)


def _draws(tree: TreeRecord) -> Iterator[bool]:
    """Return whether each shown node with a mesh has vertices."""
    for shown in shown_nodes(tree):
        mesh = tree.nodes[shown.number].mesh
        if shown.visible and mesh is not None:
            yield any(len(part.mesh.positions) for part in tree.meshes[mesh].parts)


def _resembles_gltf(head: bytes, size: int) -> bool:
    return head.lstrip().startswith(b"{") and any(word in head for word in _WORDS)


READERS = (
    Reader("gltf", "glTF 2.0, text", "mesh", (".gltf",), read_gltf, resembles=_resembles_gltf),
)
