"""Exact solutions the tools compare with: standing waves, the oscillating drop, the rotating square patch.

Linear standing waves over a free-slip bottom, with viscosity.

Linearised Navier-Stokes on -H < z < 0 with u = grad phi + rot psi, phi harmonic and psi diffusing. The surface
conditions (no shear, p = 2 rho nu w_z), Laplace transformed in time with an irrotational start, give

    D(s) = (s + 2 nu k^2)^2 + g k T - 4 nu^2 k^3 m T coth(m H),   m^2 = k^2 + s/nu,   T = tanh(k H)
    eta_hat = a0/s + (w0 - g k T a0/s) / D(s)

with a0 the elevation and w0 the vertical velocity of the surface at t = 0, both times cos(kx). D(s) = 0 is the
dispersion relation of the normal modes (Lamb 1932, art. 349, here for finite depth). The inverse is the residue
of the two oscillating modes plus a remainder with poles on the negative real axis only (diffusing vorticity), which
a Talbot contour integrates (Abate & Valko 2004).
"""

import cmath
import math

import numpy as np

TALBOT_NODES = 24  # about 10 digits in double precision; more nodes lose digits to cancellation


def inviscid_frequency(wavenumber, depth, gravity):
    """omega_0 of a linear gravity wave [1/s]."""
    return math.sqrt(gravity * wavenumber * math.tanh(wavenumber * depth))


def normal_mode(wavenumber, depth, gravity, viscosity):
    """Complex rate s of the oscillating normal mode, Im s > 0: elevation ~ exp(s t) [1/s]."""
    k, nu = wavenumber, viscosity
    tanh = math.tanh(k * depth)
    s = complex(-2 * nu * k * k, inviscid_frequency(k, depth, gravity))
    if nu == 0.0:
        return complex(0.0, s.imag)
    for _ in range(50):
        value, slope = dispersion(s, k, depth, gravity, nu, tanh)
        step = value / slope
        s -= step
        if abs(step) < 1e-15 * abs(s):
            break
    return s


def dispersion(s, k, depth, gravity, nu, tanh):
    """D(s) and dD/ds; s may be an array."""
    m = np.sqrt(k * k + np.asarray(s, dtype=complex) / nu)
    coth = 1.0 / np.tanh(m * depth)
    friction = 2 * nu * k * k
    value = (s + friction) ** 2 + gravity * k * tanh - 4 * nu**2 * k**3 * tanh * m * coth
    slope_of_m = coth + m * depth * (1.0 - coth * coth)  # d(m coth mH)/dm, with 1/sinh^2 = coth^2 - 1
    slope = 2 * (s + friction) - 4 * nu**2 * k**3 * tanh * slope_of_m / (2 * nu * m)
    return value, slope


