"""Controls that know nothing of feet."""
