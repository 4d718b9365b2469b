"""What readers share: sources, documents, limits, meshes being put together."""
