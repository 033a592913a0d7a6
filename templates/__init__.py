"""Jinja2 templates, free of logic; read through `robosmi.resources`."""
