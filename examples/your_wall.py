"""Your own wall: a rule of what images do behind a plate; here, half of the velocity, reversed."""
from typing import NamedTuple

from examples import picture, sized
from particles.walls.mirror import velocity_and_temperature
from studies.build.setting import walls
from studies.build.spam import PRINTED
from studies.front import compare


class Halved(NamedTuple):
    """Images with half of the particle's velocity, reversed, at the wall's temperature."""


velocity_and_temperature.of(Halved)(lambda rule, wall_T, along, across, T: (-along/2, -across/2, wall_T))

mine = PRINTED._replace(name="halved", walls=lambda scene: walls(scene, Halved()))
done = compare("couette", ["grid", "spam", "spam-walls-odd", mine], rows=sized((16, 32), (8,)))
print(done)             # friction is too weak with images at rest, right with reversed images
done.plot(picture("your_wall"))
