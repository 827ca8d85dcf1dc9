"""A change runs again what it changes, and nothing else."""
import shutil
from pathlib import Path
from runpy import run_path

import pytest

from continuum.jit import generic
from studies.cost import STUDY as cost
from studies.hardcases import STUDY as hardcases
from studies.kit.case import Case, key_of, starts
from studies.kit.key import CODE, PACKAGES, ROOT, Code
from studies.kit.study import names, study_of
from studies.kit.syntax import Place, parse
from studies.rb import STUDY as rb
from studies.streams import STUDY as streams

QUARTIC = '''

class Quartic(Weight):
    """(1 - q^2)^4"""


shape.of(Quartic)(lambda weight, q: (1 - q**2)**4)
slope.of(Quartic)(lambda weight, q: -8*(1 - q**2)**3)
WEIGHTS["quartic"] = Quartic
'''
#: file, its first method, a new one
METHODS = (
    ("studies/build/spam.py", 'Variant("printed-half-step"', 'Variant("new", h=7.0)'),
    ("studies/build/fixed.py", 'Scheme("fixed-lattice"', 'Scheme("new", h=7.0)'),
    ("studies/build/moving.py", 'FacesMotion("moving-open-faces"', 'FacesMotion("new", of_limit=0.1)'),
    ("studies/build/grid.py", 'GridForm("paper-form"', 'GridForm("new")'),
)


@pytest.fixture(scope="module")
def cases() -> list[Case]:
    """The first case of each study and class."""
    found = {}
    for study in map(study_of, names()):
        for case in study.cases("quick"):
            found.setdefault((study.name, type(case)), case)
    return list(found.values())


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A copy of the three packages."""
    folder = tmp_path_factory.mktemp("copy")
    for package in PACKAGES:
        shutil.copytree(ROOT/package, folder/package, ignore=shutil.ignore_patterns("__pycache__"))
    return folder


def edit(root: Path, name: str, old: str, new: str) -> None:
    """Replace a text that is there."""
    text = (root/name).read_text()
    assert old in text
    (root/name).write_text(text.replace(old, new))
    parse.cache_clear()     # a process reads its own code once


def changed(cases, root):
    """The cases whose keys are others in a copy."""
    code = Code(root)
    return [case for case in cases if key_of(case, code) != case.key]


def reached(case, *place):
    """Does a case's run use a definition of ours?"""
    return Place(*place) in CODE.reached(filter(None, starts(case)))


# --- in the whole repository ----------------------------------------------------------------------

def test_a_new_weight_a_function_that_moves_and_a_docstring_change_no_key(cases, copy):
    with open(copy/"particles/weights.py", "a") as file:
        file.write(QUARTIC)
    edit(copy, "particles/terms.py", '"""Differences of vx', '"""Other words for vx')
    text = (copy/"continuum/fluid.py").read_text()
    start, end = text.index("@formula\ndef stress("), text.index("def stress_tensor(")
    (copy/"continuum/moved.py").write_text("from continuum.jit import formula\n\n\n" + text[start:end])
    (copy/"continuum/fluid.py").write_text("from continuum.moved import stress\n" + text[:start] + text[end:])
    assert any(reached(case, "continuum.fluid", "stress") for case in cases)
    assert len(cases) > 50 and not changed(cases, copy)


def test_studies_of_all_methods_depend_in_each_case_on_its_own_alone(copy):
    """One hard case a table and method, one of cost a method and scene: they look up no names."""
    hard = {(type(case), getattr(case, "into", ""), repr(getattr(case, "entrant", ""))): case
            for case in hardcases.cases("paper")}
    races = {case.label.split(", resolution")[0]: case for case in cost.cases("paper")}
    for file, first, new in METHODS:
        edit(copy, file, first, f"{new}, {first}")
    assert len(hard) > 60 and len(races) > 50
    assert not changed([*hard.values(), *races.values()], copy)
    edit(copy, "particles/terms.py", "q = (a.qx + b.qx)*ab.wx", "q = (a.qx - b.qx)*ab.wx")
    assert changed(races.values(), copy) == [case for case in races.values() if "spam" in case.label]


def test_a_line_in_the_fluxes_changes_the_keys_of_spam_and_not_of_grids(cases, copy):
    """The line is another one since the test before."""
    names = {type(case).__name__ for case in changed(cases, copy)}
    assert "SpamRun" in names and not any("Compressible" in name or "Pypde" in name for name in names)
    assert {type(case).__name__ for case in cases if reached(case, "particles.terms", "Fluxes")} == names


def test_friction_along_edges_is_reached_by_points_and_not_by_smooth_particles(cases):
    """Each term of the exchange is registered by itself: none is reached with another."""
    friction = "particles.integral.exchange", "Friction"
    names = {type(case).__name__ for case in cases if reached(case, *friction)}
    assert {"VortexDecay", "LayerDrift"} <= names
    assert not names & {"SpamRun", "SpamGrowth", "CompressibleSteady"}


def test_a_flux_that_survives_is_reached_by_methods_that_list_it_alone():
    """One case a class and method of studies that try all methods."""
    tried = [*rb.cases("fine"), *streams.cases("paper"), *cost.cases("paper")]
    one = {(type(case), repr(getattr(case, "variant", getattr(case, "entry", "")))): case for case in tried}
    listed = [case for case in one.values() if "entropy-stable" in case.label]
    assert len(one) > 100 and len(listed) > 1
    flux = "particles.integral.entropy_fluxes", "Dissipation"
    assert [case for case in one.values() if reached(case, *flux)] == listed


