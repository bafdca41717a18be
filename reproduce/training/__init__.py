"""Training: how every array that the model reads is learnt, from photos and movements."""
