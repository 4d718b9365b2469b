"""Parameters of a material, each said once, as a row; see `Material`.

In: for each parameter its kind, what it is by default, a sentence, and what files call it. Out: the
attribute that checks what is assigned, and of all rows together the constructor's signature and the
class's docstring. Renderer, files, clips and editor read the rows for what else they need to know.
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
from ...choices import AlphaMode
from ...errors import InvalidArgumentError
from .colors import check_color, check_surface_color
from .textures import PlacedTexture, Texture

if TYPE_CHECKING:
    from typing_extensions import dataclass_transform
else:  # only type checkers read it

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
        As `CheckedAttribute` wants it.
    type : str
        The annotation of the parameter.
    words : str
        The same in docstrings.
    low, high : float
        From where to where clips and the editor may change it.
    width : int
        How many numbers it is; 0 if it is something else.
    """

    check: Callable[[Any, str], Any]
    type: str
    words: str
    low: float = -math.inf
    high: float = math.inf
    width: int = 0


def _above(least: float, words: str, *others: float) -> Callable[[float, str], float]:
    """A check of finite numbers from ``least`` on, and of a few others."""

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


SURFACE_COLOR = Kind(check_surface_color, "ColorLike", "sequence of 3 or 4 numbers", 0.0, width=4)
COLOR = Kind(check_color, "ColorLike", "sequence of 3 numbers", 0.0, width=3)
SHARE = Kind(fraction, "float", "float, from 0 to 1", 0.0, 1.0, 1)
SHARE_OR_NONE = Kind(optional_fraction, "float | None", "float, from 0 to 1, optional", 0.0, 1.0, 1)
NOT_NEGATIVE = Kind(not_negative, "float", "float, 0 or more", 0.0, width=1)
NUMBER = Kind(finite, "float", "float", width=1)
ANGLE = Kind(finite_angle, "float", "float", width=1)
AT_LEAST_ONE = Kind(_above(1.0, "1 or greater"), "float", "float, 1 or more", 1.0, width=1)
IOR = Kind(_above(1.0, "0, or 1 or greater", 0.0), "float", "float, 1 or more, or 0", 1.0, width=1)
REACH = Kind(_check_reach, "float", "float, greater than 0", 1e-9, width=1)
FLAG = Kind(flag, "bool", "bool")
TEXT = Kind(text, "str", "str")
DICT = Kind(_check_dict, "dict[str, Any] | None", "dict, optional")
ALPHA_MODE = Kind(
    one_of(ALPHA_MODES), "AlphaMode", "{" + ", ".join(f'"{mode}"' for mode in ALPHA_MODES) + "}"
)
TEXTURE = Kind(_check_texture, "SlotTexture", "Texture or PlacedTexture, optional")


class Parameter(CheckedAttribute[Given, Kept]):
    """A row: an attribute that is a keyword argument of the constructor as well.

    Parameters
    ----------
    kind : Kind
    default
        What the constructor takes where nothing is given.
    doc : str
        What it means.
    unit : str
        Of numbers that have one.
    gltf : str
        Where files of glTF have it: ``"sheen/key"`` of the extension KHR_materials_sheen, or
        ``"key"`` of the material itself. What follows a dot is beside a texture.
    """

    def __init__(
        self, kind: Kind, *, default: Given, doc: str, unit: str = "", gltf: str = ""
    ) -> None:
        super().__init__(kind.check)
        self.kind, self.default, self.doc, self.unit, self.gltf = kind, default, doc, unit, gltf

    @property
    def part(self) -> str:
        """The part of a material of glTF that it is in, an extension mostly."""
        part = self.gltf.rpartition("/")[0]
        return part if part in ("pbrMetallicRoughness", "") else f"KHR_materials_{part}"

    @property
    def title(self) -> str:
        """What it is called where people read it."""
        return self._name.replace("_", " ").replace("color", "colour").capitalize()

    @property
    def words(self) -> str:
        """What values it takes."""
        return f"{self.kind.words}, in {self.unit}" if self.unit else self.kind.words


class TextureSlot(Parameter[SlotTexture, SlotTexture]):
    """A texture of a material; the core lists them in csrc/include/e3d_material.h.

    Parameters
    ----------
    is_color : bool
        Whether its bytes are colours, to be read as the texture's ``color_space`` says; those of
        the others are numbers, and read as they are.
    default, doc, gltf
        As of `Parameter`.
    """

    def __init__(self, *, is_color: bool, default: None, doc: str, gltf: str = "") -> None:
        super().__init__(TEXTURE, default=default, doc=doc, gltf=gltf)
        self.is_color = is_color


def parameters_of(cls: type) -> dict[str, Parameter[Any, Any]]:
    """Return the rows of a class by name, in their order."""
    return {name: row for name, row in vars(cls).items() if isinstance(row, Parameter)}


@dataclass_transform(
    kw_only_default=True, eq_default=False, field_specifiers=(Parameter, TextureSlot)
)
def made_of_parameters(cls: Class) -> Class:
    """Give a class's constructor the signature, and the class the docstring, that its rows tell.

    In the docstring, the parameters take the place of the line "Each attribute below."
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
    if cls.__doc__ is not None:  # which -OO leaves out
        entries = "\n".join(
            f"{name} : {row.words}\n    {row.doc}".rstrip() for name, row in rows.items()
        )
        cls.__doc__ = inspect.cleandoc(cls.__doc__).replace("Each attribute below.", entries)
    return cls
