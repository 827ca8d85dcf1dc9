"""Dissipative particles: which step keeps the temperature? Velocity-Verlet's error grows with the step."""
from examples import picture, sized
from particles.dissipative.dpd import Dpd, kinetic_temperature
from particles.dissipative.integrators import GrootWarren65, Shardlow, VelocityVerlet
from particles.run import Plan, run
from studies.kit.figure import errorbar, figure, save
from studies.kit.stats import mean

time = sized(40.0, 2.0)
page, axes = figure(width=5.5)
for number, integrator in enumerate((VelocityVerlet, GrootWarren65, Shardlow)):
    fluid, found = Dpd(box=(6.0, 6.0, 6.0), integrator=integrator), []
    for dt in (0.02, 0.04, 0.06):
        settled = run(fluid, fluid.random_start(rho=3.0), Plan(dt=dt, steps=round(5/dt))).by_id()
        plan = Plan(dt=dt, steps=round(time/dt), series={"kT": kinetic_temperature}, every=2)
        found.append(mean(run(fluid, settled, plan).series["kT"]))
        print(f"{integrator.__name__}, step {dt}: kT = {found[-1].value:.4f} +- {found[-1].err:.4f}")
    errorbar(axes, (0.02, 0.04, 0.06), [one.value for one in found], [one.err for one in found],
             number=number, label=integrator.__name__)
axes.axhline(1, color="grey")
axes.set(xlabel="time step", ylabel="kT of velocities", title="Which step keeps the temperature?")
axes.legend()
save(page, picture("dissipative"))
