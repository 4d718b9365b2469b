"""What the core is compiled from, and how: sources, flags, kinds of build.

In:  csrc/ (the C core), the machine, ENGINE3D_BUILD=release|debug|profile|asan|tsan|msan. Nothing
     but Python's own library: setup.py builds the package with it, .ci/build_driver.py the core.
Out: lists of files and flags.

Every backend must give the same bytes, hence these rules. The flags below come after the user's
CFLAGS. The baseline is plain x86-64, so that only the ISA files hold code that an old CPU lacks.
"""

import os
import re
import sysconfig
from pathlib import Path

# A release has nothing that only debuggers and profilers read: neither unwind tables nor symbols.
BUILDS = {
    "release": ["-O3", "-g0", "-DNDEBUG", "-fno-asynchronous-unwind-tables"],
    "debug": ["-Og", "-g", "-UNDEBUG"],
    "profile": ["-O3", "-g", "-DNDEBUG", "-fno-omit-frame-pointer"],
    "asan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
    "tsan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
    "msan": ["-O1", "-g", "-UNDEBUG", "-fno-omit-frame-pointer"],
}
# What Cython writes checks arguments and calls the core: optimised for speed, it would be little
# faster and much larger.
GATEWAY_FLAGS = {"release": ["-Os"], "profile": ["-Os"]}
SANITIZERS = {
    "asan": ["-fsanitize=address,undefined", "-fno-sanitize-recover=undefined"],
    "tsan": ["-fsanitize=thread"],
    "msan": ["-fsanitize=memory"],
}
WARNINGS = ["-Wall", "-Wextra"]
INCLUDE_DIRS = ["csrc/include", "csrc"]
# What CFLAGS may hold that would change results is taken back: -ffast-math, -Ofast, -march=native,
# contraction to FMA, and link-time optimisation (which mixes the ISAs).
EXACT = ["-fno-fast-math", "-fno-unsafe-math-optimizations", "-ffp-contract=off", "-fno-math-errno"]
# Python's own flags let signed numbers wrap around. Here they must not, which sanitizers check.
HYGIENE = [
    "-std=gnu11",
    "-fstrict-overflow",
    "-fPIC",
    "-fvisibility=hidden",
    "-fno-lto",
    "-pthread",
]
# Outside the kernels, where files and callers' arrays are read.
HARDENING = ["-fstack-protector-strong", "-U_FORTIFY_SOURCE", "-D_FORTIFY_SOURCE=2"]
LINK_FLAGS = ["-pthread"]
ELF_LINK_FLAGS = ["-Wl,-z,relro,-z,now"]
STRIPPED = {"release": ["-s"]}


def isa_flags(machine):
    """The flags of each set of SIMD kernels for `machine`, from the core's own list of backends.

    machine: as in `MACHINE`.
    """
    header = Path(__file__).with_name("include") / "e3d_backends.h"
    _, _, rows = header.read_text("utf-8").partition(f"#define E3D_EACH_{machine}_BACKEND(X)")
    rows = rows.partition("\n\n")[0].split("X(E3D_BACKEND_")[1:]
    flags = {}
    for row in rows:
        name = re.match(r"\w+, (\w+)", row)[1]
        flags[name] = [f"-m{instructions}" for instructions in re.findall(r'HAS\("(.+?)"\)', row)]
    return flags


def machine_of(platform):
    """X86 or AARCH64, as the core calls them, or an empty text: of a name of a platform."""
    names = {"X86": r"x86_64|amd64", "AARCH64": r"aarch64(?!_be)|arm64"}
    return next((name for name, pattern in names.items() if re.search(pattern, platform)), "")


def is_windows(platform):
    """Whether a name of a platform, as Python or a compiler has it, is one of Windows."""
    return platform.startswith("win") or "windows" in platform or "mingw" in platform


BUILD = os.environ.get("ENGINE3D_BUILD") or "release"
# What the built code runs on: of the rest, the kernels are portable only.
MACHINE = machine_of(sysconfig.get_platform())
IS_WINDOWS = is_windows(sysconfig.get_platform())


def common_flags():
    """The flags of every C file, the kernels too."""
    if BUILD not in BUILDS:
        raise SystemExit(f"ENGINE3D_BUILD={BUILD}: expected one of {', '.join(BUILDS)}")
    baseline = ["-march=x86-64", "-mtune=generic"] if MACHINE == "X86" else []
    if IS_WINDOWS:
        baseline += ["-include", "csrc/windows/memory.h"]
    return [*baseline, *BUILDS[BUILD], *EXACT, *HYGIENE, *SANITIZERS.get(BUILD, [])]


def hardened_flags():
    """The flags of what isn't a kernel; sanitizers watch the same and more by themselves."""
    return [*common_flags(), *([] if BUILD in SANITIZERS else HARDENING)]


def link_flags():
    """The flags of the linker; those of ELF are for Linux."""
    is_elf = sysconfig.get_platform().startswith("linux")
    return [*LINK_FLAGS, *(ELF_LINK_FLAGS if is_elf else [])]


def static_libraries():
    """The (name, build_info) pairs that `build_clib` compiles; the ISA files of one machine."""
    sources = {
        "e3d_core": [
            "csrc/core/*.c",
            "csrc/pipeline/*/*.c",
            "csrc/kernels/dispatch.c",
            "csrc/ui/*.c",
            "csrc/posing/*.c",
            "csrc/bloom/*.c",
            "csrc/occlusion/*.c",
        ],
        "e3d_portable": ["csrc/kernels/isa_portable.c"],
        "e3d_reference": ["csrc/reference/*.c"],
        "e3d_canvas": ["csrc/canvas/*.c"],
        "e3d_environment": ["csrc/environment/*.c"],
        "e3d_images": ["csrc/images/*.c"],
        "e3d_navigation": ["csrc/navigation/*.c"],
        "e3d_pyrender": ["csrc/pyrender/*.c"],
        "e3d_scene": ["csrc/scene/*.c"],
        "e3d_loaders": ["csrc/loaders/*.c"],
        "e3d_writers": ["csrc/writers/*.c"],
    }
    kernel_flags = {"e3d_portable": []}
    for isa, flags in isa_flags(MACHINE).items():
        sources[f"e3d_{isa}"] = [f"csrc/kernels/isa_{isa}.c"]
        kernel_flags[f"e3d_{isa}"] = flags
    libraries = []
    for name, patterns in sources.items():
        files = sorted(str(path) for pattern in patterns for path in Path().glob(pattern))
        if not files:
            continue
        is_kernel = name in kernel_flags
        flags = [*common_flags(), *kernel_flags[name]] if is_kernel else hardened_flags()
        build_info = {
            "sources": files,
            "include_dirs": INCLUDE_DIRS,
            "macros": [(f"E3D_HAVE_{MACHINE}", "1")] if MACHINE else [],
            "cflags": [*WARNINGS, *flags],
        }
        libraries.append((name, build_info))
    return libraries
