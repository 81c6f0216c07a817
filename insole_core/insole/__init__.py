"""From a foot and a prescription to an insole.

``build.build_insole`` puts the packages together and refuses what cannot be made; ``build.Insole``
is what comes of it. ``block`` makes it a block, ``kept_form.form_of`` a base form.
"""
