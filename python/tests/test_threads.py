"""Long calls let other threads run and give in to Ctrl-C."""

import subprocess
import sys
import threading
import time

MAKE = "import centrode as ct; pair = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=40))"


def test_other_threads_run_while_a_call_takes_its_time(pair):
    done = threading.Event()

    def work():
        pair.contact(500)
        done.set()

    worker = threading.Thread(target=work)
    worker.start()
    ticks = 0
    while not done.is_set():
        ticks += 1
        time.sleep(1e-3)
    worker.join()
    # With the lock held throughout, this thread would have had its turn once at most.
    assert ticks > 10


def test_many_threads_share_a_pair(pair):
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(pair.check().values)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4
    assert all(answer == answers[0] for answer in answers)


def test_ctrl_c_ends_a_long_call():
    script = f"""
import os, signal, threading, time
{MAKE}
# A job started in the background ignores the signal unless asked not to.
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
start = time.monotonic()
try:
    pair.contact(10_000)
except KeyboardInterrupt:
    print(time.monotonic() - start)
"""
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)
    assert 0.2 < float(done.stdout) < 3
