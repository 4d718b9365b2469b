"""What is where in a scene: rays and picking. Trees of boxes in C do the searching."""
