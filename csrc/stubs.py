"""Writes the stubs of the compiled modules, engine/_native/*.pyi, from their .pyx files.

In:  a .pyx file and what it includes: functions and classes, with the C types of their parameters;
     what C cannot say is annotated there, as `parameter: type` and `-> type`.
Out: what type checkers and editors know of the module. The docstrings stay where they are written.
"""

import re
from pathlib import Path

from headers import split
from mirrors import write

HEAD = '''"""Written by csrc/stubs.py from {}, where the docstrings are."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import DTypeLike, NDArray
'''
SIZES = [f"{u}int{bits}_t" for u in ("", "u") for bits in (8, 16, 32, 64)]
PLAIN = dict.fromkeys([*SIZES, "int", "size_t", "Py_ssize_t", "unsigned long long"], "int")
PLAIN |= {"bint": "bool", "float": "float", "double": "float"}
PLAIN |= {"dict": "dict[Any, Any]", "tuple": "tuple[Any, ...]"}
PLAIN |= {"set": "set[Any]", "list": "list[Any]"}
ELEMENTS = {name: f"np.{name.removesuffix('_t')}" for name in SIZES}
ELEMENTS |= {"float": "np.float32", "double": "np.float64"}
STATEMENT = re.compile(
    r"^cdef class (?P<class>\w+)"
    r"|^class (?P<record>\w+)\(NamedTuple\):\n(?P<fields>(?:(?:    [^\n]*)?\n)+?)(?=\n*\S)"
    r"|^(?P<constant>[A-Z]\w*(?:, [A-Z]\w*)*)(?P<of>: [^=\n]+)? = (?P<value>[^\n]*)"
    r"|^    cdef (?:readonly|public) (?P<members>[^(#\n]+)"
    r"|^(?P<property>    @property\n)?(?P<indent> *)def (?P<name>\w+)"
    r"\((?P<takes>.*?)\)(?P<gives> -> .+?)?:\n",
    re.M | re.S,
)


# Of classes that other modules know by C, too: there the members are.
SHARED = Path(__file__).resolve().parents[1] / "engine/_native/pxd/engine3d/_native"


def source_of(path):
    """The text of a .pyx file, with what it includes in its place."""
    parts = re.split(r'^include "(.+)"$', path.read_text("utf-8"), flags=re.M)
    parts[1::2] = [source_of(path.with_name(name)) for name in parts[1::2]]
    return "".join(parts)


def shared_members(path, name):
    """The members that the .pxd file of a module gives a class of it."""
    shared = SHARED / f"{path.stem}.pxd"
    text = shared.read_text("utf-8") if shared.exists() else ""
    _, _, body = text.partition(f"cdef class {name}:\n")
    found = (one["members"] for one in STATEMENT.finditer(body.partition("\ncdef")[0]))
    return [line for text in filter(None, found) for line in members(text)]


def type_of(c_type):
    """What Python passes for a C type, and whether it may be None unless C says otherwise."""
    view = re.match(r"(?:const )?(\w+)\[(.*)\]", c_type)
    if view:
        kind = f"NDArray[{ELEMENTS.get(view[1], 'Any')}]"
        is_bytes = c_type == "const uint8_t[::1]"
        return f"bytes | memoryview | {kind}" if is_bytes else kind, True
    if c_type in PLAIN:
        return PLAIN[c_type], PLAIN[c_type].endswith("]")
    if c_type.startswith("e3d_"):  # an enumerator
        return "int", False
    return (c_type, True) if c_type else ("Any", False)


def parameter(text):
    """A parameter as a stub has it."""
    text, _, default = (part.strip() for part in text.partition("="))
    text, _, annotation = (part.strip() for part in text.partition(": "))
    declared = text.removesuffix(" not None")
    c_type, _, name = declared.rpartition(" ")
    if not (c_type or annotation) and (name in ("self", "cls", "/") or name.startswith("*")):
        return text + ": Any" * name[1:].isalpha() * name.startswith("*")
    kind, may_be_none = type_of(c_type)
    kind = annotation or kind + " | None" * (may_be_none and declared == text)
    return f"{name}: {kind}" + f" = {default}" * bool(default)


def members(text):
    """The lines of public members: a C type and names."""
    c_type, _, first = text.strip().partition(", ")[0].rpartition(" ")
    return [f"    {name}: {type_of(c_type)[0]}" for name in [first, *text.strip().split(", ")[1:]]]


def constant(found):
    kind = found["of"]
    if not kind:
        kind = ": dict[str, int]" if found["value"].startswith(("{", "values_of")) else ": int"
    return "\n".join(f"{name}{kind}" for name in found["constant"].split(", "))


def function(found, body):
    """A function or a method; `body`: the text from there on."""
    name = "__init__" if found["name"] == "__cinit__" else found["name"]
    if name == "__getbuffer__":
        return ["    def __buffer__(self, flags: int, /) -> memoryview: ..."]
    if name.startswith("_") and name not in ("__init__", "__enter__", "__exit__"):
        return []
    takes = ", ".join(map(parameter, filter(None, split(re.sub(r"#.*", "", found["takes"])))))
    own = re.split(rf"^(?! {{{len(found['indent']) + 1},}}|\n)", body, maxsplit=1, flags=re.M)[0]
    gives = found["gives"] or (" -> Any" if re.search(r"\breturn .", own) else " -> None")
    lines = ["    @property"] if found["property"] else []
    return [*lines, f"{found['indent']}def {name}({takes}){gives}: ..."]


def stub(path):
    """The text of the stub of a .pyx file."""
    text = source_of(path)
    others = re.findall(r"^from \.\w+ cimport .*", text, re.M)
    lines = [HEAD.format(path.name), *(line.replace("cimport", "import") for line in others)]
    in_class = False
    for found in STATEMENT.finditer(text):
        is_inner = found["members"] or found["indent"]
        in_class = bool(found["class"] or (in_class and is_inner))
        if (is_inner and not in_class) or len(found["indent"] or "") > 4:
            continue  # a function within another
        if found["class"]:
            lines += [f"class {found['class']}:", f'    """See {path.name}."""']
            lines += shared_members(path, found["class"])
        elif found["record"]:
            lines.append(f"class {found['record']}(NamedTuple):")
            lines += re.findall(r"^    \w+: \w+$", found["fields"], re.M)
        elif found["constant"]:
            lines.append(constant(found))
        elif found["members"]:
            lines += members(found["members"])
        else:
            lines += function(found, text[found.end() :])
    return "\n".join([*lines, ""])


def write_stub(source, target):
    """Write the stub of a .pyx file, unless it is there and the same."""
    write(Path(target), stub(Path(source)))
