"""Mutation testing of `verify`: faults and harmless rewritings are put into migrated programs to see what it notices."""
