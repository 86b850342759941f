"""What the tests share: where things are, and what is missing here."""
import importlib.util
import os
import pathlib
import sys
import tempfile
import unittest

TESTS = pathlib.Path(__file__).resolve().parent
PACKAGE = TESTS.parent
CHECKOUT = PACKAGE.parent
CONFIG = CHECKOUT / "config"
sys.path.insert(0, str(PACKAGE))
os.environ["PYTHONPATH"] = os.pathsep.join(
    [str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])])
os.environ.setdefault("MPLBACKEND", "Agg")


# Debian has them: a test that does without one has been skipped.
IN_DEBIAN = {"numpy", "pandas", "matplotlib"}
SKIPPED = 77
all_missing: set[str] = set()


def needs(*modules: str):
    """A test that is skipped, and says so, where a module is missing."""
    missing = [x for x in modules if importlib.util.find_spec(x) is None]
    words = f"NOT TESTED: {', '.join(missing)} not installed"
    if missing:
        print(words, file=sys.stderr)
    all_missing.update(missing)
    return unittest.skipIf(missing, words)


def main() -> None:
    """Runs the tests of the main module; exits with 77 where something of
    Debian is missing for some, and the others pass."""
    done = unittest.main(exit=False).result
    if not done.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if all_missing & IN_DEBIAN else 0)


class InFolder(unittest.TestCase):
    """A test with a folder of its own, `self.folder`."""

    def setUp(self) -> None:
        at = tempfile.TemporaryDirectory(prefix="sofof_test_")
        self.addCleanup(at.cleanup)
        self.folder = pathlib.Path(at.name)
