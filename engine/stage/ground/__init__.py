"""What the ground under a model shows of it: its shadow, and its reflection."""
