"""Optional programs of tests: locally a line at the end lists what to install, in CI the test fails."""

import os
from collections import Counter

import pytest

INSTALL = "pip install -r python/requirements-test.txt"


def advice(report):
    """The reason of a skip, and how to have the test run."""
    reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
    reason = reason.removeprefix("Skipped: ")
    return f"{reason}: {INSTALL}" if reason.startswith("could not import") else reason


def pytest_collection_modifyitems(items):
    """Long files first: a worker that took one last would run alone."""
    items.sort(key=lambda item: item.path.parent.name == "tests")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    if report.skipped and not hasattr(report, "wasxfail") and os.environ.get("CI"):
        report.outcome = "failed"
        report.longrepr = f"skipped, which CI does not allow: {advice(report)}"
    return report


def pytest_terminal_summary(terminalreporter):
    for reason, count in Counter(map(advice, terminalreporter.stats.get("skipped", []))).items():
        terminalreporter.write_line(f"skipped: {count} test{'s' * (count > 1)}: {reason}", yellow=True)
