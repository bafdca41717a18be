"""Python in the page: a reader's lines are run and graded there, by the library itself, offline."""
