"""What the core is compiled from, and how: sources, flags, kinds of build.

In:  csrc/ (the C core), the machine, ENGINE3D_BUILD=release|debug|profile|asan|tsan|msan. Nothing
     but Python's own library: setup.py builds the package with it, .ci/build_driver.py the core.
Out: lists of files and flags.

Every backend must give the same bytes, hence these rules. The flags below come after the user's
CFLAGS. The baseline is plain x86-64, so that only the ISA files hold code that an old CPU lacks.
"""

import os
import re
import sys
import sysconfig
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent))
from headers import Headers

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


# The machines that have kernels: what platforms call them, and the flags of every file. The header
# e3d_backends.h has a list of backends for each.
MACHINES = {
    "X86": (r"x86_64|amd64", ["-march=x86-64", "-mtune=generic"]),
    "AARCH64": (r"aarch64(?!_be)|arm64", []),
}


def isa_flags(machine):
    """The flags of each set of SIMD kernels for `machine`, from the core's own list of backends.

    machine: as in `MACHINE`.
    """
    rows = Headers("e3d_backends.h").rows(f"E3D_EACH_{machine}_BACKEND")
    return {name: [f"-m{one}" for one in re.findall(r'"(.+?)"', has)] for _, name, has in rows}


def machine_of(platform):
    """X86 or AARCH64, as the core calls them, or an empty text: of a name of a platform."""
    names = (name for name, (pattern, _) in MACHINES.items() if re.search(pattern, platform))
    return next(names, "")


def is_windows(platform):
    """Whether a name of a platform, as Python or a compiler has it, is one of Windows."""
    return platform.startswith("win") or "windows" in platform or "mingw" in platform


BUILD = os.environ.get("ENGINE3D_BUILD") or "release"
# What the built code runs on: of the rest, the kernels are portable only.
MACHINE = machine_of(sysconfig.get_platform())
IS_WINDOWS = is_windows(sysconfig.get_platform())


# What every C file of Windows begins with.
WINDOWS_FLAGS = ["-include", "csrc/base/windows/memory.h"]


def usable_processors():
    """The number of processors that a build may use; macOS does not tell of affinities."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def common_flags():
    """The flags of every C file, the kernels too."""
    if BUILD not in BUILDS:
        raise SystemExit(f"ENGINE3D_BUILD={BUILD}: expected one of {', '.join(BUILDS)}")
    baseline = [*MACHINES[MACHINE][1]] if MACHINE else []
    if IS_WINDOWS:
        baseline += WINDOWS_FLAGS
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
            "csrc/base/*.c",
            "csrc/data/**/*.c",
            "csrc/frame/*/*.c",
            "csrc/kernels/dispatch.c",
            "csrc/post/ui/*.c",
            "csrc/scene/posing/*.c",
            "csrc/post/*.c",
        ],
        "e3d_portable": [
            "csrc/kernels/isa_portable.c",
            "csrc/extras/mujoco/kernels/isa_portable.c",
        ],
        "e3d_reference": ["csrc/reference/**/*.c"],
        "e3d_canvas": ["csrc/extras/canvas/*.c"],
        "e3d_drawing": ["csrc/extras/drawing/*.c"],
        "e3d_environment": ["csrc/light/*.c"],
        "e3d_images": ["csrc/io/images/*.c"],
        "e3d_navigation": ["csrc/scene/navigation/*.c"],
        "e3d_mujoco": [
            "csrc/extras/mujoco/*.c",
            "csrc/extras/mujoco/kernels/dispatch.c",
            "csrc/extras/mujoco/kernels/scalar.c",
        ],
        "e3d_pybullet": ["csrc/extras/pybullet/*.c"],
        "e3d_pyrender": ["csrc/extras/pyrender/*.c"],
        "e3d_scene": ["csrc/scene/*.c"],
        "e3d_loaders": ["csrc/io/loaders/**/*.c"],
        "e3d_writers": ["csrc/io/writers/*.c"],
    }
    kernel_flags = {"e3d_portable": []}
    for isa, flags in isa_flags(MACHINE).items():
        folders = ("csrc/kernels", "csrc/extras/mujoco/kernels")
        sources[f"e3d_{isa}"] = [f"{folder}/isa_{isa}.c" for folder in folders]
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
