"""Opens a model file as a `ViewedScene`.

In: a path, and a texture or colour for meshes without materials. Out: a scene, the format's usual
up direction, and the file's counts and warnings.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, cast

from ..base.language import translated, translated_number
from ..choices import ColorLike
from ..errors import InvalidArgumentError, printable, warn
from ..io.loaders import load_document, load_texture
from ..io.reading.documents import Document
from ..io.reading.sources import File
from ..io.scenes.scene_loading import scene_from_document
from ..model.geometry.mesh import Mesh
from ..model.geometry.twins import take_over
from ..model.materials.material import Material, says_something, textures_of
from ..model.materials.textures import Texture
from ..model.motion.periods import common_period
from ..model.scene.animation import motions_of
from ..model.scene.scene import Scene
from .appearance import BARE
from .coloring import Coloring
from .overlays.numbers import Numbers
from .painting import dress
from .scenes_of_things import is_lit
from .viewed_scene import ViewedScene
from .views.flat_sides import has_no_front
from .visibility import DRAWABLE, mesh_of


def color_by(viewed: ViewedScene, document: Document, numbers: Numbers) -> None:
    """Colour a model's meshes by numbers instead of their own colours.

    Parameters
    ----------
    viewed : ViewedScene
    document : Document
        The document that the scene was made from; both hold the same meshes.
    numbers : Numbers

    Raises
    ------
    InvalidArgumentError
        The file has no such numbers.
    """
    try:
        things = [(entry.mesh, entry.pose) for entry in document.objects]
        coloring = Coloring(numbers, things, viewed.up, document.unit)
    except InvalidArgumentError as error:
        if viewed.path is None:
            raise
        raise InvalidArgumentError(f"{printable(viewed.path)}: {error}") from None
    for mesh in dict.fromkeys(mesh for mesh, _ in things):
        take_over(mesh, coloring.colored(mesh))
    viewed.bar = coloring.bar


def open_model(
    path: File, *, animation: Callable[[ViewedScene], object] | None = None, **options: Any
) -> ViewedScene:
    """Load a file for viewing.

    Parameters
    ----------
    path : path-like or binary file object
        A file of any format that `engine3d.loaders` reads.
    animation : callable, optional
        Called with the `ViewedScene`, to play its animations or hold them at a time.
    **options
        Options of `read_model`.

    Returns
    -------
    ViewedScene

    Raises
    ------
    FileFormatError, FileAccessError
        The file (or the texture asked for) cannot be read.
    InvalidArgumentError
        The file has no such variant, numbers or animation.
    """
    viewed, _ = read_model(path, **options)
    if animation is not None:
        animation(viewed)
    return viewed


def read_model(
    path: File,
    *,
    texture: File | None = None,
    color: ColorLike | None = None,
    variant: str | int | None = None,
    numbers: Numbers | None = None,
    **options: Any,
) -> tuple[ViewedScene, Document]:
    """Load a file for viewing, to be coloured by other numbers later.

    Parameters
    ----------
    path : path-like or binary file object
        A file of any format that `engine3d.loaders` reads.
    texture : path-like, optional
        The base colour texture of the meshes without materials.
    color : (3,) sequence, optional
        The base colour of the meshes without materials.
    variant : str or int, optional
        As in `engine3d.load_scene`.
    numbers : Numbers, optional
        Colours the meshes by a number of their vertices or faces, instead of the file's colours.
    **options
        Options of `engine3d.loaders.load_document`; a texture or colour disables its ``companion``
        image.

    Returns
    -------
    ViewedScene, Document

    Raises
    ------
    FileFormatError, FileAccessError
        The file (or the texture asked for) cannot be read.
    InvalidArgumentError
        The file has no such variant or numbers.
    """
    image = None if texture is None else load_texture(texture)
    is_dressed = image is not None or color is not None
    if is_dressed:
        options["companion"] = _no_image
    document = load_document(path, values=numbers is not None, **options)
    is_named = not hasattr(path, "read")
    name = os.fsdecode(cast("str | os.PathLike[str]", path)) if is_named else None
    is_plain = _states_nothing(document)
    if is_dressed:
        _dress([mesh for _, mesh, _ in document.objects if not has_materials(mesh)], image, color)
    viewed = view_document(document, name, variant)
    viewed.may_turn = is_plain
    if numbers is not None:
        color_by(viewed, document, numbers)
        # Tone mapping would change the colours shown in the bar.
        viewed.appearance = {**viewed.appearance, "tone_mapping": "none"}
    return viewed, document


def view_document(
    document: Document, path: str | None, variant: str | int | None = None
) -> ViewedScene:
    """Return a document as a scene for viewing; see `open_model`."""
    scene = scene_from_document(document, variant)
    # glTF defines the visible sides per material; other files do not, or are often wrong.
    appearance: dict[str, Any] = {"cull": "back" if document.states_sides else "auto"}
    is_bare = document.is_scene and is_lit(scene)
    return ViewedScene(
        scene,
        "model" if path is None else printable(os.path.basename(path)),
        up=document.up,
        **_motion_of(scene),
        themed=not is_bare,
        is_scene=document.is_scene,
        appearance=appearance | (BARE if is_bare else {}),
        path=path,
        format=document.format,
        details=document_lines(document),
        warnings=list(scene.warnings),
        unit=document.unit,
        model_edges=document.model_edges,
    )


def _motion_of(scene: Scene) -> dict[str, Any]:
    """Return what moves a scene, and after how many seconds it repeats."""
    if scene.animator is None:
        return {}
    period = common_period(motions_of(scene.animator))
    return {"update": scene.animator.seek, **({} if period is None else {"period": period})}


def _no_image(path: str) -> bool:
    return False


def has_materials(mesh: Mesh) -> bool:
    """Return whether any material of a mesh defines its appearance; a name alone does not."""
    return any(map(says_something, mesh.materials))


def _states_nothing(document: Document) -> bool:
    """Return whether no mesh of a model that stands still states a material or colours."""
    if document.is_scene:
        return False
    return all(map(has_no_front, (entry.mesh for entry in document.objects)))


def _dress(meshes: list[Mesh], image: Texture | None, color: ColorLike | None) -> None:
    """Give the meshes' materials the image and the colour; warn of an image that does not show."""
    if image is not None and not meshes:
        warn("the model has materials of its own: it gets no other texture")
    elif image is not None and all(mesh.uvs is None for mesh in meshes):
        warn("the model has no texture coordinates: the texture does not show")
    for material in (material for mesh in meshes for material in mesh.materials):
        if image is not None:
            material.texture = image
        if color is not None:
            material.color = color


