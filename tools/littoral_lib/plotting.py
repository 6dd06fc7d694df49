"""littoral plot: the standard picture of a run."""

import functools
import pathlib

import numpy as np

from . import compare, signals, tables
from .collect import read_json
from .errors import UserError
from .moment import BLANKED, Moments

COLOURS = {"sph": "#c1272d", "fv": "#0b5394", "all": "#222222"}
CELLS_WITH_EDGES = 150  # cells along the picture up to which their edges are drawn
NAMES = {"sph": "SPH particles", "fv": "FV cells"}


def pyplot():
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
                         "legend.frameon": False, "figure.dpi": 110, "savefig.bbox": "tight"})
    return plt


class Picture:
    """What the panels of a run share: its files, its scene's interface, its reference."""

    def __init__(self, out):
        self.out = pathlib.Path(out)
        self.summary = read_json(self.out / "summary.json")
        if self.summary is None:
            raise UserError(f"{out}: no summary.json; is this a folder that 'littoral run' wrote?")
        self.wave = None
        if (self.summary.get("reference") or {}).get("solution") == "standing_wave":
            self.wave = compare.StandingWaveRun(self.out)
        self.moments = None
        try:
            self.moments = Moments(self.out)
        except UserError:
            pass
        self.regions = self.summary.get("regions") or []

    def scalars(self):
        path = self.out / "scalars.csv"
        return tables.read_csv(path) if path.is_file() else None

    def moment(self):
        """Time of the field picture: of a wave when it is both raised and moving, of a stream past the particles the last,
        else of the fastest water."""
        if self.wave and self.moments.times()[-1] > 1.125 * self.wave.wave.period0:
            return 1.125 * self.wave.wave.period0
        return self.moments.times()[-1] if self.closer else self.moments.most_lively()

    @functools.cached_property
    def closer(self):
        """(x limits, z limits) around the particles' boxes where these are a small part of the water; None: show all."""
        if not self.regions or self.moments is None or len(self.moments.series) < 2:
            return None
        low, high = (np.array([r[k] for r in self.regions]) for k in ("lower", "upper"))
        low, high = low.min(axis=0), high.max(axis=0)
        whole = self.moments.at(0.0)["fv"].x
        if high[0] - low[0] > 0.5 * np.ptp(whole[:, 0]):
            return None
        margin = 0.5 * (high[0] - low[0])
        return ((low[0] - margin, high[0] + margin), (max(whole[:, 2].min(), low[2] - margin), min(whole[:, 2].max(), high[2] + margin)))

    def excess_pressure(self, part):
        """p without the weight of the water at rest density, so that a kink of a few pascals is seen [Pa]."""
        return part.p - self.summary.get("density", 0.0) * part.x @ self.summary.get("gravity", [0, 0, 0])

    # Panels, each into given axes.

    def elevation(self, axes):
        wave = self.wave
        t = np.linspace(1e-6, wave.gauge_time[-1], 600)
        scale = wave.reference["amplitude"]
        period = wave.wave.period0
        axes.plot(t / period, wave.wave.elevation(t) / scale, color="#888888", lw=3, label="exact (linear, viscous)")
        axes.plot(wave.gauge_time / period, wave.elevation / scale, color=COLOURS["sph"], lw=1, label="computed")
        axes.set(xlabel="time / inviscid period", ylabel="elevation at x = 0 / a", ylim=(-1.15, 1.4))
        axes.legend(loc="upper right", ncol=2)

    def energy(self, axes):
        wave = self.wave
        t = np.linspace(1e-6, wave.time[-1], 300)
        period, start = wave.wave.period0, wave.kinetic[0]  # flat at the start
        exact_energy = wave.wave.energy(np.append(0.0, t), wave.length)
        exact_kinetic = wave.wave.kinetic_energy(t, wave.length)
        axes.plot(np.append(0, t) / period, exact_energy / exact_energy[0], color="#888888", lw=3, label="exact")
        axes.plot(t / period, exact_kinetic / exact_energy[0], color="#cccccc", lw=2.5)
        axes.plot(wave.time / period, wave.energy / start, color="#dddddd", lw=0.7)
        axes.plot(wave.time / period, self.without_ringing(wave.energy) / start, color=COLOURS["all"], lw=1,
                  label="total")
        axes.plot(wave.time / period, wave.kinetic / start, color=COLOURS["fv"], lw=1, label="kinetic")
        axes.set(xlabel="time / inviscid period", ylabel="energy / initial energy", ylim=(0, 1.3))
        axes.legend(loc="upper right", ncol=3)

    def without_ringing(self, energy):
        """Mean over one period 4H/c of the column's gravest acoustic mode, in which its weight bobs up and down."""
        period = 4 * self.wave.wave.depth / self.summary["sound_speed"]
        return signals.moving_mean(self.wave.time, energy, period)

    def history(self, axes):
        scalars = self.scalars()
        if scalars is None:
            return
        for name in ("kinetic_energy", "potential_energy"):
            if name in scalars:
                values = scalars[name] - (scalars[name][0] if name.startswith("pot") else 0)
                axes.plot(scalars["time"], values, lw=1, label=name.replace("_", " "))
        axes.set(xlabel="time [s]", ylabel="energy [J] (potential: change)")
        axes.legend(loc="best")

    def elevations(self):
        """{gauge: (time, elevation)} of both programs' elevation gauges."""
        found = {}
        for program in ("sph", "fv"):
            path = self.out / program / "gauges.csv"
            if path.is_file():
                gauges = tables.read_csv(path)
                found.update({name.removesuffix(".elevation"): (gauges["time"], gauges[name])
                              for name in gauges.columns if name.endswith(".elevation")})
        return found

    def levels(self, axes, elevations):
        for name, (time, level) in elevations.items():
            axes.plot(time, level, lw=1, label=name)
        axes.set(xlabel="time [s]", ylabel="elevation [m]")
        axes.legend(loc="best", ncol=2)

    def field(self, axes, time, figure):
        parts = self.moments.at(time)
        top = max(float(part.speed[part.phi < 0].max() if part.phi is not None else part.speed.max())
                  for part in parts.values()) or 1.0
        drawn = None
        closer = self.closer
        for x, z, speed in parts["fv"].sheets() if "fv" in parts else ():
            edges = {"edgecolors": "white", "linewidth": 0.1} if cells_across(x, z, closer) < CELLS_WITH_EDGES else {"rasterized": True}
            drawn = axes.pcolormesh(x, z, speed, cmap="viridis", vmin=0, vmax=top, **edges)
        for x, z, phi in parts["fv"].surfaces() if "fv" in parts else ():
            if phi.count() and phi.min() < 0 < phi.max():
                axes.contour(x, z, phi, levels=[0.0], colors="#c1272d", linewidths=1.2)
        if closer:
            axes.set(xlim=closer[0], ylim=closer[1])
        if "sph" in parts:
            shown = middle(parts["sph"])
            size = dot_size(shown.x, axes, closer)
            drawn = axes.scatter(shown.x[:, 0], shown.x[:, 2], c=shown.speed, s=size, cmap="viridis", vmin=0,
                                 vmax=top, linewidths=0.15 if size > 2 else 0, edgecolors="white")
        for region in self.regions:
            (x0, _, z0), (x1, _, z1) = region["lower"], region["upper"]
            axes.plot([x0, x1, x1, x0, x0], [z0, z0, z1, z1, z0], color="k", lw=0.8, ls="--")
        axes.set_aspect("equal")
        axes.set(xlabel="x [m]", ylabel="z [m]", title=f"t = {parts[next(iter(parts))].time:.3g} s: "
                 + ", ".join(["particles (dots)"] * ("sph" in parts) + ["cells"] * ("fv" in parts)
                             + ["nominal faces of the particles' region (dashed)"] * bool(self.regions)))
        axes.title.set_fontsize(9)
        figure.colorbar(drawn, cax=axes.inset_axes([1.02, 0, 0.02, 1]), label="|u| [m/s]")

    def profile(self, axes, time, quantity, x_line, label):
        """Values on the vertical line x = x_line, of particles within half a spacing and of the nearest column."""
        parts = self.moments.at(time)
        for program, part in parts.items():
            shown = middle(part)
            near = column(shown, x_line) if program == "fv" else on_line(shown, x_line)
            if program == "fv" and shown.status is not None:
                near &= shown.status != BLANKED
            if shown.phi is not None:
                near &= shown.phi < 0
            if not near.any():
                continue
            order = np.argsort(shown.x[near, 2])
            axes.plot(quantity(shown)[near][order], shown.x[near, 2][order], marker="s" if program == "fv" else "o",
                      ls="-" if program == "fv" else "", ms=3.5 if program == "fv" else 2.5, lw=0.8,
                      mfc="none" if program == "fv" else None, color=COLOURS[program], label=NAMES[program])
        for region in self.regions:
            axes.axhline(region["lower"][2], color="k", lw=0.8, ls="--")
        axes.locator_params(axis="x", nbins=5)
        axes.set(xlabel=label, ylabel="z [m]")


