"""Meshes: their arrays, derived data (normals, edges), and conversion from other libraries."""
