import io
import json
import math
import os
import resource
import shutil
import signal
import socket
import tempfile
import time
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from conftest import BINARY, DESIGNS, ROOT, centrode
from studio import computes, rests, studio

DESIGN = DESIGNS["elliptic"]
ARMS = (ROOT / "tests" / "designs" / "three-arm-2021.toml").read_text()
SHAFT = (ROOT / "tests" / "designs" / "spiral-shaft-2018.toml").read_text()

SEARCH = {"text": ARMS, "method": "de", "seed": 1, "evaluations": 100_000_000}
RESPONSE = {"text": DESIGN, "key": "pitch.module", "from": 2.0, "to": 2.5}


@pytest.fixture
def design(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(DESIGN)
    return path


@pytest.fixture(scope="module")
def served(tmp_path_factory):
    path = tmp_path_factory.mktemp("studio") / "pair.toml"
    path.write_text(DESIGN)
    with studio(path) as running:
        yield running


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "example.org"},
        {"Host": "example.org:80"},
        {"Host": None},
        {"Origin": "http://example.org"},
        {"Origin": "null"},
        {"Origin": None},
    ],
    ids=["foreign host", "foreign host and port", "no host", "foreign origin", "null origin", "no origin"],
)
def test_strangers_are_refused(served, headers):
    before = served.design.read_text()
    status, _ = served.ask("POST", "save", {"text": "stolen = true\n", "over": True}, headers)
    assert status in (400, 403)
    assert served.design.read_text() == before
    assert served.answers()


@pytest.mark.parametrize(
    ("more", "is_let_in"),
    [
        ("", True),
        ("Host: {own}", False),
        ("Host: example.org", False),
        ("HOST: localhost:1", False),
        ("Host:", False),
        ("Origin: http://{own}\r\nOrigin: http://{own}", False),
    ],
    ids=["one host", "the same twice", "another", "another port", "an empty one", "two origins"],
)
def test_a_second_host_or_origin_is_refused(served, more, is_let_in):
    own = f"127.0.0.1:{served.port}"
    for lines in (f"Host: {own}\r\n{more}", f"{more}\r\nHost: {own}"):
        head = "".join(f"{line}\r\n" for line in lines.format(own=own).split("\r\n") if line)
        with socket.create_connection(("127.0.0.1", served.port), timeout=20) as client:
            client.sendall(f"GET {served.base} HTTP/1.1\r\n{head}Connection: close\r\n\r\n".encode())
            status = client.makefile("rb").readline().split()[1]
        assert (status == b"200") == is_let_in, head
        assert is_let_in or status in (b"400", b"403")


@pytest.mark.parametrize(
    "path",
    ["/", "/design", "/{base}/../design", "/wrong/design", "//design", "/%2e%2e/design", "/../../etc/passwd"],
)
def test_without_the_secret_nothing_is_told(served, path):
    status, text = served.ask("GET", path.replace("{base}", "x"), absolute=True)
    assert status == 403
    assert b"family" not in text
    assert served.answers()


@pytest.mark.parametrize(
    "path", ["../pair.toml", "..%2fpair.toml", "%2e%2e/%2e%2e/etc/passwd", "pair.toml", "main.js/.."]
)
def test_no_path_leads_to_other_files(served, path):
    status, text = served.ask("GET", path)
    assert status in (403, 404)
    assert b"family" not in text
    assert b"root:" not in text
    assert served.answers()


def test_a_huge_body_is_refused(served):
    size = 100 << 20
    status, _ = served.ask("POST", "solve", b"", {"Content-Length": str(size)})
    assert status == 413
    # Without its length told, it is refused once it has come too far.
    with socket.create_connection(("127.0.0.1", served.port), timeout=20) as client:
        head = f"POST {served.base}solve HTTP/1.1\r\nHost: 127.0.0.1:{served.port}\r\nOrigin: http://127.0.0.1:{served.port}\r\n"
        client.sendall((head + "Content-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n").encode())
        part = b"10000\r\n" + b" " * 0x10000 + b"\r\n"
        sent = 0
        try:
            while sent < size:
                client.sendall(part)
                sent += len(part)
        except OSError:
            pass
        assert sent < size
    assert served.answers()


