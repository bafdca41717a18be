"""What trains: every array that the model reads is learnt here, from photos and movements."""
