"""Tools of builds and tests: a browser, the vendored scripts, the cover, the sheet to print."""
