"""The command line: one module per command, all found by `main`'s table. No platform's name is in it."""