def spacing(x):
    """Typical distance of neighbours, from area (or volume) per point."""
    spans = [np.ptp(x[:, i]) for i in range(3)]
    active = [s for s in spans if s > 1e-9 * max(spans)]
    return (np.prod(active) / len(x)) ** (1 / len(active))


def on_line(part, x_line):
    """Particles within a spacing of the upright line."""
    away = np.abs(part.x[:, 0] - x_line)
    return away <= max(spacing(part.x), away.min())


def column(part, x_line):
    """Of the cells at each height the one nearest to the upright line, where that is near."""
    away = np.abs(part.x[:, 0] - x_line)
    height = np.round(part.x[:, 2] / (1e-6 * np.ptp(part.x[:, 2])))
    order = np.lexsort((away, height))
    first = np.ones(len(order), bool)
    first[1:] = np.diff(height[order]) > 0
    near = np.zeros(len(order), bool)
    near[order[first]] = True
    return near & (away <= max(0.5 * spacing(part.x), away.min() * (1 + 1e-6)))


def middle(part):
    """In 3-D the points of the layer (cells) or slice (particles) nearest to the middle of y; in 2-D all of them."""
    y = part.x[:, 1]
    if np.ptp(y) < 1e-9 * np.ptp(part.x[:, 0]):
        return part
    away = np.abs(y - 0.5 * (y.min() + y.max()))
    return part.pick(away <= max(0.6 * spacing(part.x), away.min() * (1 + 1e-6)))


