"""Faults and harmless rewritings put into migrated programs: what `verify` notices, and that it raises no false alarm."""
