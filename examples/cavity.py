"""The differentially heated cavity: a gas that stands for a liquid, beside de Vahl Davis' printed numbers."""
from examples import picture, sized
from studies.build.cavity import compared
from studies.front import solve

done = solve("cavity", "grid", rows=sized(24, 16), ra=1e4, time=sized(1, 0.02))
print(done)
print(compared(done.scene, done.at))
done.plot(picture("cavity"))
