"""Parameters of a material, each declared once, as a row; see `Material`.

In: each parameter's kind, default, description and name in files. Out: the attribute that checks
assignments and, from all rows together, the constructor's signature and the class's docstring.
Renderer, files, clips and editor read everything else from the rows.
"""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, TypeVar, get_args

from ...base.angles import finite_angle
from ...base.held_values import kept
from ...base.numbers import real, shown
from ...base.validation import (
    CheckedAttribute,
    Given,
    Kept,
    finite,
    flag,
    fraction,
    not_negative,
    one_of,
    optional_fraction,
    text,
)
from ...choices import AlphaMode, ColorLike, SurfaceColor
from ...errors import InvalidArgumentError
from .colors import check_color, check_surface_color
from .textures import PlacedTexture, Texture

if TYPE_CHECKING:
    from typing_extensions import dataclass_transform
else:  # only for type checkers

    def dataclass_transform(**how):
        return lambda decorator: decorator


ALPHA_MODES: tuple[AlphaMode, ...] = get_args(AlphaMode)
SlotTexture: TypeAlias = Texture | PlacedTexture | None
Class = TypeVar("Class", bound=type)


class Kind(NamedTuple):
    """The kind of values that a parameter takes.

    Attributes
    ----------
    check : callable
        The check function for `CheckedAttribute`.
    type : str
        The parameter's annotation.
    words : str
        The type as written in docstrings.
    low, high : float
        The range within which clips and the editor may change it.
    width : int
        How many numbers a value has; 0 if it is not numeric.
    is_color : bool
    apart : float, optional
        A number outside of the range that is allowed, too.
    """

    check: Callable[[Any, str], Any]
    type: str
    words: str
    low: float = -math.inf
    high: float = math.inf
    width: int = 0
    is_color: bool = False
    apart: float | None = None


def _above(least: float, words: str, *others: float) -> Callable[[float, str], float]:
    """Return a check that accepts finite numbers from ``least`` on, and a few given others."""

    def check(value: float, what: str) -> float:
        number = real(value)
        if not (number in others or least <= number < math.inf):
            raise InvalidArgumentError(f"{what} must be {words}, not {shown(value)}")
        return number

    return check


def _check_reach(value: float, what: str) -> float:
    number = real(value)
    if not number > 0:
        raise InvalidArgumentError(f"{what} must be greater than 0, not {shown(value)}")
    return number


def _check_dict(value: dict[str, Any] | None, what: str) -> dict[str, Any]:
    if value is None:
        return {}
    if not isinstance(value, dict):
        raise InvalidArgumentError(f"{what} must be a dict: {type(value).__name__}")
    return kept(value)


def _check_texture(value: SlotTexture, what: str) -> SlotTexture:
    if value is not None and not isinstance(value, (Texture, PlacedTexture)):
        raise InvalidArgumentError(f"{what} must be a Texture or None: {type(value).__name__}")
    return value


SURFACE_COLOR = Kind(
    check_surface_color, "ColorLike", "colour, also with alpha", 0.0, width=4, is_color=True
)
COLOR = Kind(check_color, "ColorLike", "colour", 0.0, width=3, is_color=True)
SHARE = Kind(fraction, "float", "float, from 0 to 1", 0.0, 1.0, 1)
SHARE_OR_NONE = Kind(optional_fraction, "float | None", "float, from 0 to 1, optional", 0.0, 1.0, 1)
NOT_NEGATIVE = Kind(not_negative, "float", "float, 0 or more", 0.0, width=1)
NUMBER = Kind(finite, "float", "float", width=1)
ANGLE = Kind(finite_angle, "float", "float", width=1)
AT_LEAST_ONE = Kind(_above(1.0, "1 or greater"), "float", "float, 1 or more", 1.0, width=1)
_check_ior = _above(1.0, "0, or 1 or greater", 0.0)
IOR = Kind(_check_ior, "float", "float, 1 or more, or 0", 1.0, width=1, apart=0.0)
REACH = Kind(_check_reach, "float", "float, greater than 0", 1e-9, width=1)
FLAG = Kind(flag, "bool", "bool")
TEXT = Kind(text, "str", "str")
DICT = Kind(_check_dict, "dict[str, Any] | None", "dict, optional")
ALPHA_MODE = Kind(
    one_of(ALPHA_MODES), "AlphaMode", "{" + ", ".join(f'"{mode}"' for mode in ALPHA_MODES) + "}"
)
TEXTURE = Kind(_check_texture, "SlotTexture", "Texture or PlacedTexture, optional")


