"""Files are written whole or not at all, and one process at a time works on what is another's.

``atomic.replacing_file`` writes one, ``transaction.Transaction`` lets several take their places
together, also after a kill; ``file_lock.FileLock`` keeps a second process away.
"""
