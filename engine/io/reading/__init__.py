"""Shared by readers: sources, documents, limits, meshes being put together."""
