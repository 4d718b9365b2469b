"""How pictures get into a window: through a graphics card or without one, in its rhythm."""
