"""Take the two pictures of the atlas that README.md shows, with Debian's chromium.

certify atlas --to site && python docs/screenshots.py site
"""

import shutil
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

DOCS = Path(__file__).parent
WIDTH = 1120
ARGUMENTS = ("--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")


def main() -> None:
    """Open the index, filtered, and the page of 8_E, pulled apart."""
    site = Path(sys.argv[1]).resolve().as_uri()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=[*ARGUMENTS]
        )
        page = browser.new_page(viewport={"width": WIDTH, "height": 760})
        page.goto(f"{site}/index.html#size=8")
        page.wait_for_timeout(1000)
        page.screenshot(path=DOCS / "atlas-index.png")
        page.set_viewport_size({"width": WIDTH, "height": 900})
        page.goto(f"{site}/patterns/8_E.html")
        page.wait_for_selector("#view canvas")
        page.fill("#apart", "1.6")
        page.locator("#apart").blur()
        page.wait_for_timeout(3000)
        page.screenshot(path=DOCS / "atlas-pattern.png")
        browser.close()


if __name__ == "__main__":
    main()
