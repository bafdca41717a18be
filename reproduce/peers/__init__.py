"""What the model is held beside: other features, windows, muscles, and an optimal controller."""
