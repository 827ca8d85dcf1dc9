"""The error of a decaying vortex against the rows: lattice points and the grid gain a factor of 4 with each
doubling, smooth particles do not."""
from examples import picture, sized
from studies.front import compare

done = compare("taylor-green", ["grid", "fixed-lattice", "fixed-lattice-h1.2", "moving-delaunay", "spam"],
               rows=sized((16, 32, 64), (8, 12)))
print(done)
done.plot(picture("vortex"))