class StandingWave:
    """Linear standing wave eta(t) cos(kx) that starts from rest level (or `elevation`) with a potential flow.

    amplitude: that of the inviscid wave [m]; the start is w = amplitude omega_0 cos(kx) at a flat surface.
    """

    def __init__(self, amplitude, wavenumber, depth, gravity, viscosity=0.0, density=1.0, elevation=0.0):
        self.k, self.depth, self.g, self.nu, self.rho = wavenumber, depth, gravity, viscosity, density
        self.omega0 = inviscid_frequency(wavenumber, depth, gravity)
        self.period0 = 2 * math.pi / self.omega0
        self.tanh = math.tanh(wavenumber * depth)
        self.w0 = amplitude * self.omega0
        self.a0 = elevation
        self.mode = normal_mode(wavenumber, depth, gravity, viscosity)

    @property
    def period(self):
        """Of the oscillating mode [s]."""
        return 2 * math.pi / self.mode.imag

    @property
    def mode_energy_kept(self):
        """Factor on the energy of the normal mode in one inviscid period."""
        return math.exp(2 * self.mode.real * self.period0)

    def elevation(self, time):
        """eta(t) at the antinode [m]."""
        if self.nu == 0.0:
            return self._inviscid(time)[0]
        return self.a0 + self._invert(self._surface, time)[..., 0]

    def velocity(self, time, z):
        """(u, w) amplitudes, of -sin(kx) and cos(kx): two arrays (n_time, n_z) [m/s]."""
        z = np.atleast_1d(np.asarray(z, dtype=float))
        if self.nu == 0.0:
            up, across = hyperbolic_ratios(np.asarray(complex(self.k)), z, self.depth)
            rise = self._inviscid(time)[1][:, None]
            return rise * across.real, rise * up.real
        both = self._invert(lambda s: np.concatenate(self._flow(s, z), axis=-1), time)
        return both[..., :len(z)], both[..., len(z):]

    def kinetic_energy(self, time, length):
        """Of the water between x = 0 and `length` (whole wavelengths), per metre of width [J/m]."""
        nodes, weights = np.polynomial.legendre.leggauss(80)
        # t in (0, 1) squared crowds the points at the surface, where the vorticity layer is
        share = 0.5 * (nodes + 1)
        z = -self.depth * share**2
        weight = self.depth * weights * share
        u, w = self.velocity(time, z)
        return 0.25 * self.rho * length * ((u**2 + w**2) * weight).sum(axis=-1)

    def potential_energy(self, time, length):
        """Above that of water at rest [J/m]."""
        return 0.25 * self.rho * self.g * length * self.elevation(time) ** 2

    def energy(self, time, length):
        return self.kinetic_energy(time, length) + self.potential_energy(time, length)

    # Transforms: numerators over the denominator D(s), and the part without poles at the modes.

    def _drive(self, s):
        return self.w0 - self.g * self.k * self.tanh * self.a0 / s

    def _surface(self, s):
        s = np.asarray(s, dtype=complex)[..., None]
        return self._drive(s) / self._dispersion(s)[0]

    def _dispersion(self, s):
        return dispersion(s, self.k, self.depth, self.g, self.nu, self.tanh)

    def _flow(self, s, z):
        """Transforms of u and w at the heights z: potential part and vortical layer."""
        k, h = self.k, self.depth
        s = np.asarray(s, dtype=complex)[..., None]
        friction = 2 * self.nu * k * k
        # A sinh(kH): the potential's strength at the surface; -friction/(s + friction) of it is the layer's
        strength = (s + friction) * self._drive(s) / (k * self._dispersion(s)[0])
        layer = -friction / (s + friction) * strength
        m = np.sqrt(k * k + s / self.nu)
        sinh_ratio, cosh_ratio = hyperbolic_ratios(m, z, h)
        up, across = hyperbolic_ratios(np.asarray([complex(k)]), z, h)
        return k * strength * across + layer * m * cosh_ratio, k * (strength * up + layer * sinh_ratio)

    def _invert(self, transform, time):
        """f(t) of F(s); F may have a last axis of its own. Poles at the two modes are taken out by residues."""
        time = np.atleast_1d(np.asarray(time, dtype=float))
        s1 = self.mode
        residue = self._residue(transform, s1)
        return np.array([self._at(transform, residue, s1, t) for t in time])

    def _residue(self, transform, s1):
        """Residue of F at s1, from a small circle around it (exact for an analytic remainder)."""
        radius = 0.02 * abs(s1.imag)
        angles = 2 * math.pi * (np.arange(32) + 0.5) / 32
        circle = s1 + radius * np.exp(1j * angles)
        return (transform(circle) * (circle - s1)[:, None]).mean(axis=0)

    def _at(self, transform, residue, s1, t):
        wave = 2 * (residue * cmath.exp(s1 * t)).real
        if t == 0.0:
            t = 1e-9 * self.period0  # the remainder is continuous there; the contour needs t > 0
            wave = 2 * (residue * cmath.exp(s1 * t)).real
        radius = 2 * TALBOT_NODES / (5 * t)
        theta = np.arange(1, TALBOT_NODES) * math.pi / TALBOT_NODES
        cot = 1 / np.tan(theta)
        nodes = np.concatenate([[complex(radius)], radius * theta * (cot + 1j)])
        slope = np.concatenate([[0.5], 1 + 1j * theta * (1 + cot**2) - 1j * cot])
        pair = residue / (nodes[:, None] - s1) + residue.conj() / (nodes[:, None] - s1.conjugate())
        remainder = transform(nodes) - pair
        return wave + (radius / TALBOT_NODES) * (np.exp(nodes * t)[:, None] * remainder * slope[:, None]).sum(0).real

    def _inviscid(self, time):
        """Elevation and its rate without viscosity."""
        phase = self.omega0 * np.atleast_1d(np.asarray(time, dtype=float))
        swing = self.w0 / self.omega0
        return (self.a0 * np.cos(phase) + swing * np.sin(phase),
                self.omega0 * (swing * np.cos(phase) - self.a0 * np.sin(phase)))


def hyperbolic_ratios(m, z, depth):
    """sinh(m(z+H))/sinh(mH) and cosh(m(z+H))/sinh(mH) without overflow; m (..., 1), z (n) -> (..., n)."""
    fall = np.exp(m * z)                       # |fall| <= 1: z <= 0, Re m >= 0
    echo = np.exp(-m * (z + 2 * depth))
    below = 1 - np.exp(-2 * m * depth)
    return (fall - echo) / below, (fall + echo) / below


