"""EOL-style operations on each metamodel, reused by rules, constraints and templates."""
