"""Small vector, matrix and quaternion algebra, the same bits on every processor.

Conventions (those of pyrender, three.js and trimesh): right-handed, angles in radians, 4x4
matrices for column vectors (``world = multiply(world_from_object, object)``), quaternions
``x, y, z, w``, cameras that look down their own -Z with +Y up, poses that are world-from-object.

Everything is float64 and computed by single IEEE operations (``+ - * /``, square root), one element
at a time and in a fixed order. No BLAS, no ``einsum``, no ``numpy.linalg``, no ``libm``: those
round differently from one processor to the next, and an image would differ with them.
"""

from .matrices import (
    compose,
    decompose,
    inverse,
    multiply,
    normal_matrix,
    rotation_axis,
    rotation_x,
    rotation_y,
    rotation_z,
    scaling,
    transform_directions,
    transform_points,
    translation,
)
from .quaternions import (
    euler_to_quaternion,
    matrix_to_quaternion,
    quaternion_conjugate,
    quaternion_from_axis_angle,
    quaternion_multiply,
    quaternion_to_euler,
    quaternion_to_matrix,
)
from .trigonometry import atan2, cos, sin, tan, unit_circle
from .vectors import cross, dot, length, normalize
from .viewing import look_at, orthographic, perspective

__all__ = [
    "atan2",
    "compose",
    "cos",
    "cross",
    "decompose",
    "dot",
    "euler_to_quaternion",
    "inverse",
    "length",
    "look_at",
    "matrix_to_quaternion",
    "multiply",
    "normal_matrix",
    "normalize",
    "orthographic",
    "perspective",
    "quaternion_conjugate",
    "quaternion_from_axis_angle",
    "quaternion_multiply",
    "quaternion_to_euler",
    "quaternion_to_matrix",
    "rotation_axis",
    "rotation_x",
    "rotation_y",
    "rotation_z",
    "scaling",
    "sin",
    "tan",
    "transform_directions",
    "transform_points",
    "translation",
    "unit_circle",
]
