"""What every package uses: checks of what callers give, and notes of what changed since."""
