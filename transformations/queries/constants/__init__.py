"""Values that are known before the program runs: folding, ranges, compiled constants, step counts.

Imports `flows` and the modules of `queries`.
Ports, resources, rules and constraints may import it.
"""
