"""What is drawn over a picture: axes, grids, labels, scales, counts."""
