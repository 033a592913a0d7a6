"""Python packages generated from .ecore files, typed and strict.

`codegen` renders a package; the `package_*` modules work out its names, members and links.
Imports the other rooms of `robosmi.model`; `robosmi.generate.packages` and the build import it.
"""
