"""What is open: the case, its preview, its journal, and the record it is kept in.

``case.Case`` is the one place that holds and changes a case; ``insole_preview.InsolePreview``
follows it; ``clinic_record.ClinicRecord`` asks the record, ``record_keeper.RecordKeeper`` and
``autosave.Autosave`` keep.
"""
