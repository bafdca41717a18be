"""Right solutions of the exercises, in other idioms than ours: a module a chapter.

The name of each begins with that of its exercise.
"""
