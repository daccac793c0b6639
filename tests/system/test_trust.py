#!/usr/bin/env python3
"""The program from outside: nothing is written but in the folder of results, and a user's texts stay texts."""
import html.parser
import re

from case import main
from reliable import BODY, Reliability


class Links(html.parser.HTMLParser):
    """Everything in a page that may lead somewhere."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        names = ("src", "srcset", "href", "xlink:href", "action", "formaction", "data", "poster", "background")
        self.found += [(tag, name, value or "") for name, value in attributes if name in names]


class Trust(Reliability):
    def test_nothing_is_written_outside_the_folder_and_texts_stay_texts(self):
        title = "<script>alert(1)</script> \"'&; $(touch owned) `touch owned` ../../owned"
        deck = self.deck({"test": "ucs", "title": title, "specimen": BODY, "output": {"fields": 1}})
        before = {p for p in self.folder.rglob("*")}
        self.assertEqual(self.run_program("run", deck, "--out", "out", "--quiet").returncode, 0)
        new = {p.relative_to(self.folder).parts[0] for p in self.folder.rglob("*") if p not in before}
        self.assertEqual(new, {"out"})
        page = self.content("out", "report.html").decode()
        self.assertNotIn("<script>alert", page)
        self.assertIn("&lt;script&gt;", page)
        bare = page.replace("http://www.w3.org/2000/svg", "")
        for outside in ("http:", "https:", "@import"):
            self.assertFalse(outside in bare, outside)
        for start in re.finditer(r"url\(", bare):  # a plot's own frame, by its name within the page
            self.assertRegex(bare[start.start():start.start() + 40], r"^url\(#")
        self.assertIn("default-src 'none'", page)
        links = Links()
        links.feed(page)
        self.assertGreater(len(links.found), 5)
        for tag, name, target in links.found:  # "//" stands in the scripts' comments, too, but in no address
            self.assertNotIn("//", "" if target.startswith("data:image/png;base64,") else target, (tag, name))
        names = [{"name": "../../owned", "card": "concrete_sfer"}]
        bad = self.deck({"test": "ucs", "specimen": BODY, "output": {"folder": "/tmp/owned"}, "more": names}, "bad.json")
        self.assertEqual(self.run_program("run", bad, "--out", "bad").returncode, 2)

    def test_a_series_manifest_cannot_lead_out_of_its_folder(self):
        for name in ("../owned", "/tmp/owned", "..", "a/b", ".hidden"):
            manifest = self.deck({"proveta_series_manifest": 1, "members": [{"name": name, "deck": {"test": "ucs"}}]}, "manifest.json")
            done = self.run_program("run", manifest, "--out", "out")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn("the name of a folder", done.stderr)


if __name__ == "__main__":
    main()
