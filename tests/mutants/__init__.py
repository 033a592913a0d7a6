"""The project's own mutants: small faults put into its code, and how many of them each tier of the tests notices."""
