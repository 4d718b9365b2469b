"""File input and output: formats, shared code of readers and writers, scenes, animations."""
