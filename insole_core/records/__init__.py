"""The clinic's record: persons, visits, prescriptions, orders, in SQLite or PostgreSQL.

``records.open_records`` opens a ``records.Records``, which has a part for each kind of thing.
``person.Person``, ``visit.Visit``, … are values; ``persons``, ``visits``, … read and write them.
``schema`` holds the tables.
"""
