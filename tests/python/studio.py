"""The design page's server, started on a copy of a design, and plain HTTP spoken to it."""

import json
import os
import subprocess
import time
from contextlib import contextmanager
from http.client import HTTPConnection
from pathlib import Path
from urllib.parse import urlsplit

from conftest import BINARY


class Studio:
    """A running `centrode studio`: its address, and requests as its own page sends them."""

    def __init__(self, process, url, design):
        self.process, self.url, self.design = process, url, design
        parts = urlsplit(url)
        self.port, self.base = parts.port, parts.path

    def connect(self):
        return HTTPConnection("127.0.0.1", self.port, timeout=20)

    def ask(self, method, path, body=None, headers=None, absolute=False):
        """Status and body; a header given as None is left out."""
        own = {"Host": f"127.0.0.1:{self.port}"}
        if method != "GET":
            own["Origin"] = f"http://127.0.0.1:{self.port}"
        if body is not None:
            own["Content-Type"] = "application/json"
        merged = {name: value for name, value in {**own, **(headers or {})}.items() if value is not None}
        data = json.dumps(body).encode() if isinstance(body, dict) else body
        connection = self.connect()
        try:
            connection.putrequest(method, path if absolute else self.base + path, skip_host=True)
            for name, value in merged.items():
                connection.putheader(name, value)
            if data is not None and "Content-Length" not in merged:
                connection.putheader("Content-Length", str(len(data)))
            connection.endheaders(data)
            answer = connection.getresponse()
            return answer.status, answer.read()
        finally:
            connection.close()

    def json(self, method, path, body=None):
        status, text = self.ask(method, path, body)
        return status, json.loads(text)

    def answers(self):
        """Whether the page is served."""
        status, text = self.ask("GET", "")
        return status == 200 and b"<!doctype html>" in text


def spent(process):
    """Processor time of a process so far, s."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rpartition(")")[2].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def computes(process):
    """Waits until a process has computed for a twentieth of a second more."""
    before, end = spent(process), time.monotonic() + 60
    while spent(process) < before + 0.05:
        assert time.monotonic() < end, "it computes nothing"
        time.sleep(0.01)


def rests(process):
    """Waits until a process computes nothing; what nobody stopped would go on for minutes."""
    end = time.monotonic() + 10
    before = None
    while spent(process) != before:
        assert time.monotonic() < end, "it goes on computing"
        before = spent(process)
        time.sleep(0.2)


@contextmanager
def studio(design, *program, **options):
    """Serves a design file, or with none the start page; the program is ended with Ctrl-C and must end at once."""
    command = [*(program or [BINARY]), "studio", *([design] if design else [])]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
    try:
        url = process.stdout.readline().strip()
        assert url.startswith("http://127.0.0.1:"), process.stderr.read()
        yield Studio(process, url, design)
    finally:
        if process.poll() is None:
            process.send_signal(2)
            try:
                code = process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                raise
            assert code == 0
        process.stdout.close()
        process.stderr.close()
