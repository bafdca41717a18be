"""Measure the ledger: `python -m reproduce.ledger`."""

from reproduce import ledger, results

if __name__ == "__main__":
    results.write("ledger", ledger.make())