def test_a_thousand_slow_clients_do_not_keep_the_page_out(served):
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(4096, resource.getrlimit(resource.RLIMIT_NOFILE)[1]),) * 2)
    clients = []
    try:
        for _ in range(1000):
            client = socket.create_connection(("127.0.0.1", served.port), timeout=20)
            client.sendall(b"GET / HTTP/1.1\r\nHost: slow")
            clients.append(client)
            if len(clients) % 250 == 0:
                assert served.answers()
    finally:
        for client in clients:
            client.close()
    assert served.answers()


def test_every_answer_has_the_policy(served):
    connection = served.connect()
    connection.request("GET", served.base)
    answer = connection.getresponse()
    policy = answer.headers["Content-Security-Policy"]
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert answer.headers["Referrer-Policy"] == "no-referrer"
    assert answer.headers["X-Content-Type-Options"] == "nosniff"
    connection.close()


def test_the_page_says_what_check_says(served):
    status, snapshot = served.json("POST", "solve", {"text": DESIGN, "depth": "checks"})
    assert status == 200
    cells = {}
    for group in snapshot["verdict"]["figures"]:
        for row in group["rows"]:
            cells |= {cell["key"]: cell["exact"] for cell in row["cells"] if cell}
    printed = centrode("check", served.design, "--json", check=False).stdout
    assert cells
    for key, exact in cells.items():
        assert f'"{key}": {exact},' in printed or f'"{key}": {exact}\n' in printed, key


def test_an_edit_keeps_comments_and_order(served):
    text = "# mine\n" + DESIGN.replace("module = 2.25", "module = 2.25   # mm")
    edits = [{"key": "pitch.module", "value": 2.5}]
    status, snapshot = served.json("POST", "solve", {"text": text, "edits": edits, "depth": "picture"})
    assert status == 200
    assert snapshot["text"] == text.replace("2.25 ", "2.5 ")
    assert snapshot["picture"]["links"]
    assert snapshot["verdict"] is None


def test_a_law_is_read_from_the_file_next_to_the_design(served):
    law = served.design.with_name("law.csv")
    text = DESIGN.partition("[pitch]")[0] + '[pitch]\nkind = "ratio"\nfile = "law.csv"\nmodule = 2\ntooth_count = 24\n'
    ask = {"text": text, "depth": "checks"}
    samples = [1 + 0.1 * math.cos(math.radians(5 * k)) for k in range(72)]
    law.write_text("\n".join(map(str, samples)))
    status, snapshot = served.json("POST", "solve", ask)
    assert status == 200
    # The text of the page still names the file.
    assert (snapshot["text"], snapshot["error"]) == (text, None)
    assert "72 samples" in snapshot["definition"]
    law.write_text("\n".join(map(str, samples[::2])))
    assert "36 samples" in served.json("POST", "solve", ask)[1]["definition"]
    assert served.json("POST", "fault", {"text": text})[1]["fault"] is None
    law.unlink()
    snapshot = served.json("POST", "solve", ask)[1]
    assert snapshot["error"]["key"] == "pitch.file"
    assert "cannot read law.csv" in snapshot["error"]["message"]
    line = text.splitlines().index('file = "law.csv"') + 1
    assert served.json("POST", "fault", {"text": text})[1]["fault"]["line"] == snapshot["error"]["line"] == line


def test_an_error_stands_at_its_key_in_the_words_of_check(served, tmp_path):
    edits = [{"key": "teeth.backlash", "value": -1}]
    _, snapshot = served.json("POST", "solve", {"text": DESIGN, "edits": edits, "depth": "checks"})
    assert snapshot["error"]["key"] == "teeth.backlash"
    bad = tmp_path / "bad.toml"
    bad.write_text(snapshot["text"])
    assert f"error: {snapshot['error']['message']}\n" in centrode("check", bad, check=False).stderr


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (DESIGN, None),
        (DESIGN + "= nothing", {"key": "", "line": DESIGN.count("\n") + 1, "column": 1}),
        (DESIGN.replace("bore", "bores", 1), {"key": "driver.bores", "line": 11, "column": 1}),
    ],
    ids=["a design", "no TOML", "an unknown key"],
)
def test_a_text_is_read_and_its_fault_told(served, text, fault):
    status, answer = served.json("POST", "fault", {"text": text})
    assert status == 200
    assert answer.keys() == {"fault"}
    if fault is None:
        assert answer["fault"] is None
    else:
        assert answer["fault"].pop("message")
        assert answer["fault"].pop("rule")
        assert answer["fault"] == fault


