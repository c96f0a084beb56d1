"""lfdsim study, and python -m lfdsim.study: studies from the command line.

Exit codes: 0 done, 1 failed while running, 2 bad usage or input, 130 interrupted.
"""

from __future__ import annotations

import sys


def main(words: list[str]) -> int:
    try:
        from . import commands

        return commands.main(words)
    except ModuleNotFoundError as error:
        print(
            f"lfdsim: error: studies need the Python package {error.name}, which {sys.executable} has not; "
            f"{sys.executable} -m pip install 'lfdsim[study]'",
            file=sys.stderr,
        )
        return 1
    except KeyboardInterrupt:  # before there was anything to keep
        return 130


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
