"""Fluctuations in 3D, about flows that move, and what null modes do to velocities of points, judged    [RR98 Eqs 20-25, 37]"""
from studies.build.read import exact
from studies.kit.claim import Claim
from studies.noise.fluctuations.read_flows import (
         as_uniform,
         fields_3d,
         floor,
         in_stream,
         largest,
         peak_in_stream,
         rms,
         sampled_floor,
         sampled_power,
         sampled_seen,
         seen,
         shear_slope,
         sheared,
         shift_order,
         tail_of,
         tail_sampled,
         total_3d,
)

T19 = "sqrt(19/17), the rms of t with 19 degrees of freedom"
LATER = ("next orders, 3 nu/(c_T^2 t) = 1 % and 1/(nu t) = 3 %; read later: at first sound, which had not gone round the small "
         "box, was left out of the total momentum, and nu/(c^2 t) was 3 %, thrice")
FLOWS = (
    Claim(id="rr98-fluct-equipartition-3d", source="RR98 Eqs 22, 24", expect=1, within=0.005, value=total_3d,
          because="half a per cent: the size that an experiment resolves",
          statement="sampled in 3D, all degrees of freedom of a gas at rest together have their variance: mean ratio, farther"
                    " from 1 of a lattice and jittered points"),
    Claim(id="rr98-fluct-equipartition-3d-rms", source="RR98 Eqs 22, 24", expect=1.057, within=0.27, value=rms("cubes"),
          because=f"{T19}; 0.27 is three standard deviations of 200 modes and their error",
          statement="in 3D single modes scatter about their variance as their error bars say: rms of deviations over standard"
                    " errors"),
    Claim(id="rr98-fluct-equipartition-3d-worst", source="RR98 Eqs 22, 24", at_most=1, value=largest("cubes"),
          because="Bonferroni: all modes keep the bound in 95 % of all cases",
          statement="in 3D no single mode is off: largest deviation over the bound for that many modes"),
    Claim(id="rr98-fluct-equipartition-3d-fields", source="RR98 Eqs 22, 24", at_most=1, value=fields_3d,
          because="Bonferroni: all means keep the bound in 95 % of all cases",
          statement="in 3D density, velocity along and across k, and temperature each have their variance: largest deviation "
                    "of a mean over waves, lattice and jittered points, over the bound for that many means"),
    Claim(id="rr98-fluct-eq20-shear", source="RR98 Eqs 20-25", expect=1, within=0.01, value=sheared("vortical", strong=False),
          because="1 %: sound, which vortical waves leave out, adds some U^2 to what is enhanced by 1000 U^2 and more",
          statement="linear about a weak shear flow u = U sin(q y), velocities across it of waves along it are enhanced as "
                    "those of an incompressible fluid are by the lattice symbols: Lyapunov over that, farthest from 1"),
    Claim(id="rr98-fluct-eq20-shear-strong", source="RR98 Eqs 20-25", expect=1, within=0.01,
          value=sheared("vortical", strong=True),
          because="1 %: sound adds some U^2, U = 0.01 and 0.05, to what is enhanced by 0.1 and more",
          statement="the same in strong shears, to all orders in U"),
    Claim(id="rr98-fluct-eq20-shear-second", source="RR98 Eqs 20-25", expect=1, within=0.05,
          value=sheared("second", strong=False),
          because="5 %: (k a)^2 = 0.04 of the shortest of these waves, by which lattices differ from the continuum",
          statement="in the weak one they are enhanced by U^2 q^2/[2 nu^2 (2 k^2 + q^2)(k^2 + q^2)]: Lyapunov over that, "
                    "farthest from 1"),
    Claim(id="rr98-fluct-eq20-shear-fourth-power", source="RR98 Eqs 20-25", expect=-4, within=0.05, value=shear_slope,
          because="0.05: of two per cent over a factor of two in k",
          statement="this enhancement falls as k^-4, as in a uniform shear [power law from memory of Lutsko & Dufty 1985]: "
                    "power from waves shorter than the period, what the period takes from it divided out"),
    Claim(id="rr98-fluct-eq20-shear-uniform", source="RR98 Eqs 20-25", expect=1, within=0.13, value=as_uniform,
          because="13 %: (3/2) (q/k)^2 = 9 % for the period, (k a)^2/4 = 4 % for the lattice",
          statement="short waves are enhanced as by the uniform shear g where they are, 2 g^2 int s exp[-2 nu k^2 (s + g^2 "
                    "s^3/3)] ds, g^2/(2 nu^2 k^4) where g is small [derived here, in 2D]: Lyapunov over its mean, waves of 16"
                    " spacings, U = 0.05"),
    Claim(id="rr98-fluct-eq20-flow-rms", source="RR98 Eqs 20-25", expect=1.057, within=0.4, value=rms("flows"),
          because=f"{T19}; 0.4 is three standard deviations of 96 modes and their error",
          statement="sampled in the full equations about a shear flow and a uniform stream, on jittered points, single modes "
                    "scatter about the Lyapunov solve as their error bars say: rms of deviations over standard errors"),
    Claim(id="rr98-fluct-eq20-flow-worst", source="RR98 Eqs 20-25", at_most=1, value=largest("flows"),
          because="Bonferroni: all modes keep the bound in 95 % of all cases",
          statement="no single mode of these is off: largest deviation over the bound for that many modes"),
    Claim(id="rr98-fluct-eq20-flow-seen", source="RR98 Eqs 20-25", at_least=1.2, value=seen,
          because="equilibrium is 1, and samples are good to 0.2",
          statement="these samples tell the shear flow from rest: variance of the velocity across it over kT/(rho V), longest"
                    " wave along it"),
    Claim(id="rr98-fluct-eq20-given-worst", source="RR98 Eqs 20-25", at_most=1, value=largest("sampled"),
          because="Bonferroni: all modes keep the bound in 95 % of all cases, whatever they have to do with each other",
          statement="samples of the linear equations about a temperature gradient and about a motionless layer below onset have "
                    "the variances of the Lyapunov solve: largest deviation of a mode over the bound for that many modes"),
    Claim(id="rr98-fluct-eq25-gradient-seen", source="RR98 Eqs 20-25", at_least=5, value=sampled_seen("gradient", "T"),
          because="equilibrium is 1, the closed form has 11",
          statement="they show what the gradient enhances: sampled variance of T over that at rest, waves of 63 spacings, T = 1 "
                    "+ 0.1 sin(2 pi y/24)"),
    Claim(id="rr98-fluct-eq25-onset-seen", source="RR98 Eqs 20-25", at_least=5, value=sampled_seen("layer", "w"),
          because="equilibrium is 1, rows of the Lyapunov solve add up to 10",
          statement="and what is about to convect: sampled variance of the velocity across a layer of 8 rows, 2 % below onset, "
                    "over that at rest"),
    Claim(id="rr98-fluct-eq25-onset-sampled", source="RR98 Eqs 20-25", printed="the flow is stable", expect=-1, within=0.15,
          value=sampled_power, because="0.15: samples reach 0.05, the next power of the distance from onset adds 0.04",
          statement="sampled fluctuations of the slowest mode grow as 1/(Ra_c - Ra) on the way to onset: power, from 10 % to 2 %"
                    " below"),
    Claim(id="rr98-fluct-galilean-static", source="RR98 Eqs 20-25", at_most=1e-10, value=in_stream(nested=True),
          because="Lyapunov's equation, solved twice, with differences good to 1e-12",
          statement="in a uniform stream past fixed points fluctuations are those of equilibrium, carried along: largest |C -"
                    " C_eq|, stresses of points on Delaunay edges, any transport on a lattice, speed 0.35 c"),
    Claim(id="own-fluct-galilean-mended", source="RR98 Eqs 20-25, 51", at_most=1e-10, value=in_stream(nested=False),
          because="Lyapunov's equation, solved twice, with differences good to 1e-12",
          statement="so are they with friction along edges off a lattice, its heating mended: largest |C - C_eq|; the work of"
                    " the mending stress on the stream is no divergence that momentum feels"),
    Claim(id="rr98-fluct-galilean-position", source="RR98 Eqs 20-25", expect=1, within=0.005,
          value=peak_in_stream("position", "symbol"), because="half a per cent, as at rest",
          statement="in a stream of 0.7 c the Brillouin peaks of sampled density waves are as far apart as the symbol of rest"
                    " has them: ratio, waves of 8 spacings"),
    Claim(id="rr98-fluct-galilean-width", source="RR98 Eqs 20-25", expect=1, within=0.03,
          value=peak_in_stream("half width", "symbol"), because="3 %, as at rest",
          statement="and as wide: half width over the symbol's damping of sound"),
    Claim(id="rr98-fluct-galilean-shift", source="RR98 Eqs 20-25", expect=1, within=0.005, value=peak_in_stream("shift", "speed"),
          because="half a per cent: the size that an experiment resolves",
          statement="the stream carries the sampled spectrum along at its own speed: shift of the Rayleigh peak over speed "
                    "times k, waves of 8 spacings"),
    Claim(id="own-fluct-galilean-symbol", source="RR98 Eqs 20-25", expect=1, within=0.005,
          value=peak_in_stream("shift", "symbol"),
          because="half a per cent: the size that an experiment resolves",
          statement="it does so at its speed times the symbol of the lattice's gradient: shift of the Rayleigh peak over that"),
    Claim(id="own-fluct-galilean-order", source="RR98 Eqs 20-25", expect=2, within=0.05, value=exact(shift_order),
          because="next order, (k a)^2 = 0.01",
          statement="what the shift lacks is of second order in the spacing: power of k, waves of 63 and 126 spacings"),
    Claim(id="own-fluct-tail-fluid", source="RR98 Eqs 22, 37, 51", expect=1, within=0.1, value=tail_of(0.1),
          because="next order, 1/(nu t) = 3 %, of lattice and fluid",
          statement="without null modes, a tenth of friction along edges, the velocity of a point of the fluid has the tail "
                    "kT/(8 pi rho nu t): ratio, nearest neighbours, nu t = 30 a^2"),
    Claim(id="own-fluct-tail-edges", source="RR98 Eq. 51", expect=1, within=0.1, value=tail_of(1.0),
          because="next order, 1/(nu t) = 3 %, of lattice and fluid",
          statement="with all friction along edges it has the same tail"),
    Claim(id="own-fluct-tail-nulls", source="RR98 Eqs 22, 37", expect=4, within=0.1, value=tail_of(0.0),
          because="next order, 1/(nu t) = 3 %",
          statement="with null modes, nested transport alone, it has 2^d times that tail, sound and heat included"),
    Claim(id="own-fluct-tail-fluid-large", source="RR98 Eqs 22, 37, 51", expect=1, within=0.1, value=tail_of(0.1, large=True),
          because=LATER,
          statement="the same, a tenth of friction along edges, less viscous and in a box three times as wide: tail over "
                    "kT/(8 pi rho nu t)"),
    Claim(id="own-fluct-tail-edges-large", source="RR98 Eqs 22, 37, 51", expect=1, within=0.1, value=tail_of(1.0, large=True),
          because=LATER,
          statement="the same, all friction along edges, less viscous and in a box three times as wide: tail over "
                    "kT/(8 pi rho nu t)"),
    Claim(id="own-fluct-tail-nulls-large", source="RR98 Eqs 22, 37, 51", expect=4, within=0.1, value=tail_of(0.0, large=True),
          because=LATER,
          statement="the same, nested transport alone, null modes, less viscous and in a box three times as wide: tail over "
                    "kT/(8 pi rho nu t)"),
    Claim(id="own-fluct-tail-floor", source="RR98 Eqs 22, 37", expect=3, within=0.01, value=floor(0.0),
          because="all other modes have decayed by exp(-200)",
          statement="null modes leave a floor of 2^d - 1 over the number of points: that number times the autocorrelation, "
                    "nested transport, 24 x 24 points, nu t = 3000 a^2"),
    Claim(id="own-fluct-tail-no-floor", source="RR98 Eqs 37, 51", expect=0, within=0.01, value=floor(0.1),
          because="all modes have decayed by exp(-200)",
          statement="a tenth of friction along edges leaves none"),
    Claim(id="own-fluct-tail-sampled", source="RR98 Eqs 22, 37", at_most=1, value=tail_sampled,
          because="Bonferroni: all lags keep the bound in 95 % of all cases",
          statement="sampled velocities have these autocorrelations, with and without null modes: largest deviation over the "
                    "bound for that many lags"),
    Claim(id="own-fluct-tail-sampled-floor", source="RR98 Eqs 22, 37", expect=3, within=0.3, value=sampled_floor,
          because="a tenth: what samples reach",
          statement="in samples, too, null modes stay: number of points times the autocorrelation after 15 a^2/nu, 6 x 6 "
                    "points, null modes begun at their rms"),
)
