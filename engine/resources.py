"""Files that are loaded once, and loaded again when they change."""

from .io.resources import Resource, Resources, ResourceStats

__all__ = ["Resource", "ResourceStats", "Resources"]
