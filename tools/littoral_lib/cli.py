"""The command line of tools/littoral."""

import argparse
import sys

from .errors import Ended, UserError, end_on_signals, nearest

COMMANDS = ("run", "check", "plot", "surface", "verify", "bench")


class Parser(argparse.ArgumentParser):
    """argparse, with the nearest known name for a misspelt command or option."""

    def error(self, message):
        if "unrecognized" not in message:
            raise UserError(f"{self.prog}: {message}\n{self.format_usage().strip()}")
        known = {o for a in self._all_actions() for o in a.option_strings}
        words = [w.partition("=")[0] for w in message.split(": ")[-1].split() if w.startswith("-")]
        if not words:
            raise UserError(message)
        guess = nearest(words[0], known)
        raise UserError(f"unknown option '{words[0]}'." + (f" Did you mean '{guess}'?" if guess else "") +
                        " See littoral COMMAND --help.")

    def _all_actions(self):
        for action in self._actions:
            yield action
            if isinstance(action, argparse._SubParsersAction):
                for parser in action.choices.values():
                    yield from parser._actions



def positive(text):
    """A count from the command line: 1, 2, 3, ..."""
    if not text.isdigit() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is no count; expected 1, 2, 3, ...")
    return int(text)


def add_scene_options(parser):
    parser.add_argument("scene", help="scene folder (scene.yaml with sph.yaml and/or fv.yaml), or a name in configs/")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="override a key: scene.KEY for both programs, sph.KEY or fv.KEY for one; repeatable")
    parser.add_argument("--solver", choices=("sph", "fv"), help="this program alone, without its partner")


def build_parser():
    parser = Parser(prog="littoral", description="Run, check, plot and verify coupled SPH-FV scenes.")
    sub = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=Parser)

    run = sub.add_parser("run", help="run a scene", description="Run a scene; results go to OUT/sph, OUT/fv, "
                         "OUT/summary.json and OUT/scalars.csv. Exit status 0 only if the whole job succeeded.")
    add_scene_options(run)
    run.add_argument("--out", help="folder of the results (default: out/SCENE); what an earlier "
                     "run left there is removed, unless this one goes on from it")
    run.add_argument("--sph-ranks", type=positive, default=1, metavar="N", help="MPI ranks of sph_solver (default 1)")
    run.add_argument("--fv-ranks", type=positive, default=1, metavar="N", help="MPI ranks of fv_solver (default 1)")
    run.add_argument("--threads", type=positive, metavar="N", help="OpenMP threads a rank (default: all cores, in turns)")
    run.add_argument("--restart", metavar="WINDOW", help="go on from this window's checkpoints, or from 'latest'")
    run.add_argument("--restart-from", metavar="DIR", help="folder of the checkpoints (default: the --out folder)")
    run.add_argument("--timeout", type=float, metavar="S", help="end the job after S seconds (status 124)")
    run.add_argument("--quiet", action="store_true", help="no progress on the screen")

    check = sub.add_parser("check", help="check a scene without running it", description="Let both programs read "
                           "and judge their files, compare what the handshake will compare, and predict particles, "
                           "cells, memory and steps. Lists all problems; exit status 0 only if there is none.")
    add_scene_options(check)
    check.add_argument("--trial", action="store_true",
                       help="predict seconds too: runs the first windows, of which nothing is kept")
    check.add_argument("--threads", type=positive, metavar="N", help="OpenMP threads a rank of the trial (default as in run)")

    plot = sub.add_parser("plot", help="draw the standard picture of a run",
                          description="Draw energy and elevation (against the exact solution where the scene names "
                          "one), the field at one moment, and profiles across the interface, in one picture.")
    plot.add_argument("dir", metavar="DIR", help="folder a run wrote")
    plot.add_argument("--time", type=float, help="moment of the field picture [s] (default: the most lively one)")
    plot.add_argument("--out", help="folder of the picture (default: DIR/plots)")

    surface = sub.add_parser("surface", help="the free surface as triangles or lines",
                             description="Find the free surface of a run's particles, where sum V W = 1/2, and write "
                             "it as triangles (VTP, PLY, STL), in 2-D as lines (VTP), with a picture.")
    surface.add_argument("dir", metavar="DIR", help="folder a run wrote")
    surface.add_argument("--time", type=float, help="moment [s], the nearest field written (default: the last)")
    surface.add_argument("--all", action="store_true", help="every field written, one file each")
    surface.add_argument("--step", type=float, default=0.5, metavar="DX", help="grid step in spacings (default 0.5)")
    surface.add_argument("--no-picture", action="store_true", help="files only")
    surface.add_argument("--out", help="folder of the files (default: DIR/surface)")

    verify = sub.add_parser("verify", help="run validation cases", description="Run cases of tests/validation and "
                            "print metric, gate and verdict of each. Exit status 0 only if no gate was missed.")
    verify.add_argument("names", nargs="*", metavar="NAME", help="cases by name or id (default: all of the selection)")
    verify.add_argument("--list", action="store_true", help="list the cases without running them")
    verify.add_argument("--tier", choices=("U", "F", "N", "L"), action="append",
                        help="only this cost: U seconds, F under 2 min, N under 30 min, L hours; repeatable")
    verify.add_argument("--group", choices=("sph", "fv", "fv_surface", "coupled"), action="append",
                        help="only this group; repeatable")
    verify.add_argument("--out", help="folder of the runs and verdicts (default: out/verify)")
    verify.add_argument("--table", action="store_true",
                        help="print the kept verdicts as a Markdown table, without running anything")
    verify.add_argument("--verbose", "-v", action="store_true", help="every metric, and the programs' progress")

    bench = sub.add_parser("bench", help="run benchmarks", description="Run coupler_bench, sph_bench, fv_bench.")
    bench.add_argument("names", nargs="*", metavar="NAME", help="coupler, sph, fv (default: all that are built), sph_scaling, fv_scaling")
    bench.add_argument("--threads", type=positive, metavar="N", help="OpenMP threads a rank (default 1)")
    bench.add_argument("--out", help="folder the programs run in")
    for parser_of in (run, check, verify, bench):
        parser_of.add_argument("--bin", metavar="DIR",
                               help="folder of the programs (default: LITTORAL_BIN, then build/release/bin)")
    return parser


def main(argv):
    end_on_signals()
    try:
        if argv and not argv[0].startswith("-") and argv[0] not in COMMANDS:
            from .errors import unknown
            raise unknown("command", argv[0], COMMANDS)
        args = build_parser().parse_args(argv)
        if not args.command:
            build_parser().print_help()
            return 2
        if args.command == "run":
            from . import run as module
        elif args.command == "check":
            from . import checking as module
        elif args.command == "plot":
            from . import plotting as module
        elif args.command == "surface":
            from . import surface as module
        elif args.command == "verify":
            from . import verify as module
        else:
            from . import bench as module
        return module.command(args)
    except UserError as problem:
        print(f"littoral: {problem}", file=sys.stderr)
        return 2
    except OSError as problem:
        print(f"littoral: {problem}", file=sys.stderr)
        return 2
    except Ended as signal:
        print(f"littoral: interrupted ({signal.name})", file=sys.stderr)
        return signal.status
