"""Adapter files of a platform: pieces, pins, ranges, checks, and their form as models.

`adapter_files` reads them, `adapter_index` finds the piece for a function.
Imports the modules of `knowledge`; queries, rules and chains may import it.
"""
