"""What C++ rejects in a C program, one construct a module, each with its edit of the text.

`language_gap` runs them all.
Imports queries only; `partition` and `widths` import it.
"""
