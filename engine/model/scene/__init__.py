"""Trees of nodes, and what nodes carry: instances, lights, cameras; how these come from a file."""
