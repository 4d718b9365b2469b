"""The command ``engine3d heights``."""

import engine3d


def add(parser):
    """Print the lowest and the highest point of models."""
    parser.add_argument("models", metavar="MODEL", nargs="+", help="the files")
    return run


def run(args):
    """Run the command; return the exit status."""
    for path in args.models:
        low, high = engine3d.load(path).bounds[:, 1]
        print(f"{path}: {low:g} to {high:g}")
    return 0
