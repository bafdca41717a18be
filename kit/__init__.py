"""The teacher's kit, made from the chapters: notebooks, slides, a key, a bank of questions."""
