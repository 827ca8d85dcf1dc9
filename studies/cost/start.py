"""What a fresh process takes from its start to the first step: with nothing compiled yet, and with compiled code on disk.

    python -m studies.cost.start SCENE METHOD RESOLUTION      prints CPU seconds and the most memory that it had, bytes
"""
import json
import os
import resource
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any, ClassVar

from studies.kit.case import Case, Outcome, Report
from studies.kit.processes import THREADS
from studies.kit.source import ROOT

AGAIN = 3       # fresh processes that find compiled code


@dataclass(frozen=True, kw_only=True)
class Start(Case):
    """A method between plates in fresh processes, the first of which finds numba's cache empty."""
    scene: str
    method: str
    resolution: int
    alone: ClassVar[bool] = True
    code: ClassVar = ("studies.cost.plates",)      # what its processes load

    @property
    def cost(self) -> float:
        return 17.0

    @property
    def label(self) -> str:
        return f"start, {self.scene}, {self.method}, resolution {self.resolution}"

    def run(self, report: Report, folder: Path) -> Outcome:
        found = []
        for number in range(1 + AGAIN):
            found.append(self._process(folder))
            report((number + 1)/(1 + AGAIN))
        again = [one["cpu_s"] for one in found[1:]]
        return Outcome({"starts": [{"scene": self.scene, "method": self.method, "resolution": self.resolution,
                                    "first_s": found[0]["cpu_s"], "again_s": median(again), "again_least_s": min(again),
                                    "again_most_s": max(again), "peak_bytes": median(one["bytes"] for one in found[1:])}]})

    def _process(self, folder: Path) -> dict[str, float]:
        """Of one fresh process, which keeps compiled code in the folder of the case."""
        words = [sys.executable, "-m", __name__, self.scene, self.method, str(self.resolution)]
        told = os.environ | dict.fromkeys(THREADS, "1") | {"NUMBA_CACHE_DIR": str(folder/"compiled"), "PYTHONPATH": str(ROOT)}
        done = subprocess.run(words, env=told, cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            raise RuntimeError(f"{' '.join(words[1:])} ended with {done.returncode}: {done.stderr[-500:]}")
        result: dict[str, float] = json.loads(done.stdout)
        return result


def first_step(method: Any, resolution: int) -> dict[str, float]:
    """Set up, one step, and what this process has taken since it began."""
    problem = method.problem(resolution, 1)
    (problem.step or problem.go)(problem.first, method.first*problem.limit, 1)
    used = resource.getrusage(resource.RUSAGE_SELF)
    unit = 1 if sys.platform == "darwin" else 1024
    return {"cpu_s": used.ru_utime + used.ru_stime, "bytes": float(unit*used.ru_maxrss)}


if __name__ == "__main__":
    from studies.cost.plates import CONTESTANTS
    print(json.dumps(first_step(CONTESTANTS[sys.argv[1]][sys.argv[2]], int(sys.argv[3]))))
