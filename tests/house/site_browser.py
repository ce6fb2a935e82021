# Tries a built site in headless Chromium, behind a server and from files: tests/house/site_browser.py SITE.
"""Its search finds words, no page is wider than a phone, its log has no error, and nothing is asked for elsewhere."""
import functools
import http.server
import queue
import re
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from urllib.parse import unquote

SITE = Path(sys.argv[1]).resolve()
PAGES = ("index.html", "guide/many-worlds.html", "guide/gallery.html", "guide/reports.html", "lessons/learn.html", "evidence/promises.html",
         "api/c.html", "api/cpp/world.html", "api/python/world.html")


class Told(http.server.SimpleHTTPRequestHandler):
    """The site, and what its pages tell of themselves."""

    heard: "queue.Queue[str]" = queue.Queue()

    def do_GET(self) -> None:
        if self.path.startswith("/told?"):
            Told.heard.put(unquote(self.path[6:]))
        super().do_GET()

    def log_message(self, *_: object) -> None:
        pass


def command(url: str, profile: str, log: Path) -> "list[str]":
    return ["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}", "--window-size=1280,1000",
            "--disable-features=AutofillServerCommunication,OptimizationHints,OptimizationHintsFetching,OptimizationGuideModelDownloading",
            "--disable-background-networking", "--disable-component-update", "--no-first-run", "--enable-logging=stderr", f"--log-net-log={log}", url]


def chromium(url: str, profile: str, log: Path) -> str:
    """The page as HTML after its scripts have run; its requests are in the log."""
    done = subprocess.run([*command(url, profile, log), "--virtual-time-budget=15000", "--dump-dom"], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, timeout=120)
    for line in done.stderr.splitlines():
        if "CONSOLE" in line and ("error" in line.lower() or "refused" in line.lower()):
            faults.append(f"{url}: {line}")
    return done.stdout


def asked(page: str, width: int, expression: str, port: int, folder: str) -> int:
    """What an expression says of a page in a frame of that width, as soon as it is above 0."""
    probe = SITE / "probe.html"
    probe.write_text(f"""<iframe src="{page}" width={width} height=800></iframe><script>
        const timer = setInterval(() => {{
            const page = frames[0].document, told = page.readyState === "complete" ? {expression} : 0;
            if (told > 0) {{ clearInterval(timer); fetch("/told?" + told); }}
        }}, 100);</script>""")
    browser = subprocess.Popen(command(f"http://localhost:{port}/probe.html", f"{folder}/asked", Path(folder) / "asked.json"),
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        return int(Told.heard.get(timeout=40))
    except queue.Empty:
        return 0
    finally:
        browser.terminate()
        browser.wait(timeout=20)
        probe.unlink()


def elsewhere(log: Path) -> "set[str]":
    """Hosts that the page asked for, beside this machine."""
    text = log.read_text(encoding="utf-8", errors="replace")
    return {host for host in re.findall(r'"url":"https?://([^/"]+)', text) if not host.startswith("localhost")} - OWN


# What the browser asks for by itself, with an empty page.
OWN: "set[str]" = set()
faults: "list[str]" = []


def main() -> int:
    server = http.server.ThreadingHTTPServer(("localhost", 0), functools.partial(Told, directory=str(SITE)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    port = server.server_port
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "log.json"
        chromium("about:blank", f"{folder}/own", log)
        OWN.update(elsewhere(log))
        for base in (f"http://localhost:{port}", f"file://{SITE}"):
            for page in PAGES:
                if "</html>" not in chromium(f"{base}/{page}", f"{folder}/pages", log):
                    faults.append(f"{base}/{page}: is not shown")
                for host in elsewhere(log):
                    faults.append(f"{base}/{page}: asks {host}")
        of_files = chromium(f"file://{SITE}/index.html?q=restitution", f"{folder}/search", log).count('class="md-search-result__link"')
        found = "page.querySelectorAll('.md-search-result__link').length"
        for name, hits in (("files", of_files), ("a server", asked("index.html?q=restitution", 1280, found, port, folder))):
            print(f"from {name} the search finds {hits} places")
            if hits < 5:
                faults.append(f"from {name} the search finds {hits} places with the word restitution")
        for page in PAGES:
            wide = asked(page, 360, "page.scrollingElement.scrollWidth", port, folder)
            if not 0 < wide <= 360:
                faults.append(f"{page}: is {wide} pixels wide on a screen of 360")
    server.shutdown()
    print("\n".join(faults) or "the site works in Chromium, and asks for nothing elsewhere")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
