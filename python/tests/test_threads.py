"""Long calls let other threads run and give in to Ctrl-C."""

import subprocess
import sys
import threading

import centrode as ct
import pytest
from centrode._centrode import _panic


def test_other_threads_run_while_a_call_takes_its_time(pair, turns_meanwhile):
    assert turns_meanwhile(lambda: pair.contact(500)) > 2


def test_many_threads_share_a_pair(pair):
    answers = []
    threads = [threading.Thread(target=lambda: answers.append(pair.check().values)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(answers) == 4
    assert all(answer == answers[0] for answer in answers)


@pytest.mark.parametrize("by", ["wait", "wait_here", "at_once"])
def test_a_panic_is_an_ordinary_exception_of_the_package(by):
    with pytest.raises(ct.InternalError, match="fault of centrode, not of the input") as caught:
        _panic(by)
    assert isinstance(caught.value, Exception)
    assert isinstance(caught.value, ct.Error)
    message = str(caught.value).lower()
    assert not any(word in message for word in ("panic", "rust", "thread", "unwrap", "a test"))
    # Nothing is left half done.
    assert ct.pitch.circle(module=1, tooth_count=20).module == 1


INTERRUPTED = """
import os, signal, threading, time
import numpy as np
import centrode as ct
{before}
# A job started in the background ignores the signal unless asked not to.
signal.signal(signal.SIGINT, signal.default_int_handler)
threading.Timer(0.4, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    {call}
    print("ended by itself")
except KeyboardInterrupt:
    # What nobody stopped would go on for minutes.
    for _ in range(50):
        spent = time.process_time()
        time.sleep(0.2)
        if time.process_time() - spent < 0.02:
            print("at rest")
            break
"""

FITTED = 'pair = ct.GearPair(ct.pitch.circle(module=1, tooth_count=150), addendum="fitted")'
PAIR = "pair = ct.GearPair(ct.pitch.ellipse(eccentricity=0.2, module=2, tooth_count=40))"
ARMS = 'arms = ct.ThreeArm.from_toml(ct.template("three-arm"))'
LONG = {
    "pair": ("", "while True: ct.GearPair(ct.pitch.circle(module=1, tooth_count=10_000))"),
    "contact": (PAIR, "pair.contact(10_000)"),
    "check": (FITTED, "while True: pair.check()"),
    "export": (PAIR, "while True: pair.export('{folder}', formats=['dxf', 'step', 'csv'], tolerance=1e-6)"),
    "mesh": (PAIR, "while True: pair.driver.mesh(1e-4)"),
    "arms": (ARMS, "while True: arms.check()"),
    "sweep": (ARMS, "arms.sweep({{'r1': np.linspace(15, 27, 3_000_000)}})"),
    "sweep of any number": (
        PAIR,
        "ct.sweep(pair, over={{'pitch.eccentricity': np.linspace(0.1, 0.3, 100_000)}}, depth='made', chunk=100_000)",
    ),
    "optimise": (ARMS, "arms.optimise('de', evaluations=10**9)"),
    "guided": (ARMS, "while True: arms.optimise('guided', evaluations=10**9)"),
    "response": (ARMS, "arms.response('r1', np.linspace(15, 27, 100_000).tolist())"),
}


@pytest.mark.parametrize("call", LONG)
def test_ctrl_c_ends_a_long_call_and_nothing_goes_on_computing(call, tmp_path):
    before, long = (text.format(folder=tmp_path) for text in LONG[call])
    script = INTERRUPTED.format(before=before, call=long)
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60, check=True)
    assert done.stdout == "at rest\n"
    # No file is left half written either.
    assert not list(tmp_path.rglob(".centrode-*.part"))
