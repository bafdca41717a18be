"""The "where" pathway (dorsal): candidates, features, the object detector, places."""
