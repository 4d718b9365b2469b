"""The version of pyrender whose meaning the names here have."""

__version__ = "0.1.45"
