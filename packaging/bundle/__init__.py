"""What makes the bundles that users install."""
