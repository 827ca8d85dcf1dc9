"""Tables of the study conservation. Lengths in spacings a, gas at rho = T = 1 with C_V = 1; `_err` 95 % half widths."""
from studies.kit.table import Table

RUN = ["scheme", "mode", "d", "maker", "weight", "h", "points", "wall", "zeta"]
#: largest change of each sum over a run: of mass, energy and volume over what they were, of momentum over the sum of its sizes;
#: err: round-off of the sums themselves; claimed: which of them the scheme claims to keep; reached: steps until it
#: diverged or heated so much that sound outran its step, or all; motion: kinetic energy (of velocities less their mean) at the
#: end over that at the start
DRIFT = Table("drift", key=[*RUN, "seed"], columns=[*RUN, "seed", "n", "steps", "reached", "claimed", "mass", "momentum",
                                                    "energy", "volume", "err", "motion"])
#: the worst of the runs of a scheme, mode and wall by maker of edges: those that reached the end
KEPT = Table("kept", key=["scheme", "mode", "d", "wall", "maker"],
             columns=["scheme", "mode", "d", "wall", "maker", "runs", "finished", "mass", "momentum", "energy", "volume", "err"])

#: every value of every factor by which runs differ: the worst of the sums that they claim to keep, in those that reached the end
#: and in those that stopped early, up to where they were looked at last
FACTORS = Table("factors", key=["factor", "value"], columns=["factor", "value", "runs", "finished", "mass", "momentum", "energy",
                                                             "stopped"])
#: sums that are not claimed: the least and the most that runs changed them by, as far as they went
LOST = Table("lost", key=["scheme", "mode", "wall", "sum"], columns=["scheme", "mode", "wall", "sum", "runs", "least", "most"])

FRAME = ["mode", "maker", "points"]
#: rates in a wind less rates at rest, transformed and carried along: largest over points, over the largest rate
FRAMES = Table("frames", key=[*FRAME, "seed"], columns=[*FRAME, "seed", "mass", "momentum", "energy"])
FRAME_MEANS = Table("frame_means", key=FRAME, columns=[*FRAME, "seeds", "mass", "mass_err", "momentum", "momentum_err", "energy",
                                                       "energy_err"])
#: friction along edges: largest difference of energy rates in a wind, the same by the commutator of slopes, and what that leaves
#: of it, over the largest rate
COMMUTATORS = Table("commutators", key=["maker", "points", "seed"],
                    columns=["maker", "points", "seed", "found", "foretold", "left"])
#: sound without friction, linear, in a box of one wavelength: growth is the fastest per period of that wave, from eigenvalues;
#: ln_energy is ln of the energy after so many periods over that at the start
WAVE = ["bracket", "maker", "points"]
SOUND = Table("sound", key=[*WAVE, "seed"], columns=[*WAVE, "seed", "periods", "growth", "growth_err", "ln_energy"])
SOUND_MEANS = Table("sound_means", key=WAVE, columns=[*WAVE, "seeds", "growth", "growth_err", "ln_energy", "ln_energy_err"])

ALL = (DRIFT, KEPT, FACTORS, LOST, FRAMES, FRAME_MEANS, COMMUTATORS, SOUND, SOUND_MEANS)
