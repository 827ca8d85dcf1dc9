"""Columns of results/films/films.csv; apart from what makes films, so that the page needs no solver."""
from studies.kit.table import Table

FILMS = Table("films", key=["film"], columns=[
    "film", "title", "caption", "ra", "rows", "points", "grid_rows", "t_end", "frames", "last_ke", "last_ke_grid"])

#: films in the order of the page; others follow
ORDER = ("particles", "closed_faces", "as_printed")
