"""Files, both ways: formats, what readers and writers share, scenes of documents, output."""
