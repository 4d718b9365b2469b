"""Call checks: hints for unknown keywords, and errors for wrong argument types.

In: annotated functions. Out: the same functions. `hinted` costs only one more call; `checks_types`
checks each argument, and is not for functions called per node or number. Functions check themselves
what annotations cannot express (a range, a shape).
"""

from __future__ import annotations

import ast
import functools
import inspect
import numbers
import sys
from collections.abc import Callable, Iterable, Mapping
from types import UnionType
from typing import Any, Literal, TypeVar, Union, cast, get_args, get_origin, is_typeddict

import numpy as np

from ..errors import InvalidArgumentError, OutOfMemoryError
from .foreign_names import Kind, hint
from .memory import is_lack_of_memory
from .numbers import shown

Function = TypeVar("Function", bound=Callable[..., Any])
#: A test of a value, and words for the values that pass.
_Kind = tuple[Callable[[Any], bool], str]


def hinted(function: Function, owner: type | None = None) -> Function:
    """Make a function suggest a keyword when it gets an unknown one.

    Parameters
    ----------
    function : callable
    owner : type, optional
        The class whose constructor it is.
    """

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            if _is_of_the_call(error):
                _raise_hint(function, owner, args, kwargs)
            raise

    return cast(Function, call)


def checks_types(function: Function) -> Function:
    """Make a function refuse arguments whose types differ from its annotations."""
    found: dict[str, _Kind | None] = {}  # filled at the first call: all names are defined by then

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        if not found:
            found.update(_kinds_of(function))
        for name, value in (*zip(found, args, strict=False), *kwargs.items()):
            kind = found.get(name)
            if kind is not None and not kind[0](value):
                _refuse_two_sides(function, args, kwargs)
                raise InvalidArgumentError(f"{name} must be {kind[1]}, not {shown(value)}")
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            if _is_of_the_call(error):
                _raise_hint(function, None, args, kwargs)
            raise
        except (OSError, ImportError) as error:  # of a module that is imported when used
            if is_lack_of_memory(error):
                raise OutOfMemoryError(f"no memory for {_name(function)}: {error}") from error
            raise

    return cast(Function, call)


def _is_of_the_call(error: TypeError) -> bool:
    """Return whether the error was raised by the call itself, before the function ran."""
    return error.__traceback__ is not None and error.__traceback__.tb_next is None


def hints_keywords(kind: Kind) -> Kind:
    """Make a class's constructor suggest keywords, as `hinted` does."""
    kind.__init__ = hinted(kind.__init__, kind)  # type: ignore[misc]
    return kind


def shows_annotations(kind: Kind) -> Kind:
    """Make ``help`` show a named tuple's types as written."""
    written = {name: each.__forward_arg__ for name, each in kind.__annotations__.items()}
    kind.__new__.__annotations__ = written
    return kind


def _raise_hint(
    function: Callable[..., Any],
    owner: type | None,
    arguments: tuple[Any, ...],
    keywords: Mapping[str, Any],
) -> None:
    """Raise a TypeError that tells what is wrong with a call, if there is more to tell."""
    _refuse_two_sides(function, arguments, keywords)
    refuse_unknown(owner or _name(function), keywords, inspect.signature(function).parameters)


def _name(function: Callable[..., Any]) -> str:
    return function.__qualname__.removesuffix(".__init__")


def _refuse_two_sides(
    function: Callable[..., Any], arguments: tuple[Any, ...], keywords: Mapping[str, Any]
) -> None:
    """Raise a TypeError where a size was given as a width and a height."""
    parameters = inspect.signature(function).parameters
    if "size" not in parameters or not parameters["size"].annotation.startswith(_SIZE):
        return
    place = list(parameters).index("size")
    numbered = [isinstance(each, numbers.Real) for each in arguments[place : place + 2]]
    if numbered == [True, True] or "width" in keywords or "height" in keywords:
        raise TypeError(
            f"{_name(function)}() takes size=(width, height), not a width and a height"
        ) from None


