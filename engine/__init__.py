"""engine3d: draws 3D scenes on the CPU, the same bytes on every machine."""

if __name__ != "engine3d":
    raise ImportError(f"this package is engine3d; it was imported as {__name__}")

from .version import __version__

__all__ = ["__version__"]