def test_the_zip_holds_the_files_of_export(served, tmp_path):
    request = {"text": DESIGN, "formats": [], "tolerance": "0.01", "dxf": "r2010", "layers": "cut"}
    status, archive = served.ask("POST", "export", request)
    assert status == 200
    out = tmp_path / "out"
    centrode("export", served.design, "--to", out, "--tolerance", "0.01")
    with zipfile.ZipFile(io.BytesIO(archive)) as files:
        names = {name for name in files.namelist() if not name.endswith("/")}
        assert names == {path.relative_to(out).as_posix() for path in out.rglob("[!.]*") if path.is_file()}
        for name in names:
            assert files.read(name) == (out / name).read_bytes(), name
    status, refused = served.json("POST", "export", {**request, "tolerance": "-1"})
    assert status == 422
    assert "tolerance" in refused["message"]


@pytest.mark.parametrize(("method", "path"), [("POST", "search"), ("DELETE", "search"), ("POST", "response")])
@pytest.mark.parametrize(
    "headers",
    [{"Host": "example.org"}, {"Origin": "http://example.org"}, {"Origin": None}],
    ids=["foreign host", "foreign origin", "no origin"],
)
def test_strangers_start_and_stop_no_search(served, method, path, headers):
    body = None if method == "DELETE" else {"search": SEARCH, "response": RESPONSE}[path]
    assert served.ask(method, path, body, headers)[0] == 403
    assert served.ask(method, f"/{'0' * 32}/{path}", body, absolute=True)[0] == 403
    assert served.json("GET", "search") == (200, None)
    assert served.answers()


@pytest.mark.parametrize("path", ["search", "response"])
@pytest.mark.parametrize(
    ("body", "status"),
    [
        (b"", 400),
        (b"{", 400),
        (b'"text"', 422),
        ({}, 422),
        ({"text": 1}, 422),
        ({**SEARCH, **RESPONSE, "seed": -1, "from": "low"}, 422),
    ],
    ids=["nothing", "no JSON", "no object", "nothing in it", "a number for a text", "words for numbers"],
)
def test_what_is_no_question_starts_nothing(served, path, body, status):
    assert served.ask("POST", path, body)[0] == status
    assert served.json("GET", "search") == (200, None)
    assert served.answers()


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"text": "family ="}, ""),
        ({"text": SHAFT}, "the design has no goals"),
        ({"method": "luck"}, 'unknown method "luck"'),
        ({"evaluations": 0}, "a search needs at least 1 evaluation"),
        ({"method": "guided", "evaluations": 0}, "a search needs at least 1 evaluation"),
    ],
    ids=["no design", "no goals", "unknown method", "no evaluation", "no evaluation, guided"],
)
def test_a_search_that_cannot_begin_says_why(served, change, reason):
    status, answer = served.json("POST", "search", {**SEARCH, **change})
    assert status == 422
    assert answer["message"]
    assert reason in answer["message"]
    assert served.json("GET", "search") == (200, None)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"text": "family ="}, ""),
        ({"key": "pitch.modulus"}, "pitch.modulus"),
        ({"key": "name"}, "name"),
        ({"key": ""}, ""),
        ({"from": 3.0}, "the values must increase, but go from 3 to 2.5"),
        ({"to": 2.0}, "the values must increase, but go from 2 to 2"),
    ],
    ids=["no design", "unknown number", "no number", "no key", "falling values", "one value"],
)
def test_a_response_that_cannot_be_had_says_why(served, change, reason):
    status, answer = served.json("POST", "response", {**RESPONSE, **change})
    assert status == 422
    assert answer["message"]
    assert reason in answer["message"]
    assert served.answers()


def test_values_without_a_mechanism_are_gaps_in_the_response(served):
    status, answer = served.json("POST", "response", {**RESPONSE, "from": -1.0})
    assert status == 200
    figures = answer["charts"][0]["figures"]
    assert figures[0] is None
    assert figures[-1] is not None