def dress_scene(viewed: ViewedScene, color: ColorLike) -> None:
    """Give a scene a colour: a model all over; others where they have no texture and do not glow.

    It warns if nothing gets the colour.
    """
    nodes = viewed.scene.nodes
    things = [node.object for node in nodes if isinstance(node.object, DRAWABLE)]
    painted = viewed.format is not None
    for mesh in map(mesh_of, things):
        if viewed.format is not None:
            dress(mesh, Material(color=color))
            mesh.colors = None
            continue
        plain = [material for material in mesh.materials if _is_plain(material)]
        for material in plain:
            material.color = color
        if len(plain) == len(mesh.materials):
            mesh.colors = None
        painted = painted or bool(plain)
    if not painted:
        warn("all that the scene holds has textures or glows: it gets no other colour")


def _is_plain(material: Material) -> bool:
    """Return whether a material shows only a plain colour."""
    glows = material.unlit or any(material.emissive)
    return not textures_of(material) and not glows


def document_lines(document: Document) -> list[str]:
    """Return the format and the counts of a document, one per line."""
    lines = [f"{translated('format'):<12}{document.format:>11}"]
    if document.unit:
        lines.append(f"{translated('unit'):<12}{document.unit:>11}")
    for name, entries in document.counts.items():
        count = entries if isinstance(entries, int) else len(entries)
        if count:
            lines.append(f"{translated(name):<12}{translated_number(count, '>11,d')}")
    return lines
