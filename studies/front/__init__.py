"""Any method in any scene, in three lines.

    from studies.front import compare, solve

    done = solve("rayleigh-benard", "fixed-lattice", rows=24)
    print(done.K, done.Nu)

`make words` explains the names of scenes and methods.
"""
from studies.front.solution import Comparison, Solution
from studies.front.solving import compare, solve

__all__ = ["Comparison", "Solution", "compare", "solve"]
