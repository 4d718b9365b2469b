"""OBJ with its MTL, both ways."""
