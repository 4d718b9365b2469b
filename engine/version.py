"""The version of engine3d, stated here alone; the package's metadata reads it from here."""

__version__ = "0.1.0"