def cells_across(x, z, closer):
    """How many cells of a sheet, at their shorter sides, would stand side by side across the picture."""
    sides = [np.hypot(np.diff(x, axis=axis), np.diff(z, axis=axis)) for axis in (0, 1)]
    across = np.ptp(x) if closer is None else closer[0][1] - closer[0][0]
    return across / max(min(np.median(side) for side in sides), 1e-300)


def dot_size(x, axes, closer=None):
    """Area in points^2 of dots with room between them at the width of the axes."""
    width = axes.get_window_extent().width * 72 / axes.figure.dpi
    across = max(np.ptp(x[:, 0]), np.ptp(x[:, 2])) if closer is None else closer[0][1] - closer[0][0]
    return (0.6 * width * spacing(x) / across) ** 2


def overview(picture, time, path):
    plt = pyplot()
    rows = 3 if picture.moments else 1
    figure = plt.figure(figsize=(10, 12 if picture.moments else 3.5))
    grid = figure.add_gridspec(rows, 6, height_ratios=[1, 1.55, 1.2][:rows], hspace=0.24, wspace=0.9)
    if picture.wave:
        picture.elevation(figure.add_subplot(grid[0, :3]))
        picture.energy(figure.add_subplot(grid[0, 3:]))
    elif elevations := picture.elevations():
        picture.history(figure.add_subplot(grid[0, :3]))
        picture.levels(figure.add_subplot(grid[0, 3:]), elevations)
    else:
        picture.history(figure.add_subplot(grid[0, :]))
    if picture.moments:
        picture.field(figure.add_subplot(grid[1, :]), time, figure)
        first = figure.add_subplot(grid[2, :2])
        profiles(picture, time, [first] + [figure.add_subplot(grid[2, k:k + 2], sharey=first) for k in (2, 4)])
    figure.suptitle(picture.summary.get("title", ""), fontsize=10, y=0.92 if picture.moments else 1.0)
    figure.savefig(path)
    plt.close(figure)


def profiles(picture, time, axes):
    """p and u on a vertical line through the interface: any kink shows here."""
    part = picture.moments.at(time)
    x = np.concatenate([p.x[:, 0] for p in part.values()])
    left, right = x.min(), x.max()
    first, second = left, left + 0.25 * (right - left)  # of a wave in a tank an antinode and a node
    if picture.closer:  # through the particles, and where they end
        low, high = picture.regions[0]["lower"][0], picture.regions[0]["upper"][0]
        first, second = 0.5 * (low + high), low
    picture.profile(axes[0], time, picture.excess_pressure, first, f"p - rho g . x [Pa] at x = {first:.3g} m")
    picture.profile(axes[1], time, lambda p: p.u[:, 2], first, f"w [m/s] at x = {first:.3g} m")
    picture.profile(axes[2], time, lambda p: p.u[:, 0], second, f"u [m/s] at x = {second:.3g} m")
    axes[0].set_ylim(picture.closer[1] if picture.closer else None)
    if axes[0].get_legend_handles_labels()[0]:
        axes[0].legend(loc="best")


def command(args):
    picture = Picture(args.dir)
    folder = pathlib.Path(args.out) if args.out else picture.out / "plots"
    folder.mkdir(parents=True, exist_ok=True)
    time = args.time
    if picture.moments and time is None:
        time = picture.moment()
    overview(picture, time, folder / "overview.png")
    if picture.wave:
        print(compare.table(picture.wave.measures()))
    print(folder / "overview.png")
    return 0
