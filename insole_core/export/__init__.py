"""What is written for others: orders and papers; and how anything is written safely.

``atomic.replacing_file`` and ``transaction.Transaction`` let results take their places whole,
``file_lock.FileLock`` keeps a second process away.
"""
