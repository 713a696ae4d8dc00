"""Times and memory of ``bladesmith morph`` on the compressor blade, without pictures.

Runs the command several times in processes of their own and prints the median of each stage, the
whole command's wall time, and the peak memory.
"""

import json
import os
import resource
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BLADE = ROOT / "examples" / "compressor_blade"
RUNS = 5
CORE = ("associate", "fit", "rebuild")


def run(folder: Path) -> dict:
    """Seconds by stage of one run, and ``command``, its wall time."""
    report = folder / "report.json"
    started = time.perf_counter()
    subprocess.run(
        [
            *(ROOT / "freecad_workbench" / "bladesmith", "morph"),
            *(BLADE / "hot.step.gz", BLADE / "blade.frd.gz", "--mesh", BLADE / "blade.inp.gz"),
            *("--factor", "-1", "--quiet", "-o", folder / "cold.step", "--json", report),
        ],
        check=True,
    )
    seconds = json.loads(report.read_text())["seconds"]
    return {**seconds, "command": time.perf_counter() - started}


def main() -> None:
    """Measures and prints."""
    with tempfile.TemporaryDirectory() as folder:
        runs = [run(Path(folder)) for _ in range(RUNS)]
    print(f"compressor blade, median of {RUNS} runs on {os.cpu_count()} processors")
    for stage in runs[0]:
        print(f"  {stage:<12}{statistics.median(r[stage] for r in runs):8.3f} s")
    core = statistics.median(sum(r[stage] for stage in CORE) for r in runs)
    print(f"  {'core':<12}{core:8.3f} s   ({' + '.join(CORE)})")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"  {'peak memory':<12}{peak:8.0f} MB")


if __name__ == "__main__":
    main()
