"""Where particles and grids meet: one question a file."""
