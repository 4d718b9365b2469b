"""What the editor does by keys alone: ways through the tree, between panels, and to commands."""
