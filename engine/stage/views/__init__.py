"""From where a model is seen, and how one moves."""
