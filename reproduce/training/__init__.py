"""Training: how every array that the model reads is learnt, from photos and movements."""

from pathlib import Path

COUNTEREXAMPLES = Path(__file__).parent / "counterexamples"  # photographs without a shuttlecock
