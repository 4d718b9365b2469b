"""Where the programs of this folder find models: in the source, since wheels leave some out."""

from pathlib import Path

MODELS = Path(__file__).resolve().parents[2] / "data" / "models"
