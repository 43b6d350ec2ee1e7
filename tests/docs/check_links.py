#!/usr/bin/env python3
"""Fails if a link between pages leads nowhere: check_links.py CHECKOUT. Addresses of the web are not asked."""
import pathlib
import re
import sys

FENCE = re.compile(r"^( *)```.*?^\1```$", re.M | re.S)
LINK = re.compile(r"\]\(([^)\s]+)\)")
HEADING = re.compile(r"^#+ +(.*?) *$", re.M)


def anchors(page):
    """Of headings, as hosting sites and MkDocs make them."""
    headings = HEADING.findall(FENCE.sub("", page.read_text()))
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def main():
    top = pathlib.Path(sys.argv[1]).resolve()
    pages = [*top.glob("*.md"), *(top / "docs").rglob("*.md")]
    faults = 0
    checked = 0
    for page in pages:
        for link in LINK.findall(FENCE.sub("", page.read_text())):
            if re.match(r"[a-z]+:", link):
                continue
            checked += 1
            name, _, anchor = link.partition("#")
            target = (page.parent / name).resolve() if name else page
            if not target.exists():
                print(f"{page}: there is no {link}")
                faults += 1
            elif anchor and anchor not in anchors(target):
                print(f"{page}: {link}: no heading of that name")
                faults += 1
    print(f"{checked} links in {len(pages)} pages")
    sys.exit(faults > 0 or checked < 50)


if __name__ == "__main__":
    main()
