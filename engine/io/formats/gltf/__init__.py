"""glTF and GLB, for reading and writing."""
