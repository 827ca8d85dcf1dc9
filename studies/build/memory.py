"""Memory of a process that makes one step, with nothing loaded but what sets the method up (Linux)."""
from pathlib import Path
from resource import getpagesize
from typing import Any

from particles.run import Plan, run


def resident(variant: Any, scene: Any) -> dict[str, float]:
    """Points of a method in a scene, and resident bytes of this process in its first step."""
    def now(*_: Any) -> int:
        return getpagesize()*int(Path("/proc/self/statm").read_text().split()[1])
    method, start, dt = variant.ready(scene)
    done = run(method, start, Plan(dt=dt, steps=1, every=1, series={"resident": now}))
    return {"points": start.shape[1], "resident": round(done.series["resident"][-1])}
