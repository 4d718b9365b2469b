"""Writes docs/api.md from the docstrings and signatures of the public names.

    python docs/make_api.py            write it
    python docs/make_api.py --check    exit with 1 if it is out of date

In: `engine3d.__all__`, the `__all__` of its public modules, NumPy-style docstrings. Out: one
Markdown page, the same on every version of Python. A test keeps it up to date.
"""

from __future__ import annotations

import inspect
import re
import sys
from pathlib import Path

from generated_page import write_or_check

import engine3d
from engine3d._support.validation import CheckedAttribute

PAGE = Path(__file__).resolve().parent / "api.md"
INTRODUCTION = """\
# API

Made from the docstrings by `docs/make_api.py`. What holds everywhere (axes, spaces, colours, units,
shapes of outputs) is in [conventions.md](conventions.md). Everything here is imported by
`import engine3d as e3d` and read as `e3d.NAME`, modules included; type checkers find the types in
the package's stubs and annotations.
"""
#: Title of a chapter -> its names; together they are `engine3d.__all__`.
CHAPTERS = {
    "Drawing": ("render", "Renderer", "RenderOptions", "Frame", "backends"),
    "Scenes": (
        "Scene",
        "Node",
        "NodeSelection",
        "InstancedMesh",
        "DirectionalLight",
        "PointLight",
        "SpotLight",
        "HemisphereLight",
        "LightProbe",
        "Environment",
        "Gradient",
        "Fog",
        "ExponentialFog",
        "Animator",
        "AnimationPlayer",
        "AnimationClip",
        "Channel",
        "Skin",
        "BoxCollider",
        "SphereCollider",
        "MeshCollider",
        "ColliderHit",
        "RayHit",
        "RayHits",
    ),
    "Cameras": (
        "PerspectiveCamera",
        "OrthographicCamera",
        "IntrinsicsCamera",
        "Camera",
        "look_at",
        "orbit",
        "frame_bounds",
        "frame_scene",
    ),
    "Meshes": ("Mesh", "MorphTarget", "Material", "Texture", "PlacedTexture"),
    "Primitives": (
        "box",
        "hexahedron",
        "plane",
        "quad",
        "uv_sphere",
        "icosphere",
        "cylinder",
        "torus",
    ),
    "Worlds": ("city", "World", "NavigationGrid", "Walker"),
    "Levels of detail": ("DetailedInstances", "DetailedMeshes", "Impostor", "simplify"),
    "Files": (
        "load_mesh",
        "load_texture",
        "load_scene",
        "save_mesh",
        "save_scene",
        "save_animation",
        "Resources",
        "Resource",
        "ResourceStats",
    ),
    "Windows": ("show", "Window"),
    "The canvas": ("Canvas",),
    "Low-level rasterization": ("rasterize", "RasterizeResult"),
    "Errors": (
        "Engine3DError",
        "InvalidArgumentError",
        "FileFormatError",
        "FileAccessError",
        "BackendError",
        "OutOfMemoryError",
        "DisplayError",
        "MissingOutputError",
        "SceneChangedError",
        "RendererBusyError",
        "Engine3DWarning",
    ),
}
#: Modules whose functions are written out here; those of the other modules are public names too.
MODULES = ("batch", "datasets", "events", "linalg", "loaders")
#: Classes that a user never makes: they come without a constructor.
MADE_BY_OTHERS = ("Node", "Frame", "RasterizeResult", "World")
PLAIN_NAMES = ("__version__", "choices", "errors", "primitives")


def page() -> str:
    """Return the whole page."""
    parts = [INTRODUCTION, table_of_contents()]
    for title, names in CHAPTERS.items():
        parts.append(f"## {title}\n")
        parts += [entry(name, getattr(engine3d, name)) for name in names]
    for module_name in MODULES:
        module = getattr(engine3d, module_name)
        parts.append(f"## Module `{module_name}`\n\n{prose(inspect.getdoc(module))}\n")
        parts += [
            entry(f"{module_name}.{name}", getattr(module, name))
            for name in module.__all__
            if not hasattr(engine3d, name)
        ]
    return "\n".join(parts)


def table_of_contents() -> str:
    """Return a list of the chapters and what is in them."""
    lines = []
    for title, names in CHAPTERS.items():
        links = ", ".join(f"[{name}](#{name.lower()})" for name in names)
        lines.append(f"- **{title}**: {links}")
    lines += [f"- **[Module `{name}`](#module-{name})**" for name in MODULES]
    return "\n".join(lines) + "\n"


