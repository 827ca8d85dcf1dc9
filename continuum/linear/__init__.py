"""Linear stability of layers and squares heated from below."""
