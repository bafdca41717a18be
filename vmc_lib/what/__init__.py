"""The "what" pathway (ventral): crops, CRBMs, the deep belief network, the name."""
