"""Convection at Ra 10 000 by four methods side by side: the flow, K, Nu, and what they cost."""
from examples import picture, sized
from studies.front import compare

done = compare("rayleigh-benard", ["grid", "fixed-lattice", "moving-delaunay", "spam"],
               rows=sized((16, 24), (8, 10)), time=sized(60, 5), ra=1e4)
print(done)             # the grid's K is 0.00489 in the limit of many rows
done.plot(picture("convection"))
