"""The equations of fluids and their solutions on grids."""
