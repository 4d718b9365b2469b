"""The editor's materials: their list, and what gives them to nodes."""
