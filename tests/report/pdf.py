"""What stands on paper: the text of a PDF, and the pixels of its pages. Needs
poppler-utils."""

import shutil
import subprocess
import xml.etree.ElementTree


def program():
    """Whether this machine can read PDFs."""
    return shutil.which("pdftotext") and shutil.which("pdftoppm")


def text_of(file):
    return subprocess.run(["pdftotext", "-layout", file, "-"], check=True,
                          text=True, capture_output=True).stdout


def words_of(file):
    """For each page its words in their order, as (text, left, top), in points."""
    page = xml.etree.ElementTree.fromstring(subprocess.run(
        ["pdftotext", "-bbox", file, "-"], check=True, text=True,
        capture_output=True).stdout)
    space = "{http://www.w3.org/1999/xhtml}"
    return [[(word.text, float(word.get("xMin")), float(word.get("yMin")))
             for word in sheet.iter(space + "word")]
            for sheet in page.iter(space + "page")]


class Sheet:
    """One page as pixels."""

    def __init__(self, file, number, dots_per_inch=72):
        data = subprocess.run(
            ["pdftoppm", "-r", str(dots_per_inch), "-f", str(number), "-l",
             str(number), file], check=True, capture_output=True).stdout
        kind, size, _, self.pixels = data.split(b"\n", 3)
        assert kind == b"P6"
        self.width, self.height = map(int, size.split())

    def coloured(self, left, top, right, bottom):
        """How many pixels there are not grey."""
        count = 0
        for y in range(max(int(top), 0), min(int(bottom), self.height)):
            for x in range(max(int(left), 0), min(int(right), self.width)):
                at = 3 * (y * self.width + x)
                colour = self.pixels[at:at + 3]
                count += max(colour) - min(colour) > 60
        return count

    def places_of(self, colour, tolerance=6):
        """Where pixels of a colour are, as (x, y)."""
        return [(i % self.width, i // self.width)
                for i in range(self.width * self.height)
                if all(abs(self.pixels[3 * i + k] - colour[k]) <= tolerance
                       for k in range(3))]


def sheets_of(file):
    pages = subprocess.run(["pdfinfo", file], check=True, text=True,
                           capture_output=True).stdout
    count = int(next(line.split()[1] for line in pages.splitlines()
                     if line.startswith("Pages:")))
    return [Sheet(file, i + 1) for i in range(count)]