def test_a_new_variant_adds_cases_and_leaves_those_there_are(monkeypatch):
    from studies.build.spam import VARIANTS, Variant
    before = {case.key for case in rb.cases("fine")}
    monkeypatch.setitem(VARIANTS, "new", Variant("new", h=7.0))
    assert before < {case.key for case in rb.cases("fine")}


# --- in a small one -------------------------------------------------------------------------------

FILES = {
    "continuum/laws.py": "import numpy as np\nfrom continuum.jit import generic\n\nSIZE = 3\nOTHER = 4\n\n\n"
                         "@generic\ndef law(kind, x):\n    'Doc.'\n\n\n"
                         "class A:\n    pass\n\n\nclass B:\n    pass\n\n\n"
                         "law.of(A)(lambda kind, x: x + SIZE)\nTABLE = {'a': A, 'b': B}\n",
    "continuum/jit.py": "def generic(stub):\n    return stub\n",
    "studies/one.py": "from continuum import laws\nfrom continuum.laws import TABLE\n\n\n"
                      "def run(x):\n    # why\n    SIZE = [np for np in x]\n"
                      "    return laws.law(TABLE['a'](), x), SIZE\n",
}
RUN = Place("studies.one", "run")


@pytest.fixture
def tree(tmp_path):
    for name, text in FILES.items():
        (tmp_path/name).parent.mkdir(exist_ok=True)
        (tmp_path/name).write_text(text)
    return tmp_path


def hashed(tree, places=(RUN,)):
    parse.cache_clear()
    return Code(tree).hash(places)


@pytest.mark.parametrize("name, old, new", [
    ("continuum/laws.py", "SIZE = 3", "SIZE = 4"), ("continuum/laws.py", "x + SIZE)", "x - SIZE)"),
    ("continuum/laws.py", "class A:\n    pass", "class A:\n    y = 1"),
    ("continuum/laws.py", "'a': A", "'a': B"),
    ("studies/one.py", "), SIZE", "), 1"), ("continuum/jit.py", "return stub", "return None"),
])
def test_what_a_run_reads_changes_its_key(tree, name, old, new):
    before = hashed(tree)
    edit(tree, name, old, new)
    assert hashed(tree) != before


@pytest.mark.parametrize("name, old, new", [
    ("continuum/laws.py", "OTHER = 4", "OTHER = 5"), ("continuum/laws.py", "'Doc.'", "'Other words.'"),
    ("continuum/laws.py", "class B:\n    pass", "class B:\n    y = 1"),
    ("continuum/laws.py", "'b': B}", "'b': B, 'c': B}\nTABLE['d'] = B\nlaw.of(B)(lambda kind, x: x)"),
    ("studies/one.py", "# why", "# why not"),
    ("studies/one.py", "def run(x):", "def run(x: laws.B) -> laws.B:"),
    ("studies/one.py", "def run(x):\n", "def run(x):\n    from continuum.laws import TABLE as table\n"),
])
def test_what_a_run_does_not_read_leaves_its_key(tree, name, old, new):
    before = hashed(tree)
    edit(tree, name, old, new)
    assert hashed(tree) == before


def test_a_formula_for_a_pair_that_a_run_reaches_changes_its_key_wherever_it_is(tree):
    before = hashed(tree)
    text = "from continuum.laws import A, B, law as rule\n\n\n@rule.of(B)\ndef _(kind, x):\n    return 1\n"
    (tree/"studies/apart.py").write_text(text)
    assert hashed(tree) == before
    (tree/"studies/apart.py").write_text(text.replace("of(B)", "of(A)"))
    assert hashed(tree) != before


def test_fields_cost_and_label_of_a_case_are_no_part_of_a_result(tree):
    text = ("class Run:\n    kind: str = 'a'\n\n    def run(self):\n        return self.kind\n\n"
            "    def cost(self):\n        return 1\n")
    (tree/"studies/two.py").write_text(text)
    place = Place("studies.two", "Run", "case")
    before = hashed(tree, [place])
    edit(tree, "studies/two.py", "return 1", "return 2")
    edit(tree, "studies/two.py", "'a'", "'b'")
    assert hashed(tree, [place]) == before
    edit(tree, "studies/two.py", "return self.kind", "return self.kind*2")
    assert hashed(tree, [place]) != before


def test_a_star_import_is_refused(tree):
    edit(tree, "studies/one.py", "import TABLE", "import *")
    with pytest.raises(ValueError,
                       match=r"from continuum.laws import \* in studies.one: import names one by one"):
        hashed(tree)


# --- registries -----------------------------------------------------------------------------------

def test_a_second_formula_for_one_type_is_refused_with_both_places(tmp_path):
    class Kind:
        pass

    @generic
    def rule(kind):
        """A rule."""
    files = [tmp_path/"one.py", tmp_path/"two.py"]
    for number, file in enumerate(files):
        file.write_text(f"\nrule.of(Kind)(lambda kind: {number})\n")
    for _ in range(2):      # a module that is loaded again
        run_path(str(files[0]), {"rule": rule, "Kind": Kind})
    words = f"rule of Kind is defined in {files[0]}:2 and again in {files[1]}:2: delete one"
    with pytest.raises(ValueError, match=words):
        run_path(str(files[1]), {"rule": rule, "Kind": Kind})
    assert rule(Kind()) == 0
