"""The paper's numbers remade, and every number of the book: claims, tables, training, ledger."""
