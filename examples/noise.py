"""Noise on irregular points: one random stress a point is the partner of friction, to round-off.

Points that start at rest warm to the temperature of their noise."""
import numpy as np

from examples import picture, sized
from particles.integral.edge_makers import exact
from particles.integral.fluctuating import mismatch, stress
from particles.integral.points import jittered
from particles.weights import WendlandC2
from studies.kit.figure import figure, save

kT, eta, rows = 0.01, 0.5, sized(24, 10)
edges = exact(jittered((rows, rows), 0.2, 1), WendlandC2.of(h=3.0))
points = stress(edges, eta, 0.0, kT)
print(f"|Q - 2 kT Gamma|/|2 kT Gamma|: one stress a point {mismatch(points, 2*kT):.1e}")

rng, dt, masses = np.random.default_rng(1), 0.05, np.tile(edges.V, 2)
v, seen = np.zeros(2*edges.n), []
for _ in range(sized(4000, 200)):       # implicit midpoint would be exact; a short step is enough
    p = masses*v - dt*(points.Gamma@v) + np.sqrt(dt)*(points.B@rng.standard_normal(points.B.shape[1]))
    v = p/masses
    seen.append(float(masses@v**2)/len(v)/kT)
page, axes = figure(width=5.5)
axes.plot(dt*np.arange(len(seen)), seen, marker="")
axes.axhline(1, color="black")
axes.set(xlabel="time", ylabel="kT of velocities / kT", title="Velocities warm to their noise's temperature")
save(page, picture("noise"))
