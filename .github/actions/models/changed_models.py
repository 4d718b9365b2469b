"""Which models differ between a commit and the one after it, by what git says of their files.

A model is drawn again if its file differs, or a material or a texture that may be its own: one that
lies in its folder, or below it with no other model in between. Links are left out, since they may
lead anywhere.
"""

import subprocess
from pathlib import Path, PurePosixPath

from engine3d.io.loaders import formats

# What else may be in files of these names: any JSON, signatures. Patterns ask for them by name.
AMBIGUOUS = {".json", ".asc", ".xml"}
MESHES = {end for item in formats() if item.kind == "mesh" for end in item.extensions}
PARTS = {end for item in formats() if item.kind == "image" for end in item.extensions}
PARTS |= {".mtl", ".bin"}


def changed_models(base, patterns):
    """Return the paths, as git has them, of models that may differ from those of `base`.

    patterns: of git; without any, every model that its extension tells.
    """
    chosen = [f":(glob){one}" for one in patterns]
    names = git("ls-files", f"--with-tree={base}", "--", *chosen)
    models = {one for one in map(PurePosixPath, names) if patterns or is_model(one)}
    # Of a file that moved, the old name counts, too.
    listed = git("diff", "--name-only", "--no-renames", base, "HEAD")
    changed = {PurePosixPath(name) for name in listed}
    homes = {home_of(path, models) for path in changed if path.suffix.lower() in PARTS}
    found = [path for path in models if path in changed or path.parent in homes]
    return sorted(map(str, found))


def is_model(path):
    return path.suffix.lower() in MESHES - AMBIGUOUS


def home_of(part, models):
    """Return the nearest folder with models, at or above that of a file."""
    folders = {model.parent for model in models}
    return next((folder for folder in part.parents if folder in folders), None)


def git(command, *words):
    """Return the names that a command of git lists."""
    done = subprocess.run(["git", command, "-z", *words], stdout=subprocess.PIPE, check=True)
    return [name for name in done.stdout.decode("utf-8", "surrogateescape").split("\0") if name]


def is_there(path):
    """Whether a path is a file of the tree itself."""
    return Path(path).is_file() and not Path(path).is_symlink()
