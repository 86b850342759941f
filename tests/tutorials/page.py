"""What a tutorial's page has to be run: its commands, files, and outputs."""
import dataclasses
import functools
import re

FENCE = re.compile(r"^```(\S*)\s*$")
NEEDS = re.compile(r"\bneeds `([\w.-]+)`", re.IGNORECASE)
FILE = re.compile(r"`([\w./-]+)`:$")
END_OF_FILE = "end_of_this_file"


class Failure(Exception):
    """A page does not do what it says."""

    def __init__(self, page, line, why):
        super().__init__(f"{page}:{line}: {why}")


@dataclasses.dataclass
class Expected:
    of: int            # the block of commands, by its number
    line: int          # of the fence
    lines: list[str]


@dataclasses.dataclass
class Blocks:
    script: list[str]  # a line for each line of the page
    expected: list[Expected]
    missing: list[tuple[int, str]]
    count: int


def read(page, has):
    """Makes a page a bash script whose lines have the page's numbers.

    has: tells whether a tool is here.
    """
    found = Blocks([], [], [], 0)
    lines = page.read_text().splitlines()
    missing, before, k = None, "", 0
    while k < len(lines):
        fence = FENCE.match(lines[k])
        if not fence:
            missing = note(lines[k], k, missing, found, has)
            before = lines[k] or before
            found.script.append("")
            k += 1
            continue
        end = next((j for j in range(k + 1, len(lines))
                    if lines[j].strip() == "```"), None)
        if end is None:
            raise Failure(page, k + 1, "this block has no end")
        inside = lines[k + 1:end]
        if missing:
            found.script += [""] * (len(inside) + 2)
        else:
            add(found, fence[1], inside, before, page, k + 1)
        k, before = end + 1, ""
    return found


def note(line, k, missing, found, has):
    """Of a line of text: the tool that this section lacks, if any."""
    if line.startswith("#"):
        missing = None
    for tool in NEEDS.findall(line):
        if not missing and not has(tool):
            missing = tool
            found.missing.append((k + 1, tool))
    return missing


def add(found, kind, inside, before, page, line):
    """A block whose fence is at `line`."""
    if kind == "sh":
        found.count += 1
        found.script += [f"begin {found.count}", *inside, ""]
    elif kind == "text":
        if not found.count or any(x.of == found.count for x in found.expected):
            raise Failure(page, line, "there are no commands that print this")
        found.expected.append(Expected(found.count, line, inside))
        found.script += [""] * (len(inside) + 2)
    elif name := FILE.search(before):
        folder = name[1].rpartition("/")[0] or "."
        found.script += [f"mkdir -p '{folder}'; cat >'{name[1]}' "
                         f"<<'{END_OF_FILE}'", *inside, END_OF_FILE]
    else:
        raise Failure(page, line, "which file is this? The line before has to "
                      "end with its name, \"`mine.toml`:\"")


def differs(expected, printed, page):
    """Raises a Failure at the first line that nothing printed is like."""
    furthest = 0

    def like(line, text):
        parts = map(re.escape, line.rstrip().split("…"))
        return re.fullmatch(".*?".join(parts), text.rstrip()) is not None

    @functools.cache
    def rest(i, j):
        nonlocal furthest
        furthest = max(furthest, i)
        if i == len(expected.lines):
            return j == len(printed)
        if expected.lines[i].strip() == "…":
            return any(rest(i + 1, n) for n in range(j, len(printed) + 1))
        return (j < len(printed) and like(expected.lines[i], printed[j])
                and rest(i + 1, j + 1))

    if not rest(0, 0):
        raise Failure(page, expected.line + 1 + furthest,
                      "this is not printed, but\n" + "\n".join(printed[-60:]))
