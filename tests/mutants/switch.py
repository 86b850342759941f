"""All mutants in one build: a copy of the committed sources in which each place
asks which mutant is chosen, by the variable SOFOF_MUTANT of the environment."""
import fcntl
import io
import os
import pathlib
import re
import subprocess
import sys
import tarfile

from operators import code_of

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = """base world messages channel offloading policies planners actors
    network recording scenario experiments apps""".split()
MOST = 1 << 16  # numbers of mutants: octets of the file of those reached

HEADER = """#pragma once
extern int sofof_chosen_mutant;
extern unsigned char* sofof_reached_mutants;
/// Whether this mutant is the one that is chosen; notes that it is reached.
inline bool sofof_mutant(int number) {
  if (sofof_reached_mutants)
    sofof_reached_mutants[number] = 1;
  return number == sofof_chosen_mutant;
}
"""
SOURCE = """#include "base/mutant.hpp"
#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>
int sofof_chosen_mutant = 0;
unsigned char* sofof_reached_mutants = nullptr;
// Before all other statics; what child processes reach is in the same file.
__attribute__((constructor(101))) static void sofof_read_mutant() {
  if (const char* chosen = std::getenv("SOFOF_MUTANT"))
    sofof_chosen_mutant = std::atoi(chosen);
  const char* reached = std::getenv("SOFOF_REACHED_MUTANTS");
  if (!reached)
    return;
  const int file = ::open(reached, O_RDWR | O_CREAT, 0644);
  if (file < 0 || ::ftruncate(file, MOST) != 0)
    std::abort();
  sofof_reached_mutants = static_cast<unsigned char*>(
      ::mmap(nullptr, MOST, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0));
  ::close(file);
}
""".replace("MOST", str(MOST))


# The libraries have asserts, and compile fast; tests are as they always are.
LIBRARY = "target_link_libraries(sofof_${folder} PUBLIC sofof_options ${ARGN})"
OPTIONS = "target_compile_options(sofof_${folder} PRIVATE -O1 -UNDEBUG)"


class Place:
    """Where the copy is, is built, and where results are kept."""

    def __init__(self, copy=ROOT / "build" / "mutants"):
        self.copy = pathlib.Path(copy)
        self.work = self.copy / "build"
        self.tests = self.work / "release" / "tests"
        self.lock = None

    def claim(self):
        """Whether no other run is at work here; none can begin from now on."""
        self.work.mkdir(parents=True, exist_ok=True)
        self.lock = open(self.work / "lock", "w", encoding="utf-8")
        try:
            fcntl.flock(self.lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True


def git(*arguments):
    return subprocess.run(["git", "-C", ROOT, *arguments], check=True,
                          capture_output=True).stdout


def committed():
    """{path: octets} of the commit that is checked out."""
    archive = tarfile.open(fileobj=io.BytesIO(git("archive", "HEAD")))
    return {x.name: (archive.extractfile(x).read(), x.mode)
            for x in archive if x.isfile()}


def on_one_line(text):
    """Without comments: those of a line would end what follows on it."""
    return re.sub(r"\s*\n\s*", " ", re.sub(r"//[^\n]*", "", text))


def switched(number, site):
    """The original with its broken form before it, on as many lines."""
    asks = f"sofof_mutant({number})"
    broken = on_one_line(site.broken)
    if site.kind == "statement":
        other = f"{broken} " if broken else ""
        return f"{{ if ({asks}) {{ {other}}} else {{ {site.text} }} }}"
    if site.kind == "condition":
        return (f"({asks} ? static_cast<bool>({broken})"
                f" : static_cast<bool>({site.text}))")
    if site.kind == "text":
        return site.broken.replace("MUTANT", asks)
    return f"({asks} ? ({broken}) : ({site.text}))"


def with_mutants(source, numbered):
    """A source with all its mutants; lines keep their numbers. A constant that
    holds one is no constant of the compiler's any more."""
    code = code_of(source)
    edits = []
    for number, site in numbered:
        edits.append((site.start, site.end, switched(number, site)))
        begin = max(code.rfind(c, 0, site.start) for c in ";}")
        at = code.rfind("constexpr ", begin + 1, site.start)
        if at >= 0 and "{" not in code[at:site.start].split("=")[0]:
            edits.append((at, at + len("constexpr"), "const"))
    for start, end, new in sorted(set(edits), reverse=True):
        source = source[:start] + new + source[end:]
    return f'#include "base/mutant.hpp"\n#line 1\n{source}'


def write_if_new(path, octets, mode=0o644):
    if path.exists() and path.read_bytes() == octets:
        return
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(octets)
    path.chmod(mode)


def write_copy(place, mutants):
    """Writes only what differs, so that little is compiled again."""
    files = committed()
    for path in {x.file for x in mutants}:
        source, mode = files[path]
        files[path] = (with_mutants(
            source.decode(), [(x.number, x.site) for x in mutants
                              if x.file == path]).encode(), mode)
    files["base/mutant.hpp"] = (HEADER.encode(), 0o644)
    files["base/mutant.cpp"] = (SOURCE.encode(), 0o644)
    cmake, mode = files["CMakeLists.txt"]
    files["CMakeLists.txt"] = (cmake.decode().replace(
        LIBRARY, f"{LIBRARY}\n    {OPTIONS}", 1).encode(), mode)
    for path, (octets, mode) in files.items():
        write_if_new(place.copy / path, octets, mode)
    for folder in [*FOLDERS, "tests"]:
        for path in (place.copy / folder).rglob("*.[ch]pp"):
            if str(path.relative_to(place.copy)) not in files:
                path.unlink()


def not_compiled(place, mutants, targets, jobs):
    """Builds all; returns the mutants on whose lines there are errors."""
    subprocess.run(["cmake", "--preset", "release"], cwd=place.copy, check=True,
                   stdout=subprocess.DEVNULL)
    done = subprocess.run(["ninja", "-k", "0", "-j", str(jobs), "-C",
                           place.work / "release", *targets], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    (place.work / "build.log").write_text(done.stdout)
    if done.returncode == 0:
        return []
    broken = {(os.path.relpath(found[1], place.copy), int(found[2]))
              for found in re.finditer(
                  r"^(/[^:\n]+):(\d+):\d+: +(?:error:|required from)",
                  done.stdout, re.M)}
    found = [x for x in mutants
             if any((x.file, line) in broken for line in x.lines)]
    if not found:
        sys.exit(f"mutants: the copy cannot be built; {place.work}/build.log "
                 "says why, and it must be mended first.")
    return found
