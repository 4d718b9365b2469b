"""PLY, for reading and writing."""
