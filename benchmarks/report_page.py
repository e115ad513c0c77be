"""How quick a report's vessel is for its reader: seconds until it can be turned, and pictures a second while it turns, in a headless
Chromium that draws by the processor.

usage: python3 benchmarks/report_page.py PAGE.html...    (report.html, as fsi-compare report leaves it)
"""

import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests" / "integration" / "compare"))

from browser import PROGRAM, Browser  # noqa: E402

PICTURES = 120
VESSEL = "document.querySelector('.vessel').vessel"
READY = "new Promise(done => (function look() { document.querySelector('.vessel').dataset.ready ? done(true) : setTimeout(look, 5); })())"
TRIANGLES = (
    "%s.view.panes.reduce((sum, pane) => { let here = 0; pane.scene.traverse(o => { if (o.isMesh && o.visible) "
    "here += o.geometry.index.count / 3; }); return sum + here; }, 0)" % VESSEL
)
# Each picture is asked for when the one before is drawn, and the last is waited for.
TURN = (
    "(v => new Promise(done => { let n = 0; const view = v.view, begin = performance.now(), drawn = v.frames || 0;"
    "(function step() { if (n++ === %d) { view.renderer.getContext().finish();"
    "done([(v.frames || 0) - drawn, performance.now() - begin]); return; }"
    "view.turn(5, 1); requestAnimationFrame(step); })(); }))(%s)" % (PICTURES, VESSEL)
)


def measure(page):
    """(triangles, seconds until ready, pictures a second)."""
    with Browser(webgl=True) as browser:
        begin = time.monotonic()
        browser.open(page)
        browser.await_(READY)
        ready = time.monotonic() - begin
        triangles = browser.evaluate(TRIANGLES)
        browser.await_(TURN)  # the first pictures compile what draws
        pictures, milliseconds = browser.await_(TURN)
    return triangles, ready, 1000 * pictures / milliseconds


def main(words):
    if not words or words[0].startswith("-"):
        print(__doc__, file=sys.stderr)
        return 1
    if PROGRAM is None:
        print("report_page.py: error: chromium is not there; install the Debian package chromium", file=sys.stderr)
        return 1
    print(f"{'triangles':>10} {'opens [s]':>10} {'pictures a second':>18}  page")
    for word in words:
        triangles, ready, rate = measure(Path(word).resolve())
        print(f"{triangles:>10.0f} {ready:>10.2f} {rate:>18.1f}  {word}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
