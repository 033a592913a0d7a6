"""Model to text: the files of a sketch from a migration plan. Nothing is decided here."""
