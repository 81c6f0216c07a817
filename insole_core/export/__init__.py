"""What is written for others: orders, papers and tables.

``shop_order.ShopOrder`` is what a shop gets, ``order_verification.verify_order`` looks whether it
is as it was written; ``paper.write_job_sheet`` writes the paper that goes with it.
"""
