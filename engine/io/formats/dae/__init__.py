"""COLLADA: meshes of robots and of older programs, as XML."""
