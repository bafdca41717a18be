"""Object recognition: the "what" pathway (ventral)."""
