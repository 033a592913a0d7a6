"""The foundation without a subject: text formats, signals, locks, caches, user folders, trust, data tables.

The public part of the foundation is in `robosmi.errors`, `diagnostics`, `inputs`, `resources`, `plugins` and `project`.
Imports only that part; every other package may import it.
"""
