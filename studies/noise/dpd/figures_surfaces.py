"""Figure of surfaces: profiles at flat walls, drag of cylinders against what their slip foretells."""
import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from studies.kit.figure import errorbar, figure, look
from studies.kit.table import Tables
from studies.noise.dpd.derive_surfaces import FRACTION
from studies.noise.dpd.slip import drag

NAMES = {"frozen": "frozen", "turned back": "turned back", "dense": "frozen, twice as dense"}


def figures(tables: Tables) -> dict[str, Figure]:
    """What the tables allow."""
    if all(len(tables.get(name, [])) for name in ("profile", "slabs", "surfaces")):
        return {"surface": surface(tables["profile"], tables["slabs"], tables["surfaces"])}
    return {}


def surface(profile: pd.DataFrame, slabs: pd.DataFrame, surfaces: pd.DataFrame) -> Figure:
    """Velocity by the wall in shear rates there, density, drag over that without slip."""
    page, (left, middle, right) = figure(1, 3, width=3.9, height=4.0)
    for number, (name, label) in enumerate(NAMES.items()):
        one = slabs[slabs["surface"] == name]
        if one.empty:
            continue
        wall = one.iloc[0]
        both = folded(profile[profile["surface"] == name], wall["height"]/2)
        rate = wall["push"]*wall["far"]/wall["viscosity"]*wall["height"]/2
        fluid = both[both["rho"] > 0.01*wall["far"]]       # of fewer no velocity is known
        errorbar(left, fluid["z"].tolist(), *((fluid[part]/rate).tolist() for part in ("u", "u_err")), number=number, label=label)
        z = np.linspace(-wall["slip"], wall["height"]/2, 100)
        left.plot(z, wall["slip"] + z - z**2/wall["height"], **{**look(number), "marker": ""})
        middle.plot(both["z"], both["rho"]/wall["far"], **{**look(number), "linestyle": "-"}, label=label)
    for panel in (left, middle):
        panel.axvspan(-1.5, 0, color="0.9")
        panel.axvline(0, color="0.3", linestyle="--", marker="")
        panel.set(xlabel="distance from the wall's edge, $r_c$", xlim=(-1.5, 3))
    left.set(ylabel="velocity over shear rate at the edge, $r_c$", title="flat walls: velocity, parabola from $z > 1$",
             ylim=(-0.2, 2.2))
    middle.set(ylabel="density over that far away", title="flat walls: fluid")
    over(right, surfaces)
    for panel in (left, right):
        panel.legend(loc="lower right" if panel is left else "best")
    return page


def folded(rows: pd.DataFrame, half: float) -> pd.DataFrame:
    """Both sides of the stream as one: means at the same distance z from the wall, errors as of two independent ones."""
    z = (half - rows["y"].abs()).round(6)
    found = rows.assign(z=z, square=rows["u_err"]**2).groupby("z").mean(numeric_only=True).reset_index()
    return found.assign(u_err=np.sqrt(found["square"]/2))


def over(panel, surfaces: pd.DataFrame) -> None:
    """Drag over the slip length of the flat wall in radii; the curve is that of Stokes flow."""
    slip = np.linspace(-0.15, 0.4, 56)
    panel.plot(slip, [drag(FRACTION, b)/drag(FRACTION) for b in slip], color="0.3", linestyle="--", marker="",
               label="Stokes flow with slip")
    inner = slip[slip < 0.25]
    panel.plot(inner, [drag(FRACTION*(1 - b)**2)/drag(FRACTION) for b in inner], color="0.3", linestyle=":", marker="",
               label="without, radius less by as much")
    for number, (name, label) in enumerate(NAMES.items()):
        some = surfaces[(surfaces["surface"] == name) & surfaces["wall_slip"].notna()]
        for k, (_, row) in enumerate(some.sort_values(["radius", "asked"]).iterrows()):
            seen = {**look(number), "linestyle": "none", "markerfacecolor": "white" if k else look(number)["color"]}
            panel.errorbar(row["wall_slip"]/row["radius"], row["ratio"], xerr=row["wall_slip_err"]/row["radius"],
                           yerr=row["ratio_err"], label=f"{label}, $R$ = {row['radius']:g}, Re = {row['reynolds']:.1f}", **seen)
    panel.axhline(1, color="0.6", linestyle="-", linewidth=0.8, marker="")
    panel.set(xlabel="slip length of the flat wall over $R$", ylabel="drag over that of a smooth cylinder",
              title="solid fraction 0.2, inertia taken out")
