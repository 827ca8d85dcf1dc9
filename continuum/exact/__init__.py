"""Exact and spectral reference solutions."""