def test_a_second_search_takes_the_place_of_the_first(tmp_path):
    design = tmp_path / "arms.toml"
    design.write_text(ARMS)
    with studio(design) as page:
        assert page.json("POST", "search", SEARCH) == (200, {})
        assert page.json("POST", "search", {**SEARCH, "method": "luck"})[0] == 422
        assert page.json("GET", "search")[1]["running"], "a refused search stops none"
        assert page.json("POST", "search", {**SEARCH, "method": "cma-es"}) == (200, {})
        state = page.json("GET", "search")[1]
        assert (state["method"], state["running"]) == ("cma-es", True)
        assert page.json("DELETE", "search") == (200, {})
        end = time.monotonic() + 20
        while page.json("GET", "search")[1]["running"]:
            assert time.monotonic() < end
            time.sleep(0.05)
        state = page.json("GET", "search")[1]
        assert (state["method"], state["ended"]) == ("cma-es", "Stopped")
        assert design.read_text() == ARMS


def test_saving_a_file_changed_by_others_asks_first(design):
    with studio(design) as page:
        design.write_text("# changed\n" + DESIGN)
        status, body = page.json("POST", "save", {"text": DESIGN + "# mine\n", "base": DESIGN})
        assert status == 200
        assert not body["saved"]
        assert "changed on disk" in body["message"]
        assert design.read_text().startswith("# changed")
        assert page.json("POST", "save", {"text": DESIGN + "# mine\n", "base": DESIGN, "over": True})[0] == 200
        assert design.read_text() == DESIGN + "# mine\n"


def test_a_crash_loses_nothing(design):
    work = DESIGN + "# not saved\n"
    with studio(design) as page:
        assert page.json("POST", "keep", {"text": work})[0] == 200
        page.process.kill()
        page.process.wait(timeout=10)
    assert design.read_text() == DESIGN
    with studio(design) as page:
        recovered = page.json("GET", "design")[1]["recovered"]
        assert recovered == [{"text": work, "file": "pair.toml.autosave"}]
        assert page.json("POST", "save", {"text": work, "base": DESIGN})[0] == 200
    assert sorted(path.name for path in design.parent.iterdir()) == ["pair.toml"]
    assert design.read_text() == work


def full_disk():
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (64, 64))


def test_a_full_disk_is_told_and_the_old_file_stays(design):
    with studio(design, preexec_fn=full_disk, restore_signals=False) as page:
        status, body = page.json("POST", "save", {"text": DESIGN + "# more\n" * 20, "base": DESIGN})
        assert status == 507
        assert "cannot write" in body["message"]
        assert page.answers()
    assert design.read_text() == DESIGN
    assert sorted(path.name for path in design.parent.iterdir()) == ["pair.toml"]


