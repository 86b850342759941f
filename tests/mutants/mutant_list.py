"""The mutants: those that are written by hand, and those that are drawn."""
import dataclasses
import hashlib
import pathlib
import re
import sys
import tomllib

from operators import WEIGHTS, Site, sites
from switch import FOLDERS

HERE = pathlib.Path(__file__).resolve().parent
DRAWN, LEAST, SPARE = 190, 6, 3  # of a folder at least; times as many in spare
SEED = 1


@dataclasses.dataclass
class Mutant:
    name: str
    file: str
    line: int
    site: Site
    says: str = ""
    processes: str = ""
    test: str = ""  # the one that must notice it, "FOLDER/FILE: CASE"; or any
    number: int = 0

    @property
    def folder(self):
        return self.file.partition("/")[0]

    @property
    def lines(self):
        return range(self.line, self.line + self.site.text.count("\n") + 1)

    def overlaps(self, other):
        """One may lie within the other's lines: what is built is one text."""
        return self.file == other.file and (
            self.site.start < other.site.end
            and other.site.start < self.site.end)


def stop(sentence):
    print(f"mutants: {sentence}", file=sys.stderr)
    sys.exit(2)


def line_of(source, at):
    return source.count("\n", 0, at) + 1


def by_hand(files, path=HERE / "by_hand.toml"):
    """Those of a list; each names a file, a text that is there once, and what
    it becomes."""
    found = []
    for entry in tomllib.loads(path.read_text())["mutant"]:
        source = files.get(entry["file"], (b"", 0))[0].decode()
        text = entry["text"].strip("\n")
        if source.count(text) != 1:
            stop(f"{path.name}: {entry['name']}: its text is "
                 f"{source.count(text)} times in {entry['file']}, and must be "
                 "there once.")
        start = source.index(text)
        broken = entry["broken"].strip("\n")
        kind = ("text" if "MUTANT" in broken else
                "statement" if text.endswith(";") else "expression")
        found.append(Mutant(entry["name"], entry["file"],
                            line_of(source, start),
                            Site(start, text, broken, kind, "by hand"),
                            entry["says"], entry.get("processes", ""),
                            entry.get("test", "")))
    names = [x.name for x in found]
    for name in names:
        if names.count(name) > 1:
            stop(f"{path.name}: {name} is there twice.")
    return found


def number_of(text):
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:8])


def candidates(path, source):
    """(place in the draw, mutant): its place hangs on nothing but its text, so
    that a change elsewhere draws the same."""
    seen = {}
    for site in sites(source):
        words = "|".join(re.sub(r"\s+", " ", x) for x in (site.text,
                                                        site.broken))
        seen[words] = seen.get(words, 0) + 1
        drawn = number_of(f"{SEED}|{path}|{words}|{seen[words]}")
        place = drawn / WEIGHTS[site.operator]
        yield place, Mutant(f"{path}#{drawn % 0x100000:05x}", path,
                            line_of(source, site.start), site)


def shares(sizes):
    """How many of each folder: by the roots of their sizes, and not few."""
    roots = {folder: size ** .5 for folder, size in sizes.items()}
    all_roots = sum(roots.values())
    return {folder: max(LEAST, round(DRAWN * root / all_roots))
            for folder, root in roots.items()}


def in_draw(files, taken):
    """{folder: its mutants in the order of the draw}, with some to spare; none
    at a place that is taken, and no three of a file."""
    found = {}
    sources = {path: octets.decode() for path, (octets, _) in files.items()
               if path.endswith(".cpp") and path.partition("/")[0] in FOLDERS}
    sizes = {folder: sum(len(text) for path, text in sources.items()
                         if path.startswith(folder + "/"))
             for folder in FOLDERS}
    for folder, share in shares(sizes).items():
        every = sorted((x for path, text in sources.items()
                        if path.startswith(folder + "/")
                        for x in candidates(path, text)), key=lambda x: x[0])
        chosen = []
        for _, mutant in every:
            if len(chosen) == SPARE * share:
                break
            if any(mutant.overlaps(x) for x in [*taken, *chosen]) or sum(
                    x.file == mutant.file for x in chosen) > 2:
                continue
            chosen.append(mutant)
        found[folder] = (share, chosen)
    return found


def reasons(page="survivors.md"):
    """{name: why nothing can notice it}"""
    text = (HERE / page).read_text()
    return dict(re.findall(r"^- `([^`]+)`: (.+(?:\n  .+)*)", text, re.M))