class Parameter(CheckedAttribute[Given, Kept]):
    """A row: an attribute that is also a keyword argument of the constructor.

    Parameters
    ----------
    kind : Kind
    default
        The constructor's default.
    doc : str
        The description.
    unit : str
        The unit of a number, if any.
    gltf : str
        Where glTF files keep it: ``"sheen/key"`` in the extension KHR_materials_sheen, or ``"key"``
        in the material itself. A name after a dot is a property of the texture's reference.
    """

    def __init__(
        self, kind: Kind, *, default: Given, doc: str, unit: str = "", gltf: str = ""
    ) -> None:
        super().__init__(kind.check)
        self.kind, self.default, self.doc, self.unit, self.gltf = kind, default, doc, unit, gltf

    @property
    def part(self) -> str:
        """The part of a glTF material that holds it, usually an extension."""
        part = self.gltf.rpartition("/")[0]
        return part if part in ("pbrMetallicRoughness", "") else f"KHR_materials_{part}"

    @property
    def title(self) -> str:
        """The name shown to people."""
        return self._name.replace("_", " ").replace("color", "colour").capitalize()

    @property
    def words(self) -> str:
        """The values it takes, in words."""
        return f"{self.kind.words}, in {self.unit}" if self.unit else self.kind.words


class TextureSlot(Parameter[SlotTexture, SlotTexture]):
    """A texture slot of a material; the core lists the slots in csrc/include/e3d_material.h.

    Parameters
    ----------
    is_color : bool
        Whether the texture holds colours, decoded by its ``color_space``; other textures hold plain
        numbers.
    is_normals : bool
        Whether these numbers are directions, which spread within the texels of mip levels.
    default, doc, gltf
        As in `Parameter`.
    """

    def __init__(
        self,
        *,
        is_color: bool,
        is_normals: bool = False,
        default: None,
        doc: str,
        gltf: str = "",
    ) -> None:
        super().__init__(TEXTURE, default=default, doc=doc, gltf=gltf)
        self.is_color, self.is_normals = is_color, is_normals


class StatedColor(Parameter[ColorLike, SurfaceColor]):
    """The base colour: a material remembers that it was assigned."""

    def __set__(self, owner: object, value: ColorLike) -> None:
        super().__set__(owner, value)
        vars(owner)["_states_color"] = True


def parameters_of(cls: type) -> dict[str, Parameter[Any, Any]]:
    """Return the rows of a class by name, in order."""
    return {name: row for name, row in vars(cls).items() if isinstance(row, Parameter)}


@dataclass_transform(
    kw_only_default=True, eq_default=False, field_specifiers=(Parameter, StatedColor, TextureSlot)
)
def made_of_parameters(cls: Class) -> Class:
    """Build a class's constructor signature and docstring from its rows.

    In the docstring, the parameters replace the line "Each attribute below."
    """
    rows = parameters_of(cls)
    mine = inspect.Parameter("self", inspect.Parameter.POSITIONAL_OR_KEYWORD)
    keywords = [
        inspect.Parameter(
            name, inspect.Parameter.KEYWORD_ONLY, default=row.default, annotation=row.kind.type
        )
        for name, row in rows.items()
    ]
    made = inspect.unwrap(cls.__init__)  # type: ignore[misc]  # a class's own
    made.__signature__ = inspect.Signature([mine, *keywords], return_annotation="None")
    if cls.__doc__ is not None:  # -OO removes docstrings
        entries = "\n".join(
            f"{name} : {row.words}\n    {row.doc}".rstrip() for name, row in rows.items()
        )
        cls.__doc__ = inspect.cleandoc(cls.__doc__).replace("Each attribute below.", entries)
    return cls
