"""Types of arguments with few choices, so that editors complete them.

Each is defined once, here (outputs are in rendering/frame.py); modules accept the same list at run
time, which a test checks. The command line also takes its choices from here, and prints its help
without loading NumPy.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, Union

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "AlphaMode",
    "Antialiasing",
    "Backdrop",
    "Backend",
    "BuiltInEnvironment",
    "Color",
    "ColorLike",
    "ColorSpace",
    "Cull",
    "Culling",
    "EulerOrder",
    "Falloff",
    "Filter",
    "Forward",
    "FrameCull",
    "HiddenSurfaces",
    "ImageFormat",
    "Interpolation",
    "JointKind",
    "LengthUnit",
    "LightSetup",
    "LightShadow",
    "LineKind",
    "LineShape",
    "LookName",
    "Loop",
    "Mode",
    "MotionPath",
    "Normals",
    "OutputMode",
    "PageSize",
    "PathEnd",
    "PixelFormat",
    "PointShape",
    "PointerShape",
    "Samples",
    "Shading",
    "ShadowTaps",
    "ShapesOf",
    "SizeUnit",
    "SurfaceColor",
    "ToneMapping",
    "ValuesOn",
    "Wireframe",
    "Wrap",
]

Backend = Literal["auto", "scalar", "portable", "sse41", "avx2", "avx512", "neon"]
ColorSpace = Literal["srgb", "linear"]
Samples = Literal[1, 2, 4, 8, 16]
Antialiasing = Literal["ssaa", "msaa"]

Mode = Literal["lit", "unlit", "random", "depth", "normal", "face_id", "object_id", "overdraw"]
#: Further modes of the viewer and the command line: outputs as pictures. rendering/frame.py has the
#: few outputs that are none of these.
OutputMode = Literal[
    "albedo",
    "position",
    "world_position",
    "world_normal",
    "uv",
    "barycentric",
    "metallic_roughness",
    "emissive",
    "tangent",
    "radiance",
    "range",
    "instance_id",
    "material_id",
]
Wireframe = Literal["overlay", "only"]
Cull = Literal["none", "back", "front"]
#: Culling modes of frames: besides the common ones, back faces of closed meshes only.
FrameCull = Literal["none", "back", "front", "auto"]
Shading = Literal["deferred", "forward"]
Normals = Literal["auto", "smooth", "flat", "facet"]
HiddenSurfaces = Literal["zbuffer", "painter", "none"]
LineShape = Literal["plain", "round"]
PointShape = Literal["square", "round"]
SizeUnit = Literal["pixels", "picture"]
ValuesOn = Literal["vertices", "faces", "points"]
Culling = Literal["all", "tree", "frustum", "none", "always"]
ToneMapping = Literal["none", "neutral", "aces", "agx"]
Filter = Literal["trilinear", "bilinear", "nearest"]
Wrap = Literal["repeat", "clamp", "mirror"]
Falloff = Literal["inverse_square", "window", "gltf"]
LightSetup = Literal["studio", "headlight", "sun", "two colours"]
#: What models are drawn in: names of looks, and the words for their backgrounds.
LookName = Literal["studio", "plain"]
Backdrop = Literal["auto", "dark", "light", "scene"]
LightShadow = Literal["none", "map", "exact"]
ShadowTaps = Literal[1, 3, 5]
AlphaMode = Literal["opaque", "mask", "blend"]
BuiltInEnvironment = Literal["studio", "sky", "hall"]
MotionPath = Literal["translation", "rotation", "scale", "weights"]
Interpolation = Literal["step", "linear", "cubicspline"]
JointKind = Literal[
    "fixed", "revolute", "continuous", "prismatic", "floating", "planar", "spherical"
]
ShapesOf = Literal["visual", "collision", "both"]
Loop = Literal["repeat", "once", "ping-pong"]
#: What a node that follows a path does at its last point, and the axis of it that faces ahead.
PathEnd = Literal["close", "return", "restart", "stop"]
Forward = Literal["+X", "-X", "+Z", "-Z"]
ImageFormat = Literal["png", "jpg", "jpeg", "tga", "webp"]
PixelFormat = Literal["rgba", "bgra"]
PointerShape = Literal[
    "arrow",
    "text",
    "wait",
    "crosshair",
    "working",
    "size_nwse",
    "size_nesw",
    "size_we",
    "size_ns",
    "size_all",
    "no",
    "hand",
]
#: The kinds of lines of drawings. Where two coincide, the drawing has the one that is listed first.
#: ``section``: outlines of cut material; ``outline``: where a surface turns from the viewer;
#: ``border``: edges of one face only; ``crease``: sharp edges; ``intersection``: where bodies run
#: through each other; ``line``: lines of the model's own.
LineKind = Literal["section", "outline", "border", "crease", "intersection", "line"]
#: Pages of drawings, with the long side level.
PageSize = Literal["A4", "A3", "A2", "A1"]
LengthUnit = Literal["mm", "cm", "m", "µm", "in", "ft"]
EulerOrder = Literal["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"]

#: Three numbers: integers from 0 to 255 and floats from 0 to 1 are display values (sRGB), those of
#: `engine3d.linear` linear light.
Color: TypeAlias = tuple[float, float, float]
#: A colour, or four numbers: the last is alpha, from 0 to 1, or to 255 with integers.
SurfaceColor: TypeAlias = Color | tuple[float, float, float, float]
#: A colour, a name of CSS, or ``"#rgb"``, ``"#rrggbb"`` or ``"#rrggbbaa"``.
ColorLike: TypeAlias = Union[str, Sequence[float], "NDArray[Any]"]
