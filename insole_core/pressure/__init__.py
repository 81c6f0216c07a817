"""Maps of plantar pressure and pictures of footprints, laid over a foot."""
