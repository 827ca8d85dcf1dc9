"""What all studies share: cases that run on workers, tables, claims, figures; no physics.

A study (study.py) is made of parts: cases, tables, and what reads these: figures (figure.py) and claims
(claim.py, ask.py).

How a case becomes a row: it is a dataclass with a method `run` (case.py). A sweep (sweep.py) gives the cases
that are not finished to a loop (dispatch.py), which hands them to this process, to workers, or to a cluster
(cluster.py). What comes back is kept as JSON in a file named by the case's key (store.py), and merged into a
table (table.py), which is a CSV file (csvfile.py).

How its key is made: by hashing its parameters and the definitions that it reaches (`key_of` in case.py).
`Code` (key.py) follows these through our packages: it takes modules apart (syntax.py) and reads definitions
without their layout (reader.py).
"""
