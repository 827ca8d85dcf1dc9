"""Weights as they are printed, in 2D: w(r) and dw/dr inside of the range h = 3 sigma, r in units of sigma."""
import numpy as np

from particles.weights import Lucy, Monaghan, WendlandC2, WendlandC4, WendlandC6


def lucy(r, h):
    s, sigma = 3*r/h, h/3
    A = 5/(9*np.pi*sigma**2)
    return A*(1 + s)*(1 - s/3)**3, A/sigma*((1 - s/3)**3 - (1 + s)*(1 - s/3)**2)


def monaghan(r, h):
    s, sigma = 3*r/h, h/3
    A, inner = 40/(63*np.pi*sigma**2), s < 1.5
    w = np.where(inner, A*(1 - 2/3*s**2 + 2/9*s**3), 2*A*(1 - s/3)**3)
    return w, np.where(inner, A/sigma*(-4/3*s + 2/3*s**2), -2*A/sigma*(1 - s/3)**2)


def wendland(norm, power, *c):
    """norm/h^2 (1 - q)^power (c0 + c1 q + ...)."""
    def weight(r, h):
        q, poly = r/h, np.polynomial.Polynomial(c)
        w = norm/h**2*(1 - q)**power*poly(q)
        return w, norm/h**3*((1 - q)**power*poly.deriv()(q) - power*(1 - q)**(power - 1)*poly(q))
    return weight


PRINTED = {Lucy: lucy, Monaghan: monaghan, WendlandC2: wendland(7/np.pi, 4, 1, 4),
           WendlandC4: wendland(9/np.pi, 6, 1, 6, 35/3), WendlandC6: wendland(78/(7*np.pi), 8, 1, 8, 25, 32)}
