"""What few programs need: worlds, levels of detail."""
