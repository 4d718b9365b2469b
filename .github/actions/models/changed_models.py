"""Which models differ between a commit and the one after it, by what git says of their files.

A model is drawn again if its file differs, or a material or a texture that may be its own: one that
lies in its folder, or below it with no other model in between. Links are left out, since they may
lead anywhere.
"""

import re
import subprocess
from pathlib import Path, PurePosixPath

from engine3d.io.loaders import formats

# What else may be in files of these names: any JSON, signatures. Patterns ask for them by name.
AMBIGUOUS = {".json", ".asc", ".xml"}
MESHES = {end for item in formats() if item.kind == "mesh" for end in item.extensions}
PARTS = {end for item in formats() if item.kind == "image" for end in item.extensions}
PARTS |= {".mtl", ".bin"}


EXCLUSION = re.compile(r":(/*[!^]|\((?:[^)]*,)?exclude[,)])")  # of git's words for paths


def changed_models(base, named):
    """Return the paths, as git has them, of models that may differ from those of `base`.

    named: what `named_models` returned.
    """
    models = {PurePosixPath(name) for names in named.values() for name in names}
    # Of a file that moved, the old name counts, too.
    listed = git("diff", "--name-only", "--no-renames", base, "HEAD")
    changed = {PurePosixPath(name) for name in listed}
    homes = {home_of(path, models) for path in changed if path.suffix.lower() in PARTS}
    found = [path for path in models if path in changed or path.parent in homes]
    return sorted(map(str, found))


def named_models(base, patterns):
    """Return the models, at either commit, that each pattern names.

    patterns: of git, in which `!` leaves out; if none names any, those that extensions tell.
    """
    specs = {pattern: pathspec(pattern) for pattern in patterns}
    without = [spec for spec in specs.values() if EXCLUSION.match(spec)]
    chosen = {pattern: spec for pattern, spec in specs.items() if spec not in without}
    if chosen:
        # In this order: git compares exclusions without the folder of a path that comes first.
        return {pattern: files(base, *without, spec) for pattern, spec in chosen.items()}
    names = [name for name in files(base, *without) if is_model(PurePosixPath(name))]
    return {"": names}


def pathspec(pattern):
    """Return a pattern in git's own words, if it is not: one whose `*` stays in a folder."""
    if pattern.startswith(":"):
        return pattern
    return f":(glob,exclude){pattern[1:]}" if pattern.startswith("!") else f":(glob){pattern}"


def files(base, *specs):
    """Return the names of files at either commit."""
    return git("ls-files", f"--with-tree={base}", "--", *specs)


def is_model(path):
    return path.suffix.lower() in MESHES - AMBIGUOUS


def home_of(part, models):
    """Return the nearest folder with models, at or above that of a file."""
    folders = {model.parent for model in models}
    return next((folder for folder in part.parents if folder in folders), None)


def git(command, *words):
    """Return the names that a command of git lists."""
    done = subprocess.run(["git", command, "-z", *words], stdout=subprocess.PIPE)
    if done.returncode:  # it said why
        raise SystemExit(f"models: git refuses {' '.join(words)}")
    return [name for name in done.stdout.decode("utf-8", "surrogateescape").split("\0") if name]


def is_there(path):
    """Whether a path is a file of the tree itself."""
    return Path(path).is_file() and not Path(path).is_symlink()
