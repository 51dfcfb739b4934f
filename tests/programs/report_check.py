#!/usr/bin/env python3
"""Checks a page of make report by parsing: sections, pictures, tables against the CSV files; prints a line for every fault.

    report_check.py PAGE RESULTS SECTION...       RESULTS: folder and name of the files of the run, without endings
    report_check.py --browser PAGE                the text of the page that tells a browser's view of its pictures, for --dump-dom
"""
import base64
import csv
import html.parser
import struct
import sys


class Page(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.section, self.sections, self.images, self.cells, self.drawn, self.words, self.outside = "", [], {}, {}, {}, {}, []

    def handle_starttag(self, tag, attributes):
        at = dict(attributes)
        if tag == "section":
            self.section = at["id"]
            self.sections.append(self.section)
        if tag == "img":
            self.images.setdefault(self.section, []).append(at["src"])
        if tag in ("polygon", "svg"):
            self.drawn.setdefault(self.section, []).append(at.get("fill", tag))
        if tag == "tr":
            self.cells.setdefault(self.section, []).append([])
        self.outside += [at[k] for k in ("src", "href") if k in at and not at[k].startswith(("data:", "#"))]

    def handle_data(self, data):
        if self.section in self.cells and self.lasttag in ("td", "th"):
            self.cells[self.section][-1].append(data)
        self.words[self.section] = self.words.get(self.section, "") + data


def number(text):
    try:
        return float(text)
    except ValueError:
        return None


def faults(page, results, wanted):
    for name in wanted:
        if name not in page.sections:
            yield f"no section {name}"
    if page.outside:
        yield f"not self-contained: {page.outside[0]}"
    for section, images in page.images.items():
        for source in images:
            data = base64.b64decode(source.partition("base64,")[2])
            if data[:8] != b"\x89PNG\r\n\x1a\n" or b"IEND" not in data[-12:]:
                yield f"{section}: an image is no PNG"
            elif min(struct.unpack(">II", data[16:24])) < 300 or len(data) < 5000:
                yield f"{section}: an image is blank"
    if "joints" in wanted:
        colours = set(page.drawn.get("joints", [])) - {"none", "svg"}
        if page.drawn.get("joints", []).count("svg") > 0 and len(colours) < 4:
            yield f"joints: {len(colours)} colours of pressure"
    for section, ending, column, heading in (("bolts", "bolt", "force", "force"), ("modes", "modes", "frequency", "frequency")):
        if section not in wanted:
            continue
        rows = list(csv.DictReader(open(f"{results}.{ending}.csv", newline="")))
        if section == "bolts":
            rows = list({(row["stage"], row["bolt"]): row for row in rows}.values())
        head = page.cells[section][0]
        at = head.index(heading)
        shown = [number(row[at]) for row in page.cells[section][1:len(rows) + 1]]
        if any(x is None or abs(x - float(row[column])) > 1e-3*abs(x) + 1e-12 for x, row in zip(shown, rows)) or len(shown) != len(rows):
            yield f"{section}: {column} is {shown}"


def main():
    if sys.argv[1] == "--browser":
        text = open(sys.argv[2]).read()
        script = ("<script>window.onload = () => { document.body.innerHTML = [...document.querySelectorAll('img')].map(i => 'image ' + "
                  "i.naturalWidth).join(';') + ';' + [...document.querySelectorAll('svg')].map(s => 'svg ' + s.getBBox().width).join(';'); }"
                  "</script></body>")
        print(text.replace("</body>", script))
        return
    page = Page()
    page.feed(open(sys.argv[1]).read())
    for fault in faults(page, sys.argv[2], sys.argv[3:]):
        print(fault)
    print("checked", sum(len(v) for v in page.images.values()), "images,", sum(v.count("svg") for v in page.drawn.values()), "drawings")


if __name__ == "__main__":
    main()
