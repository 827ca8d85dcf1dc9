"""Any method in any scene, in three lines.

    from studies.front import compare, solve

    done = solve("rayleigh-benard", "fixed-lattice", rows=24)
    print(done.K, done.Nu)

Names of scenes are in `studies.build.named.SCENES`, those of methods in `studies.front.solving.ALL`.
"""
from studies.front.comparing import Comparison, compare
from studies.front.solution import Solution
from studies.front.solving import solve

__all__ = ["Comparison", "Solution", "compare", "solve"]
