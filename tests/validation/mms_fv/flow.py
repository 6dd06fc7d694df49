"""A smooth flow that solves nothing, and the sources that make it a solution, as formulas for the programs.

Fields are sums of products of sines and cosines. A term is (factor, {axis: (function, wavenumber, phase)}), and its
derivative is again such a term, so the sources are exact.
"""

AXES = {2: "xz", 3: "xyz"}
VELOCITY = {"x": "u", "y": "v", "z": "w"}


class Field:
    """Formula text of a field and of its derivatives."""

    def __init__(self, terms):
        self.terms = terms  # {tuple of (axis, function, wavenumber, phase)}: factor

    def d(self, axis):
        result = {}
        for factors, amount in self.terms.items():
            for i, (a, function, k, phase) in enumerate(factors):
                if a != axis:
                    continue
                other, sign = ("cos", 1.0) if function == "sin" else ("sin", -1.0)
                changed = factors[:i] + ((a, other, k, phase),) + factors[i + 1:]
                result[changed] = result.get(changed, 0.0) + sign * k * amount
        return Field(result)

    def __str__(self):
        texts = []
        for factors, amount in self.terms.items():
            texts.append("*".join([f"({amount:.17g})"] + [f"{f}({k:.17g}*{a}+({phase:.17g}))"
                                                          for a, f, k, phase in factors]))
        return "(" + "+".join(texts) + ")" if texts else "0"


def flow(dimension, unsteady):
    """p and the velocity components by axis."""
    axes = AXES[dimension]
    swing = (("t", "cos", 3.0, 0.4),) if unsteady else ()

    def wave(amount, sine, phase):
        factors = tuple((a, "sin" if a == sine else "cos", 2.0, phase + 0.2 * i) for i, a in enumerate(axes))
        return {factors + swing: amount}

    u = {a: Field({(): (0.8, 0.5, 0.3)[i], **wave(0.4, a, 0.3 + 0.9 * i)}) for i, a in enumerate(axes)}
    return Field(wave(0.5, None, -0.3)), u


def settings(dimension, unsteady, inverse_c2, nu, density=1.0):
    """{key: formula} of the initial state, the faces and the sources."""
    p, u = flow(dimension, unsteady)
    axes = AXES[dimension]
    rho = f"({density}+{inverse_c2:.17g}*{p})"
    mass = [f"{inverse_c2:.17g}*{p.d('t')}"]
    for a in axes:
        mass.append(f"{inverse_c2:.17g}*{p.d(a)}*{u[a]}+{rho}*{u[a].d(a)}")
    mass = "+".join(mass)
    result = {"source.mass": mass}
    for a in axes:
        # u (mass rate) + rho (du/dt + u . grad u) + dp/da - mu (lap u + d(div u)/da)
        force = [f"{u[a]}*({mass})", f"{rho}*({u[a].d('t')}" + "".join(f"+{u[b]}*{u[a].d(b)}" for b in axes) + ")",
                 str(p.d(a))]
        force += [f"(-{density * nu:.17g})*({u[a].d(b).d(b)}+{u[b].d(b).d(a)})" for b in axes]
        result[f"source.{VELOCITY[a]}"] = "+".join(force)
    return p, u, result
