"""What all studies share: cases that run on workers, tables, claims, figures; no physics.

A study is a `Study` (study.py) of `Part`s: cases (case.py) whose rows fill tables (table.py), which figures
(drawing.py) and claims (claim.py, ask.py) read.
"""
