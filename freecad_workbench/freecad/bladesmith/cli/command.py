"""Arguments, dispatch and exit codes of ``bladesmith``.

Exit codes: 0 success; 2 unusable input; 3 the result misses the tolerance asked for (it is still
written); 1 anything else, cancelling included.
"""

import argparse
import os
import sys
import traceback
from typing import Optional

from .. import __version__, log
from ..model.options import FIELD_UNITS_MM
from ..native.errors import BladesmithError, Cancelled, InternalError
from . import interruption

EXIT_FAILURE = 1
_EPILOG = """\
exit codes: 0 success, 2 unusable input, 3 the result misses --tolerance (it is still written),
1 anything else. Lengths are millimetres. BLADESMITH_DEBUG=1 shows where an error came from; what
happened is kept in a log, 'bladesmith log' tells where."""


def main(arguments: Optional[list[str]] = None) -> int:
    """Runs one command and returns its exit code."""
    interruption.install()
    options = _parser().parse_args(arguments)
    log.start(f"command line, {options.command}")
    try:
        code = options.run(options)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        return _failed(Cancelled("cancelled; nothing was written"))
    except BladesmithError as error:
        return _failed(error)
    except BrokenPipeError:
        # The reader of our output went away; keep the interpreter from flushing into it again.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return EXIT_FAILURE
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        return _failed(BladesmithError(f"{place}{error.strerror or error}"))
    except Exception as error:
        return _failed(InternalError(f"{type(error).__name__}: {error}"))


def _failed(error: BladesmithError) -> int:
    if os.environ.get("BLADESMITH_DEBUG"):
        traceback.print_exc()
    message = " ".join(str(error).split())
    log.failure(error)
    if error.defect:
        message += f" (a defect of Bladesmith: please report it with the log, {log.path()})"
    print(f"bladesmith: {message}", file=sys.stderr)
    return error.exit_code


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str):
        """Ends with exit code 2."""
        self.exit(2, f"bladesmith: {message}; see '{self.prog} --help'\n")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="bladesmith",
        description="Hot-to-cold morphing of CAD solids by a finite-element displacement field.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="version", version=f"bladesmith {__version__}")
    commands = parser.add_subparsers(
        title="commands", metavar="COMMAND", dest="command", required=True
    )
    _add_morph(commands)
    _add_info(commands)
    _add_log(commands)
    return parser


def _add_morph(commands) -> None:
    parser = commands.add_parser(
        "morph",
        help="move a STEP solid by a displacement field",
        description="Moves the solid of a STEP file: x_out = x_in + F * u(x_in). The displacements "
        "u are given at the nodes of a mesh of that same solid, so F = 1, the default, adds them "
        "(cold to hot), and F = -1 takes them away: it brings a hot part to its first-order cold "
        "shape. Faces, their order, names and colours stay.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("part", metavar="HOT.step", help="the solid the field belongs to")
    parser.add_argument(
        "field", metavar="FIELD", help="CalculiX .frd, or CSV id,x,y,z,dx,dy,dz; may be gzipped"
    )
    _add_field_options(parser)
    _add_part_options(parser)
    _add_output_options(parser)
    parser.set_defaults(run=_run_morph)


def _add_field_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("field")
    group.add_argument(
        "--mesh", metavar="DECK.inp", help="deck with the nodes in full precision (.frd rounds)"
    )
    group.add_argument("--step", type=_count, metavar="N", help="result step (default: the last)")
    group.add_argument(
        "--factor",
        type=_number,
        metavar="F",
        help="on the displacements: 1 adds them (cold to hot), -1 takes them away (hot to cold); "
        "default 1",
    )
    group.add_argument(
        "--field-unit", choices=sorted(FIELD_UNITS_MM), help="length unit of the field file"
    )
    group.add_argument(
        "--displacement-scale",
        type=_positive,
        default=1.0,
        metavar="K",
        help="further factor on the displacements alone, as for a file with mixed units",
    )
    group.add_argument(
        "--match-tolerance", type=_positive, metavar="MM", help="how far a node may lie off a face"
    )
    group.add_argument(
        "--extrapolate", action="store_true", help="also move areas far from any node"
    )


def _add_part_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("part")
    group.add_argument(
        "--faces",
        action="append",
        metavar="NAMES",
        help="only these faces move: names, Face7 or 7, separated by commas",
    )
    group.add_argument("--fixed", action="append", metavar="NAMES", help="these faces stay")
    group.add_argument(
        "--solid", type=_count, metavar="N", help="solid of the file (default: the covered one)"
    )


def _add_output_options(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("result")
    group.add_argument("-o", "--output", required=True, metavar="COLD.step", help="file to write")
    group.add_argument(
        "--tolerance",
        type=_positive,
        default=1e-3,
        metavar="MM",
        help="largest deviation at a node that counts as success (default 0.001)",
    )
    group.add_argument(
        "--holdout", action="store_true", help="also fit without a tenth of the nodes, as a test"
    )
    group.add_argument("--threads", type=_count, metavar="N", help="default: all processors")
    group.add_argument("--json", metavar="FILE", help="write the report; - for standard output")
    group.add_argument("--report", metavar="DIR", help="write a page with pictures into a folder")
    group.add_argument("--quiet", action="store_true", help="print errors only")


def _add_info(commands) -> None:
    parser = commands.add_parser(
        "info",
        help="tell what is in a STEP or field file",
        description="Tells what is in a STEP or a field file, in engineering terms.",
    )
    parser.add_argument("file", metavar="FILE", help="STEP, .frd or CSV; may be gzipped")
    parser.add_argument("--json", metavar="FILE", help="write it as JSON; - for standard output")
    parser.add_argument("--quiet", action="store_true", help="print errors only")
    parser.set_defaults(run=_run_info)


def _add_log(commands) -> None:
    parser = commands.add_parser(
        "log",
        help="tell where the log is, to send with a question",
        description="Prints the name of the log file: versions, names and sizes of inputs, stages "
        "with their times, warnings and errors; no folders and no geometry.",
    )
    parser.set_defaults(run=_run_log)


def _run_log(_options: argparse.Namespace) -> int:
    print(log.path())
    return 0


def _run_morph(options: argparse.Namespace) -> int:
    from .morph import run

    return run(options)


def _run_info(options: argparse.Namespace) -> int:
    from .info import run

    return run(options)


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not -1e300 < value < 1e300:
        raise argparse.ArgumentTypeError(f"expected a finite number, not '{text}'")
    return value


def _positive(text: str) -> float:
    value = _number(text)
    if value <= 0:
        raise argparse.ArgumentTypeError(f"expected a number above zero, not '{text}'")
    return value


def _count(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 1 <= int(text) < 2**32):
        raise argparse.ArgumentTypeError(f"expected a whole number from 1, not '{text}'")
    return int(text)