@functools.cache
def keywords_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Return the names that a function takes as keywords alone, but for those of ``**``."""
    parameters = inspect.signature(function).parameters.values()
    return tuple(each.name for each in parameters if each.kind is each.KEYWORD_ONLY)


def refuse_unknown(owner: type | str, keywords: Iterable[str], known: Iterable[str]) -> None:
    """Raise a TypeError, with a hint, for the first unknown keyword.

    Parameters
    ----------
    owner : type or str
        The class to construct, or the name of the function.
    keywords, known : iterable of str
    """
    for word in keywords:
        if word not in known:
            name = owner if isinstance(owner, str) else owner.__name__
            raise TypeError(
                f"{name}() got an unexpected keyword argument {word!r}{hint(owner, word, known)}"
            ) from None


def _kinds_of(function: Callable[..., Any]) -> dict[str, _Kind | None]:
    """Return the types of each parameter; None where anything is allowed."""
    return {
        name: _kind(ast.parse(parameter.annotation, mode="eval").body, function)
        if isinstance(parameter.annotation, str) and name not in ("self", "cls")
        else None
        for name, parameter in inspect.signature(function).parameters.items()
        if parameter.kind not in (parameter.VAR_POSITIONAL, parameter.VAR_KEYWORD)
    }


def _kind(node: ast.expr, function: Callable[..., Any]) -> _Kind | None:
    """Return the types that an annotation in Python's syntax allows."""
    if isinstance(node, ast.BinOp):
        return _either([_kind(part, function) for part in (node.left, node.right)])
    if isinstance(node, ast.Constant):
        return _NOTHING if node.value is None else None
    of, whole = "", node
    if isinstance(node, ast.Subscript):
        of, node = ast.unparse(node.slice), node.value
    name = ast.unparse(node)
    if name in _UNCHECKED or ast.unparse(whole) == _SIZE:  # `check_size` says more
        return None
    if name == "Literal":
        return _kind_of(Literal[ast.literal_eval(of)], name)
    if _PLAIN.get(name) is _MANY and of.isidentifier():
        return _is_many, f"several {of}"
    return _PLAIN[name] if name in _PLAIN else _kind_of(_named(name, function), name)


def _named(name: str, function: Any) -> Any:
    """Return what a name in a function's module means, possibly only to type checkers."""
    if name in function.__globals__:
        return function.__globals__[name]
    modules = [sys.modules.get(f"engine3d.{module}") for module in _MODULES]
    found = (vars(module).get(name) for module in modules if module is not None)
    return next((each for each in found if each is not None), None) or _public(name)


def _public(name: str) -> Any:
    package = sys.modules["engine3d"]
    return getattr(package, name) if name in package.__all__ else None


def _kind_of(named: Any, name: str) -> _Kind | None:
    """Return the types that a class or an alias allows."""
    origin = get_origin(named)
    if origin in (Union, UnionType):
        return _either([_kind_of(each, getattr(each, "__name__", "")) for each in get_args(named)])
    if origin is Literal:
        allowed = get_args(named)
        texts = all(isinstance(each, str) for each in allowed)
        return (_is_choice(allowed), f"one of {', '.join(map(repr, allowed))}") if texts else None
    if origin is not None:
        return _PLAIN.get(origin.__name__)
    if named is type(None):
        return _NOTHING
    if not isinstance(named, type) or named in (object, Any):
        return None
    if name in _PLAIN or is_typeddict(named):
        return _PLAIN.get(name, _MAPPING)
    return lambda value: isinstance(value, named), f"{'an' if name[0] in 'AEIOU' else 'a'} {name}"


def _either(kinds: list[_Kind | None]) -> _Kind | None:
    known = [kind for kind in kinds if kind is not None]
    if len(known) < len(kinds):
        return None
    return lambda value: any(fits(value) for fits, _ in known), " or ".join(w for _, w in known)


def _is_choice(allowed: tuple[str, ...]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, str) and value in allowed


def is_flag(value: Any) -> bool:
    """Return whether a value is True or False or equivalent: NumPy's bool, 0 or 1."""
    return isinstance(value, (bool, np.bool_)) or (isinstance(value, int) and value in (0, 1))


def _is_path(value: Any) -> bool:
    return hasattr(value, "__fspath__") or isinstance(value, bytes)


def _is_many(value: Any) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, (str, bytes))


def _is_file(value: Any) -> bool:
    return hasattr(value, "read") or hasattr(value, "write")


_SIZE = "tuple[int, int]"  # the annotation of sizes of pictures
_UNCHECKED = ("Any", "ArrayLike", "Backend")  # for the last, a BackendError says more
_MODULES = ("datasets", "batch", "loaders", "choices")  # annotations use their names
_NOTHING: _Kind = (lambda value: value is None, "None")
_MANY: _Kind = (_is_many, "several things")
_MAPPING: _Kind = (lambda value: isinstance(value, Mapping), "a dict")
_PLAIN: dict[str, _Kind] = {
    "bool": (is_flag, "True or False"),
    "int": (lambda value: isinstance(value, numbers.Integral), "a whole number"),
    "float": (lambda value: isinstance(value, numbers.Real), "a number"),
    "str": (lambda value: isinstance(value, str), "a str"),
    "bytes": (lambda value: isinstance(value, (bytes, bytearray, memoryview)), "bytes"),
    "os.PathLike": (_is_path, "a path"),
    "BinaryIO": (_is_file, "a file"),
    "Callable": (callable, "a function"),
    "Iterable": _MANY,
    "Sequence": _MANY,
    "list": _MANY,
    "tuple": _MANY,
    "Mapping": _MAPPING,
    "dict": _MAPPING,
    "NDArray": (lambda value: isinstance(value, np.ndarray), "an array"),
}
