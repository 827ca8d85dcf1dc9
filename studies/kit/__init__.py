"""What all studies share: cases that run on workers, tables, claims, figures; no physics.

A study (study.py) consists of cases, tables, and the figures (figure.py) and claims (claim.py, ask.py) that
read the tables.

How a case becomes a row: a case is a dataclass with a method `run` (case.py). A sweep (sweep.py) passes the
unfinished cases to a loop (dispatch.py), which runs them in this process, in workers, or on a cluster
(cluster.py). The outcome of a case is stored as JSON in a file named by the case's key (store.py), and
merged into a table (table.py), which is a CSV file (csvfile.py).

How the key of a case is made: `key_of` (case.py) hashes the parameters and the definitions that the case
reaches. `Code` (key.py) follows these through our packages: it parses modules (syntax.py) and reads
definitions without their layout (reader.py).
"""
