"""OBJ with its MTL, for reading and writing."""
