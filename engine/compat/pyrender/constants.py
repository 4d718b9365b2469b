"""Constants of pyrender: flags, modes of OpenGL and limits."""

DEFAULT_Z_NEAR = 0.05  # metres
DEFAULT_Z_FAR = 100.0
DEFAULT_SCENE_SCALE = 2.0
MAX_N_LIGHTS = 4  # of each kind, for each node
TARGET_OPEN_GL_MAJOR, TARGET_OPEN_GL_MINOR = 4, 1
MIN_OPEN_GL_MAJOR, MIN_OPEN_GL_MINOR = 3, 3
FLOAT_SZ = UINT_SZ = 4
SHADOW_TEX_SZ = 2048  # sides of shadow maps, in texels
TEXT_PADDING = 20


class RenderFlags:
    """Rendering flags, combined with ``|``."""

    NONE = 0
    DEPTH_ONLY = 1
    OFFSCREEN = 2
    FLIP_WIREFRAME = 4
    ALL_WIREFRAME = 8
    ALL_SOLID = 16  # changes nothing, as in pyrender
    SHADOWS_DIRECTIONAL = 32
    SHADOWS_POINT = 64
    SHADOWS_SPOT = 128
    SHADOWS_ALL = SHADOWS_DIRECTIONAL | SHADOWS_POINT | SHADOWS_SPOT
    VERTEX_NORMALS = 256  # for the viewer only; offscreen pictures ignore it, as in pyrender
    FACE_NORMALS = 512
    SKIP_CULL_FACES = 1024
    RGBA = 2048
    FLAT = 4096
    SEG = 8192


class TextAlign:
    """Positions of captions in the viewer."""

    CENTER, CENTER_LEFT, CENTER_RIGHT = 0, 1, 2
    BOTTOM_LEFT, BOTTOM_RIGHT, BOTTOM_CENTER = 3, 4, 5
    TOP_LEFT, TOP_RIGHT, TOP_CENTER = 6, 7, 8


class GLTF:
    """OpenGL constants used by glTF files."""

    NEAREST, LINEAR = 9728, 9729
    NEAREST_MIPMAP_NEAREST, LINEAR_MIPMAP_NEAREST = 9984, 9985
    NEAREST_MIPMAP_LINEAR, LINEAR_MIPMAP_LINEAR = 9986, 9987
    CLAMP_TO_EDGE, MIRRORED_REPEAT, REPEAT = 33071, 33648, 10497
    POINTS, LINES, LINE_LOOP, LINE_STRIP = 0, 1, 2, 3
    TRIANGLES, TRIANGLE_STRIP, TRIANGLE_FAN = 4, 5, 6


class BufFlags:
    """The vertex attributes of a primitive."""

    POSITION, NORMAL, TANGENT, TEXCOORD_0 = 0, 1, 2, 4
    TEXCOORD_1, COLOR_0, JOINTS_0, WEIGHTS_0 = 8, 16, 32, 64


class TexFlags:
    """The textures of a material."""

    NONE, NORMAL, OCCLUSION, EMISSIVE = 0, 1, 2, 4
    BASE_COLOR, METALLIC_ROUGHNESS, DIFFUSE, SPECULAR_GLOSSINESS = 8, 16, 32, 64


class ProgramFlags:
    """The purposes of pyrender's shaders."""

    NONE, USE_MATERIAL, VERTEX_NORMALS, FACE_NORMALS = 0, 1, 2, 4


__all__ = ["GLTF", "RenderFlags", "TextAlign"]
