"""glTF and GLB, both ways."""
