"""What studies take is measured as they run."""
from dataclasses import dataclass

from studies.kit import timing
from studies.kit.case import Case, Outcome
from studies.kit.csvfile import read
from studies.kit.dispatch import Bar
from studies.kit.study import Study
from studies.kit.table import Table


@dataclass(frozen=True, kw_only=True)
class Work(Case):
    x: float

    @property
    def cost(self) -> float:
        return self.x

    def run(self, report, folder):
        sum(range(100_000))
        return Outcome({"squares": [{"x": self.x, "y": self.x**2}]})


SIZES = {"quick": (1.0, 2.0), "paper": (1.0, 2.0, 3.0, 6.0)}
TOY = Study(name="toy", cases=lambda size: [Work(x=x) for x in SIZES[size]],
            tables=[Table("squares", key=["x"], columns=["x", "y"], about="a test")])


def test_a_whole_run_leaves_its_cpu_seconds(tmp_path):
    TOY.run("paper", workers=1, out=tmp_path)
    [row] = read(tmp_path/"times.csv", timing.COLUMNS).to_dict("records")
    assert (row["study"], row["size"], row["cases"], row["estimate_s"]) == ("toy", "paper", 4, 12.0)
    assert 0 < row["cpu_s"] < 10
    TOY.run("quick", workers=1, out=tmp_path)
    assert list(read(tmp_path/"times.csv")["size"]) == ["paper", "quick"], "a size has a row of its own"


def test_the_time_left_is_reckoned_from_what_is_done_since_the_start():
    """Four cases of equal cost, which tell no fractions; the first takes 1024 s."""
    bar = Bar([Work(x=1.0)]*4, "toy")
    bar.line.start_t = bar.line.last_print_t = 0.0

    def left_at(seconds: float) -> str:
        bar.line._time = lambda: seconds
        bar.show()
        return str(bar.line).partition("left ")[2].split()[0]
    bar.tell(0, 0.0)
    assert left_at(70) == left_at(1000) == "?", "a case that has begun tells nothing"
    bar.fractions[0] = 1.0
    assert left_at(1024) == "51:12", "three times as long"