def entry(name: str, thing) -> str:
    """Return the section of one public name."""
    short = name.rpartition(".")[2]
    if inspect.isclass(thing):
        bases = [base.__name__ for base in thing.__bases__ if base is not object]
        is_error = issubclass(thing, (Exception, Warning))
        heading = f"class {short}({', '.join(bases)})" if is_error else short + signature(thing)
    else:
        heading = short + signature(thing)
    parts = [f"### {name}\n"]
    if name not in MADE_BY_OTHERS:
        parts.append(f"```text\n{wrapped(heading)}\n```\n")
    parts.append(docstring(thing) + "\n")
    return "\n".join(parts + (members(thing) if inspect.isclass(thing) else []))


def members(owner: type) -> list[str]:
    """Return the documented properties and methods of a class, in the order of the source."""
    properties, methods, checked = [], [], []
    for name, member in vars(owner).items():
        if name.startswith("_"):
            continue
        if isinstance(member, (classmethod, staticmethod)) or inspect.isfunction(member):
            function = getattr(owner, name)
            heading = wrapped(f"{owner.__name__}.{name}{signature(function)}")
            methods.append(f"```text\n{heading}\n```\n\n{docstring(function)}\n")
        elif is_documented_property(member):
            text = docstring(member).replace("\n", "\n  ").replace("\n  \n", "\n\n")
            properties.append(f"- `{name}` : {text}")
        elif isinstance(member, CheckedAttribute):
            checked.append(f"`{name}`")
    if checked:
        methods.insert(0, f"To read and to assign at any time, as above: {', '.join(checked)}.\n")
    return (["\n".join(properties) + "\n"] if properties else []) + methods


def is_documented_property(member) -> bool:
    """Whether a descriptor has a docstring of its own (the fields of a named tuple don't)."""
    text = getattr(member, "__doc__", None) or ""
    if text == type(member).__doc__:
        return False
    return hasattr(type(member), "__get__") and text and not text.startswith("Alias for field")


def signature(thing) -> str:
    """Return the parameters and their defaults; their types are in the docstring."""
    try:
        parameters = inspect.signature(thing).parameters.values()
    except (TypeError, ValueError):
        return ""
    plain = [p.replace(annotation=inspect.Parameter.empty) for p in parameters]
    return str(inspect.Signature([p for p in plain if p.name != "self"]))


def wrapped(heading: str) -> str:
    """Break a long signature after its commas."""
    if len(heading) <= 96:
        return heading
    lines, room = [""], 96
    for piece in re.split(r"(?<=, )(?=[a-z_*])", heading):
        if len(lines[-1]) + len(piece) > room:
            lines.append("    ")
        lines[-1] += piece
    return "\n".join(line.rstrip() for line in lines)


def docstring(thing) -> str:
    """Return a NumPy-style docstring as Markdown."""
    text = inspect.getdoc(thing) or ""
    pieces = re.split(r"^([A-Z][a-z]+)\n-{3,}\n", text, flags=re.MULTILINE)
    parts = [prose(pieces[0])]
    for title, body in zip(pieces[1::2], pieces[2::2], strict=True):
        parts.append(f"**{title}**\n\n{items(body) if is_list(title) else prose(body)}")
    return "\n\n".join(part for part in parts if part)


def is_list(title: str) -> bool:
    return title in ("Parameters", "Attributes", "Returns", "Raises", "Yields")


def items(body: str) -> str:
    """Return the entries of a section: a line that isn't indented begins one."""
    lines = []
    for line in body.strip().splitlines():
        if not line.strip():
            continue
        if line.startswith(" "):
            lines.append(f"  {code(line.strip())}")
        else:
            name, colon, kind = line.partition(" : ")
            lines.append(f"- `{name.strip()}`" + (f" : {code(kind.strip())}" if colon else ""))
    return "\n".join(lines)


def prose(text: str) -> str:
    return code(text.strip())


def code(text: str) -> str:
    """Turn reStructuredText's double backticks into Markdown's single ones."""
    return text.replace("``", "`")


def check_complete() -> None:
    """Every public name has its place on the page."""
    written = {name for names in CHAPTERS.values() for name in names} | {*MODULES, *PLAIN_NAMES}
    wrong = written ^ set(engine3d.__all__)
    if wrong:
        raise SystemExit(f"docs/make_api.py: chapters and engine3d.__all__ differ in {wrong}")


def main(arguments: list[str]) -> int:
    check_complete()
    return write_or_check(PAGE, page(), arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
