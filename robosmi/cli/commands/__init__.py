"""One module per command, with `configure(parser)` and `run(arguments) -> Report`.

`robosmi.cli.main` imports the one that is asked for.
Imports the modules of `robosmi.cli`; nothing else imports it.
"""
