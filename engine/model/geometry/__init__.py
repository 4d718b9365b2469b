"""Meshes: their arrays, what follows from these (normals, edges), and meshes of other libraries."""
