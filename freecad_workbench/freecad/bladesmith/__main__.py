"""``python3 -m freecad.bladesmith``: the same commands as ``bladesmith``."""

import sys

from freecad.bladesmith.cli import main

sys.exit(main())
