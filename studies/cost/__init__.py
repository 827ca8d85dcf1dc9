"""What errors cost: the parts of the studies `speed` and `scenes`."""
