"""What is new in a scene: scenes to start from, things to add, where they stand, their shapes."""
