"""Arduino cores as they are installed: their boards, properties and recipes, by the Arduino platform specification.

`installed_board` is the query of the registry. Imports nothing else of `knowledge`; the compile check asks it.
"""
