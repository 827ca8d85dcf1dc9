"""Measurements of speed, beside public codes in the same run."""
