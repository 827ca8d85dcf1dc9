"""States to start from: rest and rolls."""
import numpy as np

from continuum.boussinesq.flow import BoussinesqCase, State
from continuum.boussinesq.mac import End
from continuum.linear.layer import critical_ra


def rest(case: BoussinesqCase) -> State:
    """No flow, and the temperature that conduction would give: linear between the plates, or the sides."""
    mac, plates = case.mac, case.box.plates
    x, y = np.meshgrid(mac.x.centre/case.box.width, mac.y.centre, indexing="ij")
    T = 0.5 - (y if plates.heat is End.WALL else x)
    return State(case=case, q=np.r_[np.zeros(mac.ends[1]), T.ravel()])


def roll(case: BoussinesqCase, rolls: int = 1) -> State:
    """Rolls, rising at the left side, of the Lorenz model (free plates, Ra/Ra_c at least 1.1)."""
    if rolls < 1:
        raise ValueError(f"{rolls} rolls do not fit: a box has at least 1")
    mac, a = case.mac, rolls/case.box.width
    r = max(case.ra/critical_ra(np.pi*a), 1.1)
    swing = np.sqrt(8*(r - 1)/(1 + a**2))
    x, y = np.pi*a*mac.x.face[:, None], np.pi*mac.y.face
    psi = -case.kappa*(1 + a**2)/a*swing*np.sin(x)*np.sin(y)**2
    x, y = np.pi*a*mac.x.centre[:, None], np.pi*mac.y.centre
    warm = (swing*np.cos(x)*np.sin(y) - (r - 1)*np.sin(2*y))/(np.pi*r)
    T = rest(case).parts[2] + warm*(case.box.plates.heat is End.WALL)
    return State(case=case, q=np.r_[mac.curl@psi.ravel(), T.ravel()])
