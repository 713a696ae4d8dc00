"""``bladesmith info``: what is in a STEP or a field file, in engineering terms."""

import argparse
import json
from pathlib import Path

from ..native import Field
from ..occ import step
from .outputs import Outputs, check_target


def run(options: argparse.Namespace) -> int:
    """Runs the command; returns its exit code."""
    if options.json:
        check_target(options.json, "the figures")
    if step.is_step(step.first_bytes(options.file)):
        document = _part_document(options.file)
        lines = _part_lines(document)
    else:
        document = Field.read(options.file).info()
        lines = _field_lines(options.file, document)
    if options.json:
        with Outputs() as outputs:
            text = json.dumps(document, indent=1, ensure_ascii=False) + "\n"
            Path(outputs.file(options.json)).write_text(text, "utf-8")
            outputs.commit()
    if not options.quiet:
        print("\n".join(lines))
    return 0
