"""The command line: ``python -m centrode`` is the program ``centrode``, word for word."""

from __future__ import annotations

import os
import signal
import sys
import threading

from ._centrode import _run


def main() -> int:
    """Run the program with the words of the command line and return its exit status.

    It is for a process of its own: standard output and Ctrl-C are the program's from here on.
    """
    # A stream that was closed at the start: else the next file opened would replace it.
    for stream in (sys.__stdin__, sys.__stdout__, sys.__stderr__):
        if stream is None:
            os.open(os.devnull, os.O_RDWR)
    # Python only notes Ctrl-C and waits for its turn, which would come when all is done.
    if (
        threading.current_thread() is threading.main_thread()
        and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    ):
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _run(sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
