"""Writes what follows from the C headers, such as a .pxd for each of csrc/include/, for Cython.

In:  headers.py, which reads the headers.
Out: the files, in a folder of the build; what another header declares is cimported from its mirror,
     and the mirror of a header that only puts others together holds all that they declare.
"""

import keyword
import re
import sys
from pathlib import Path

from headers import FOLDER, Enum, Headers, Struct, Typedef, Variable

FIRST = "# Written by csrc/mirrors.py from {}, which explains every name."
KERNELS = "kernels/kernels.h"
# What the declarations take from C's own headers.
HOMES = {f"{u}int{bits}_t": "libc.stdint" for u in ("", "u") for bits in (8, 16, 32, 64)}
HOMES["ptrdiff_t"] = "libc.stddef"


def spelled(of):
    """A variable in Cython's words."""
    name = f'{of.name}_ "{of.name}"' if keyword.iskeyword(of.name) else of.name
    name = f"(*{name})" if of.is_pointer else name
    name = of.stars + name + "".join(f"[{size}]" for size in of.sizes)
    if of.parameters is not None:
        name += f"({', '.join(spelled(one) for one in of.parameters)})"
        name += " noexcept nogil" if of.is_pointer else ""
    # A struct without a typedef is the core's own affair.
    kind = "void" if of.type.startswith("struct ") else {"bool": "bint"}.get(of.type, of.type)
    return f"{'const ' if of.const else ''}{kind} {name}".rstrip()


def struct_lines(of):
    """The lines of a struct, behind those of the structs within it."""
    lines = [f"{'ctypedef ' if of.is_typedef else ''}{of.kind} {of.name}:"]
    for member in of.members:
        if isinstance(member, Struct):
            kind = f"{of.name}_{member.name}"
            yield from struct_lines(Struct(kind, member.members, member.kind))
            member = Variable(member.name, kind, sizes=member.sizes)
        lines.append(f"    {spelled(member)}")
    yield from lines if of.members else [*lines, "    pass"]


def lines_of(made):
    """The lines that declare something."""
    if isinstance(made, Variable):
        yield spelled(made)
    elif isinstance(made, Typedef):
        yield f"ctypedef {spelled(made.of)}"
    elif isinstance(made, Struct):
        yield from struct_lines(made)
    else:
        yield f"ctypedef enum {made.name}:" if made.name else "enum:"
        yield from (f"    {name}" for name in made.constants)


def names_of(made):
    """The names that a declaration brings in."""
    name = made.of.name if isinstance(made, Typedef) else made.name
    return {name, *made.constants} if isinstance(made, Enum) else {name}


def mirror(header, homes):
    """The text of the mirror of a header; `homes`: where each name is declared."""
    first = FIRST.format(f"csrc/include/{header.name}")
    lines = [line for made in header.declarations for line in lines_of(made)]
    if not lines:
        others = [f"from {Path(name).stem} cimport *" for name in header.includes]
        return "\n".join([first, *others, ""])
    words = set(re.findall(r"\w+", "\n".join(lines)))
    own = {name for made in header.declarations for name in names_of(made)}
    needed = sorted((homes[name], name) for name in words & homes.keys() - own)
    cimports = [f"from {module} cimport {name}" for module, name in needed]
    lines = [f'cdef extern from "{header.name}" nogil:', *(f"    {line}" for line in lines)]
    return "\n".join([first, *cimports, *lines, ""])


def rounds(kernel):
    """A function in C that calls a kernel of a table several times, with the same arguments."""
    parameters = ", ".join(spelled(one) for one in kernel.parameters)
    call = f"repeated_table->{kernel.name}({', '.join(one.name for one in kernel.parameters)})"
    head = f"static {kernel.type} rounds_{kernel.name}({parameters})"
    loop = f"for (int i = 1; i < repeated_rounds; i++) {call};"
    return f"{head} {{ {loop} {'return ' * (kernel.type != 'void')}{call}; }}"


def write(path, text):
    """Write a file unless it is there and the same."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text("utf-8") != text:
        path.write_text(text, "utf-8")


def write_mirrors(folder):
    """Write the mirrors to a folder, and kernel_rounds.inl, which benchmarks call kernels by."""
    folder = Path(folder)
    headers = Headers(*sorted(path.name for path in (FOLDER / "include").glob("*.h")))
    homes = dict(HOMES)
    for header in headers.read.values():
        for made in header.declarations:
            homes |= dict.fromkeys(names_of(made), Path(header.name).stem)
    for header in headers.read.values():
        write(folder / f"{Path(header.name).stem}.pxd", mirror(header, homes))
    if (FOLDER / KERNELS).exists():
        kernels = Headers(KERNELS).types["e3d_kernels"].members
        lines = [f"/* Written by csrc/mirrors.py from csrc/{KERNELS}. */", *map(rounds, kernels)]
        write(folder / "kernel_rounds.inl", "\n".join([*lines, ""]))


if __name__ == "__main__":
    write_mirrors(sys.argv[1])
