"""What terms cost: what is left out is not stored."""
from studies.build.scenes import TaylorGreen
from studies.cost import contestants, derive, left_out, tables
from studies.cost.seconds import array_bytes


def test_what_is_left_out_is_not_stored():
    """Noise: no numbers of pairs."""
    noisy, silent = (make(8).problem for make in (left_out.vortex_with_noise, left_out.vortex_without_noise))
    assert array_bytes(silent.held()) < array_bytes(noisy.held())


def test_a_base_is_measured_whole_and_in_parts(monkeypatch):
    """Noise of 1e-6 changes less of a vortex than what matters, but something."""
    faster = contestants.ExactFlow(TaylorGreen(L=12, mach=0.2))      # its answer takes seconds less
    monkeypatch.setattr(left_out, "FLOW", faster)
    case = left_out.LeavingOut(base=left_out.BASES[2], size=12, short=1e-5)
    whole, silent = case.run(lambda done: None, None).rows["measured"]
    assert [whole["left_out"], silent["left_out"]] == ["nothing", "noise"]
    assert set(silent) == set(tables.TERMS[0].columns)
    assert whole["changed"] == 0 < silent["changed"] < derive.MATTERS
    assert {base.scene for base in left_out.BASES} == {"taylor-green", "convection"}
