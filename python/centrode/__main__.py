"""The command line: ``python -m centrode`` is the same as the program ``centrode``."""

from __future__ import annotations

import os
import signal
import sys
import threading

from ._centrode import _run


def main() -> int:
    """Run the program with the arguments of the command line and return its exit status.

    It must have its own process, because it takes over standard output and Ctrl-C.
    """
    # Streams closed at the start are opened on the null device; otherwise the next opened file would take their place.
    for stream in (sys.__stdin__, sys.__stdout__, sys.__stderr__):
        if stream is None:
            os.open(os.devnull, os.O_RDWR)
    # Python's handler would run only after the program has ended, so the default action of Ctrl-C is restored.
    if (
        threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    ):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