@pytest.fixture
def open_place():
    """A folder that everybody may read, unlike the test's own."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        place.chmod(0o755)
        yield place


def test_a_folder_that_cannot_be_written_is_told(open_place):
    folder = open_place / "design"
    folder.mkdir()
    design = folder / "pair.toml"
    design.write_text(DESIGN)
    binary, options = BINARY, {}
    if os.geteuid() == 0:
        # Root may write anywhere: the program runs as somebody else, from where they may read it.
        binary = shutil.copy2(BINARY, open_place / "centrode")
        options = {"user": 65534, "group": 65534, "extra_groups": [], "cwd": open_place}
    folder.chmod(0o555)
    try:
        with studio(design, binary, **options) as page:
            status, body = page.json("POST", "save", {"text": DESIGN + "# more\n", "base": DESIGN})
            assert status == 507
            assert "cannot create" in body["message"]
            assert page.json("POST", "keep", {"text": DESIGN + "# more\n", "base": DESIGN})[0] == 507
            assert page.answers()
    finally:
        folder.chmod(0o755)
    assert design.read_text() == DESIGN


def test_a_bad_start_says_why(tmp_path):
    missing = centrode("studio", tmp_path / "none.toml", check=False)
    assert missing.returncode == 2
    assert "cannot read" in missing.stderr
    piped = centrode("studio", "-", check=False)
    assert piped.returncode == 2
    assert "standard input" in piped.stderr


SLOW = 'family = "gear-pair"\n[pitch]\nkind = "circle"\nmodule = 1\ntooth_count = 10000\n'


def asked(page, path, body):
    """Sends a request and leaves its answer for later."""
    connection = page.connect()
    own = {"Host": f"127.0.0.1:{page.port}", "Origin": f"http://127.0.0.1:{page.port}"}
    connection.request("POST", page.base + path, json.dumps(body), {**own, "Content-Type": "application/json"})
    return connection


def test_a_later_change_stops_a_slow_solve_at_once(served):
    slow = asked(served, "solve", {"page": "a", "text": SLOW, "depth": "picture"})
    computes(served.process)
    quick = asked(served, "solve", {"page": "a", "text": DESIGN, "depth": "picture"})
    assert json.loads(slow.getresponse().read()) == {"overtaken": True}
    assert "picture" in json.loads(quick.getresponse().read())
    rests(served.process)


@pytest.mark.parametrize(
    ("path", "body"),
    [
        ("solve", {"text": SLOW, "depth": "checks"}),
        ("response", {"text": SLOW, "key": "pitch.module", "from": 1, "to": 2}),
        ("export", {"text": SLOW, "formats": [], "tolerance": "0.001", "dxf": "r2010", "layers": "cut"}),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_what_nobody_waits_for_any_more_is_not_computed(served, path, body):
    waiting = asked(served, path, body)
    computes(served.process)
    waiting.close()
    rests(served.process)
    assert served.answers()


def test_a_slow_solve_of_one_page_does_not_hold_up_another(served):
    slow = asked(served, "solve", {"page": "a", "text": SLOW, "depth": "picture"})
    computes(served.process)
    answer = served.json("POST", "solve", {"page": "b", "text": DESIGN, "depth": "checks"})[1]
    assert answer["verdict"]["ok"]
    slow.close()
    rests(served.process)


def test_the_share_of_the_checks_that_is_done_is_told(tmp_path):
    path = tmp_path / "arms.toml"
    path.write_text(ARMS)
    with studio(path) as running:
        assert running.json("GET", "progress/one") == (200, {"share": None})
        ask = {"text": ARMS, "depth": "checks", "page": "one", "turn": 1}
        with ThreadPoolExecutor() as pool:
            checks = pool.submit(running.json, "POST", "solve", ask)
            told = []
            while not checks.done():
                told.append(running.json("GET", "progress/one")[1]["share"])
                time.sleep(0.01)
            status, answer = checks.result()
        assert status == 200
        assert answer["verdict"]
        shares = [share for share in told if share is not None]
        assert shares == sorted(shares)
        assert len({share for share in shares if 0 < share < 1}) > 3
        # Nothing is solved any more, for this page or another.
        assert running.json("GET", "progress/one") == (200, {"share": None})
        assert running.json("GET", "progress/two") == (200, {"share": None})


@pytest.mark.parametrize(
    ("name", "key", "value"),
    [
        ("moving-box-2018", "gears.module", 1e9),
        ("moving-box-2018", "shaft.radius", 1e9),
        ("spiral-shaft-2018", "radius", 1e9),
        ("spiral-shaft-2018", "groove.width", 1e-9),
        ("composed-three-arm", "plates.width", 1e-6),
    ],
)
def test_a_number_out_of_all_proportion_is_drawn_in_bounds(tmp_path, name, key, value):
    path = tmp_path / "design.toml"
    path.write_text((ROOT / "tests" / "designs" / f"{name}.toml").read_text())
    with studio(path) as running:
        ask = {"text": path.read_text(), "edits": [{"key": key, "value": value}], "depth": "picture"}
        # It has twenty seconds.
        status, answer = running.ask("POST", "solve", ask)
        assert status == 200
        assert len(answer) < 8_000_000
        assert json.loads(answer)["picture"] or json.loads(answer)["error"]


def test_ctrl_c_ends_the_program_in_the_middle_of_a_slow_solve(design):
    with studio(design) as page:
        slow = asked(page, "solve", {"text": SLOW, "depth": "checks"})
        computes(page.process)
        page.process.send_signal(signal.SIGINT)
        assert page.process.wait(timeout=10) == 0
        slow.close()
