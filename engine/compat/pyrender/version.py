"""The version of pyrender that this module is compatible with."""

__version__ = "0.1.45"