class OscillatingDrop:
    """Ellipse of inviscid water, semi-axes a and b (a = b = radius at the start), in the central force -B^2 x.

    The flow stays u = (s x, -s z); its pressure is zero on the ellipse, and with p = rho P (1 - x^2/a^2 - z^2/b^2)

        s' = (s^2 + B^2) (b^2 - a^2)/(a^2 + b^2),   a' = s a,   b' = -s b,   P = (s^2 + B^2) a^2 b^2/(a^2 + b^2)

    (Monaghan & Rafiee 2013). strain: s at the start [1/s]; force: B [1/s].
    """

    def __init__(self, radius, strain, force, end):
        from scipy.integrate import solve_ivp
        self.radius, self.strain, self.force = radius, strain, force
        self._solution = solve_ivp(self._rates, (0.0, max(end, 10.0 / force)), (strain, radius, radius), rtol=1e-10,
                                   atol=1e-12 * radius, dense_output=True, events=self._full_turn)

    def _rates(self, _, state):
        s, a, b = state
        return (s * s + self.force**2) * (b * b - a * a) / (a * a + b * b), s * a, -s * b

    def _full_turn(self, t, state):
        return state[1] - state[2] if t > 0.0 else 1.0

    _full_turn.direction = 1  # a rises through b: the circle with the strain of the start

    @property
    def period(self):
        """Of the whole motion [s]."""
        return float(self._solution.t_events[0][0])

    def axes(self, time):
        """a(t), b(t) [m]."""
        _, a, b = self._solution.sol(np.asarray(time, dtype=float))
        return a, b

    @property
    def longest_axis(self):
        return float(self.axes(np.linspace(0.0, self.period, 4001))[0].max())


def square_patch_pressure(x, z, side, rate, density=1.0, terms=40):
    """Pressure [Pa] of a square patch at the moment it begins to rotate as a solid body with `rate` [1/s].

    lap p = 2 rho rate^2, p = 0 on the sides x, z = +-side/2; cosine series in x. At the centre -0.14734 rho rate^2 L^2.
    """
    k = np.pi / side
    x, z = np.asarray(x, dtype=float), np.asarray(z, dtype=float)
    sum_ = x * x - side**2 / 4
    for m in range(terms):
        n = 2 * m + 1
        # cosh(n k z)/cosh(n pi/2) without overflow
        fall = (np.exp(n * k * (np.abs(z) - side / 2)) + np.exp(-n * k * (np.abs(z) + side / 2))) / (1 + np.exp(-n * np.pi))
        sum_ = sum_ + (-1) ** m * 8 * side**2 / (np.pi * n) ** 3 * np.cos(n * k * x) * fall
    return density * rate**2 * sum_


def jet_on_wall(place):
    """Pressure over rho U^2 on a wall that a free jet of half thickness b hits squarely, `place` [b] from its middle line.

    Steady plane potential flow without gravity; the middle line may be a floor. On the wall the speed q over U grows as
    y/b = 4/pi (artanh q + arctan q) (the hodograph is the half disc, its source at 1, its sinks at +-i), p = (1 - q^2)/2;
    the integral of p over one half is 1, the momentum that arrives.
    """
    low, high = 0.0, 1.0 - 1e-15
    for _ in range(60):
        q = 0.5 * (low + high)
        low, high = (q, high) if 4 / math.pi * (math.atanh(q) + math.atan(q)) < place else (low, q)
    return 0.5 * (1.0 - low**2)


def ritter(distance, time):
    """Dam break on a dry floor by shallow water theory: speed and depth in front of the dam; all over H, sqrt(gH)."""
    return 2 / 3 * (1 + distance / time), max(0.0, 2 - distance / time) ** 2 / 9


def havelock_wave(radius, depth, speed, gravity):
    """Amplitude [m] of the waves behind a circular cylinder whose axis lies `depth` below the surface of a stream.

    Linear, inviscid, deep water, the cylinder as the dipole U a^2 (Havelock 1917, Proc. R. Soc. A 93; Lamb 1932, art. 247):
    A = 4 pi a^2 k0 exp(-k0 f), k0 = g/U^2.
    """
    k0 = gravity / speed**2
    return 4 * math.pi * radius**2 * k0 * math.exp(-k0 * depth)


def havelock_drag(radius, depth, speed, gravity, density=1.0):
    """Wave drag of that cylinder [N/m]: R = 4 pi^2 rho g a^4 k0^2 exp(-2 k0 f).

    The waves' energy rho g A^2/2 grows with U less their group velocity U/2, and R U is its rate: R = rho g A^2/4.
    """
    return density * gravity * havelock_wave(radius, depth, speed, gravity) ** 2 / 4
