"""A sweep on a Dask cluster: K of lattice points over Rayleigh numbers, one run a task.

Client() starts workers on this machine; Client("tcp://host:8786") uses those of a cluster.
`make .venv/ready-cluster` installs Dask.
"""
from dask.distributed import Client

from examples import picture, sized
from studies.front import solve
from studies.kit.figure import figure, save


def energy(ra: float) -> float:
    """K of lattice points at a Rayleigh number."""
    return solve("rayleigh-benard", "fixed-lattice", rows=sized(16, 8), ra=ra, time=sized(90, 5)).K.value


if __name__ == "__main__":
    numbers = [2500.0, 3500.0, 5000.0, 7000.0, 10000.0]
    with Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        K = cluster.gather(cluster.map(energy, numbers))
    print(dict(zip(numbers, K, strict=True)))
    page, axes = figure()
    axes.plot([ra**-0.5 for ra in numbers], K)
    axes.set(xlabel="Ra$^{-1/2}$", ylabel="K", title="K is nearly linear in Ra$^{-1/2}$")
    save(page, picture("sweep"))
