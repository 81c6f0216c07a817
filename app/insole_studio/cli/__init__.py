"""The command line: a module for each command, beside the arguments they share.

``main.run`` runs one, ``main.command_parser`` knows them all.
"""
