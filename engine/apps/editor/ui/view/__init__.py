"""What the scene panel shows beside the scene: grid, icons, outlines, a camera's picture, views."""
