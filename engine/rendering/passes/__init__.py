"""The passes of a picture, each with the same methods, and their list."""
