"""--set KEY=VALUE: to which program each one goes."""

from .errors import UserError, unknown

PROGRAMS = ("sph", "fv")


def route(settings, programs):
    """Deals the settings to the programs that run.

    `scene.KEY=VALUE` goes to all of them unchanged (each passes it on to the scene it reads),
    `sph.KEY=VALUE` and `fv.KEY=VALUE` to one, without the prefix. Returns {program: [setting, ...]}.
    """
    dealt = {program: [] for program in programs}
    for setting in settings:
        key, equals, _ = setting.partition("=")
        if not equals or not key.strip():
            raise UserError(f"--set {setting}: expected KEY=VALUE, as in scene.time.end=2.5")
        prefix, dot, rest = key.partition(".")
        if not dot or not rest:
            raise UserError(f"--set {setting}: the key must begin with scene., sph. or fv.")
        if prefix == "scene":
            for program in programs:
                dealt[program].append(setting)
        elif prefix in programs:
            dealt[prefix].append(setting[len(prefix) + 1:])
        elif prefix in PROGRAMS:
            continue  # the other program does not run: its settings do not matter
        else:
            raise unknown(f"prefix of --set {setting}:", prefix, ("scene",) + PROGRAMS)
    return dealt


def scene_overrides(settings):
    """The scene's part of the settings as [(dotted key without `scene.`, text), ...]."""
    pairs = (setting.partition("=") for setting in settings)
    return [(key[len("scene."):], value) for key, _, value in pairs if key.startswith("scene.")]
