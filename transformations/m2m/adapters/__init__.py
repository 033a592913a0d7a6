"""Adapters: which body serves a function of the source platform, and placeholders where there is none.

`adapter_choice` decides, `adapter_uses` follows what a body needs.
Imports queries and knowledge; `partition` and the chain import it.
"""
