"""Dissipative particle dynamics."""
