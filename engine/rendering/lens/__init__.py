"""Pictures through lenses, looked up in the pinhole pictures around them."""
