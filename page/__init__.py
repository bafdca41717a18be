"""What runs in the browser, and what it is given: arm, eye, Python, demos, the book's pages."""
