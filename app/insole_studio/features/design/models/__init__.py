"""The two 3-D views: what they show, and colour, section and rim in them."""
