"""Firefox without a window, told what to do over its own wire (Marionette): nothing but the browser is needed."""

import json
import shutil
import socket
import subprocess
import time
from contextlib import contextmanager

FIREFOX = next(filter(None, map(shutil.which, ["firefox-esr", "firefox"])), None)
PREFERENCES = {
    "app.normandy.enabled": False,
    "app.update.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.page": 0,
    "browser.tabs.remote.warmup.enabled": False,
    # Where a page is left for one of another kind its process ends. A script at work then, as one that hears the page
    # hidden, would be told of to the console.
    "dom.abort_script_on_child_shutdown": False,
    "datareporting.policy.dataSubmissionEnabled": False,
    "extensions.getAddons.cache.enabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "toolkit.telemetry.enabled": False,
}


class RefusedError(Exception):
    """Errors that Firefox reports."""


class Firefox:
    """A tab of a running Firefox."""

    def __init__(self, port):
        self.wire = self.dial(port)
        self.rest, self.number = b"", 0
        self.read()
        self.ask("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {"unhandledPromptBehavior": "ignore"}}})
        self.ask("WebDriver:SetTimeouts", {"script": 30_000, "pageLoad": 30_000})

    @staticmethod
    def dial(port):
        until = time.monotonic() + 60
        while True:
            try:
                return socket.create_connection(("127.0.0.1", port), timeout=60)
            except OSError:
                if time.monotonic() > until:
                    raise
                time.sleep(0.1)

    def read(self):
        """A message: its length in bytes, a colon, JSON."""
        while b":" not in self.rest:
            self.rest += self.wire.recv(1 << 16)
        length, _, self.rest = self.rest.partition(b":")
        while len(self.rest) < int(length):
            self.rest += self.wire.recv(1 << 16)
        message, self.rest = self.rest[: int(length)], self.rest[int(length) :]
        return json.loads(message)

    def ask(self, command, parameters=None):
        """The answer to a command."""
        self.number += 1
        text = json.dumps([0, self.number, command, parameters or {}]).encode()
        self.wire.sendall(b"%d:%b" % (len(text), text))
        _, number, error, answer = self.read()
        assert number == self.number
        if error:
            raise RefusedError(f"{command}: {error['message']}")
        return answer

    def go(self, url):
        self.ask("WebDriver:Navigate", {"url": url})

    def run(self, script, *arguments):
        """The value of a script's `return`, which may be promised."""
        return self.ask("WebDriver:ExecuteScript", {"script": script, "args": list(arguments)})["value"]

    def wait(self, script, *arguments, seconds=30):
        """Waits until a script returns something true, and returns that."""
        until = time.monotonic() + seconds
        while True:
            found = self.run(script, *arguments)
            if found:
                return found
            assert time.monotonic() < until, f"not within {seconds} s: {script}"
            time.sleep(0.05)

    def find(self, selector):
        return self.ask("WebDriver:FindElement", {"using": "css selector", "value": selector})["value"]

    def click(self, selector):
        (name,) = self.find(selector).values()
        self.ask("WebDriver:ElementClick", {"id": name})

    def keys(self, selector, text):
        (name,) = self.find(selector).values()
        self.ask("WebDriver:ElementSendKeys", {"id": name, "text": text})

    def console(self):
        """Errors and warnings of the page's scripts and of the browser about them, since it was asked last."""
        self.ask("Marionette:SetContext", {"value": "chrome"})
        found = self.run(
            """
            const service = Cc["@mozilla.org/consoleservice;1"].getService(Ci.nsIConsoleService);
            const storage = Cc["@mozilla.org/consoleAPI-storage;1"].getService(Ci.nsIConsoleAPIStorage);
            const own = (place) => /^(http:..127|file:)/.test(place);
            const scripts = service.getMessageArray().filter((one) => one instanceof Ci.nsIScriptError);
            const thrown = scripts.filter((one) => own(one.sourceName));
            const bad = ({ level }) => ["error", "warn"].includes(level);
            const said = storage.getEvents().filter((one) => bad(one) && own(one.filename));
            service.reset();
            storage.clearEvents();
            return [...thrown.map((one) => one.errorMessage), ...said.map((one) => [...one.arguments].join(" "))];
            """
        )
        self.ask("Marionette:SetContext", {"value": "content"})
        return found


@contextmanager
def firefox(folder, size=(1440, 900)):
    """A Firefox with a profile of its own in a folder."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    profile = folder / "profile"
    profile.mkdir()
    lines = [f"user_pref({json.dumps(k)}, {json.dumps(v)});" for k, v in PREFERENCES.items()]
    lines.append(f'user_pref("marionette.port", {port});')
    (profile / "user.js").write_text("\n".join(lines))
    flags = ["--headless", "--marionette", "--remote-allow-system-access", "--no-remote", "--profile", profile]
    process = subprocess.Popen([FIREFOX, *flags], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        running = Firefox(port)
        running.ask("WebDriver:SetWindowRect", dict(zip(("width", "height"), size, strict=True)))
        yield running
    finally:
        process.terminate()
        process.wait(timeout=20)
