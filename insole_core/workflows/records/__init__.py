"""Cases, papers and persons into the record and out of it.

``keep_case.keep_case``, ``import_cases.import_cases``, ``export_person.export_person``.
"""
