"""PLY, both ways."""
