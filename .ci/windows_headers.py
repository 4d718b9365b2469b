"""CPython for Windows, as far as a cross compiler has to know it: headers and an import library.

In:  the headers of this Python, which for Windows differ by one file, pyconfig.h.
Out: in a folder, headers for 64-bit Windows, and python3.lib, which names what python3.dll has: the
     limited API of every version of CPython. It names more, which no module of that API asks for.
"""

import re
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

LIBRARY = "python3"
SIZES = {"SHORT": 2, "INT": 4, "LONG": 4, "LONG_LONG": 8, "FLOAT": 4, "DOUBLE": 8, "WCHAR_T": 2}
SIZES |= dict.fromkeys(("VOID_P", "SIZE_T", "TIME_T", "UINTPTR_T", "FPOS_T", "HKEY"), 8)
SIZES |= {"OFF_T": 4, "PID_T": 4, "PTHREAD_T": 8}
# What CPython's headers ask of pyconfig.h, answered for 64-bit Windows.
DEFINED = ["MS_WINDOWS", "MS_WIN32", "MS_WIN64", "NT_THREADS", "Py_ENABLE_SHARED"]
DEFINED += ["HAVE_DECLSPEC_DLL", "HAVE_STDDEF_H", "HAVE_STDINT_H", "HAVE_WCHAR_H", "WITH_PYMALLOC"]
# As in PyAPI_FUNC(void) _Py_NO_RETURN Py_Exit(int); a type may hold parentheses.
DECLARATION = re.compile(
    r"\bPyAPI_(FUNC|DATA)\s*\([^()]*(?:\([^()]*\)[^()]*)*\)\s*\**\s*(?:_Py_NO_RETURN\s+)?(_?Py\w+)"
)


def write(folder, machine):
    """Write the headers into folder/include, and the import library into folder.

    machine: as dlltool names it.
    """
    include = Path(folder, "include")
    shutil.copytree(sysconfig.get_path("include"), include)
    lines = [f"#define {name} 1" for name in DEFINED]
    lines += [f"#define SIZEOF_{name} {size}" for name, size in SIZES.items()]
    lines += ["#define ALIGNOF_SIZE_T 8", "#define ALIGNOF_MAX_ALIGN_T 16"]
    Path(include, "pyconfig.h").write_text("\n".join(lines) + "\n", "utf-8")
    definition = Path(folder, f"{LIBRARY}.def")
    definition.write_text(f"LIBRARY {LIBRARY}.dll\nEXPORTS\n{exports(include)}", "utf-8")
    library = Path(folder, f"{LIBRARY}.lib")
    command = [sys.executable, "-m", "ziglang", "dlltool", "-m", machine]
    subprocess.run([*command, "-d", str(definition), "-l", str(library)], check=True)


def exports(include):
    """Return what the headers say the library has, in the form of a definition file."""
    return "".join(f"{name}{kind}\n" for name, kind in names(include).items())


def names(include):
    """Return the names that the headers declare; " DATA" for those of variables, else ""."""
    found = {}
    for header in sorted(include.rglob("*.h")):
        for kind, name in DECLARATION.findall(header.read_text("utf-8", "replace")):
            found[name] = " DATA" if kind == "DATA" else ""
    return found
