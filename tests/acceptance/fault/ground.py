"""What two hosts stand on, and what faults take from it: a way between them
over a third network namespace, which can be cut in one direction alone, a disk
for each, and a certification authority; for tests/acceptance/faults.

Each namespace and each disk is taken away again by `close`.
"""
import os
import pathlib
import shutil
import subprocess

DISK_MB = 64
PORT = 4711


def run(*command, text=None):
    """@returns what it prints; raises with what it says when it fails."""
    done = subprocess.run([str(word) for word in command], text=True,
                          capture_output=True, input=text)
    if done.returncode:
        raise RuntimeError(f"{' '.join(map(str, command))}: "
                           f"{(done.stderr or done.stdout).strip()}")
    return done.stdout


class Way:
    """From the car's namespace over a router's to the edge server's."""

    CAR, EDGE = "10.99.1.2", "10.99.2.2"

    def __init__(self, name):
        self.car, self.router, self.edge = (
            f"{name}_{part}" for part in ("car", "way", "edge"))
        self._made = []
        try:
            self._make()
        except BaseException:
            self.close()
            raise

    def _make(self):
        for space in (self.car, self.router, self.edge):
            run("ip", "netns", "add", space)
            self._made.append(space)
            run("ip", "-n", space, "link", "set", "lo", "up")
        # A filter of senders would take a way that is closed for both.
        for file, value in (("conf/all/rp_filter", 0),
                            ("conf/default/rp_filter", 0), ("ip_forward", 1)):
            run("ip", "netns", "exec", self.router, "sh", "-c",
                f"echo {value} >/proc/sys/net/ipv4/{file}")
        for space, net in ((self.car, 1), (self.edge, 2)):
            run("ip", "-n", self.router, "link", "add", f"to{net}", "type",
                "veth", "peer", "name", "out", "netns", space)
            run("ip", "-n", self.router, "addr", "add", f"10.99.{net}.1/24",
                "dev", f"to{net}")
            run("ip", "-n", self.router, "link", "set", f"to{net}", "up")
            run("ip", "-n", space, "addr", "add", f"10.99.{net}.2/24", "dev",
                "out")
            run("ip", "-n", space, "link", "set", "out", "up")
            run("ip", "-n", space, "route", "add", "default", "via",
                f"10.99.{net}.1")

    def route(self, verb, *to):
        """Closes (add) or opens (del) what leads to somebody, all at once."""
        run("ip", "-n", self.router, "-batch", "-", text="".join(
            f"route {verb} blackhole {address}/32\n" for address in to))

    def plug(self, state):
        run("ip", "-n", self.router, "link", "set", "to1", state)

    def close(self):
        for space in self._made:
            subprocess.run(["ip", "netns", "del", space])


class Disk:
    """A small disk of one's own, in memory, that can get full and hang."""

    def __init__(self, folder):
        self.at = folder / "disk"
        self.at.mkdir(parents=True)
        self._image = pathlib.Path(f"/dev/shm/{folder.parent.name}_{os.getpid()}"
                                   f"_{folder.name}.img")
        self._hangs = self._mounted = False
        try:
            with open(self._image, "wb") as file:
                file.truncate(DISK_MB << 20)
            run("mkfs.ext4", "-q", "-m", "0", "-O", "^has_journal", self._image)
            run("mount", "-o", "loop,noatime", self._image, self.at)
            self._mounted = True
        except BaseException:
            self.close()
            raise

    def fill(self):
        """Takes all that is left, without writing it, which would take a core."""
        room = os.statvfs(self.at)
        step, size = room.f_bavail * room.f_bsize, 0
        with open(self.at / "filler", "wb") as file:
            while step >= room.f_bsize:
                try:
                    os.posix_fallocate(file.fileno(), size, step)
                    size += step
                except OSError:
                    step //= 2

    def empty(self):
        (self.at / "filler").unlink(missing_ok=True)

    def hang(self):
        """Whoever writes waits until `go_on`."""
        self._hangs = True
        run("fsfreeze", "--freeze", self.at)

    def go_on(self):
        if self._hangs:
            run("fsfreeze", "--unfreeze", self.at)
            self._hangs = False

    def close(self):
        try:
            self.go_on()
        finally:
            if self._mounted:
                subprocess.run(["umount", str(self.at)])
            self._image.unlink(missing_ok=True)


class Keys:
    """A certification authority, and the folders of keys of two hosts."""

    def __init__(self, program, folder, stations):
        self._program, self._folder = str(program), folder
        self._count, self._authorities = 0, []
        self.stations = stations
        self.edge, self.car = folder / "edge", folder / "car"
        self._ca = self._new_ca()
        for names, host in self._hosts():
            self._sofof("issue", self._ca, *names, "--out", host)

    def _sofof(self, *words):
        run(self._program, "keys", *words)

    def _hosts(self):
        return ((("--provider", "mec"), self.edge),
                (("--station", self.stations), self.car))

    def _new_ca(self):
        self._count += 1
        ca = self._folder / f"ca_{self._count}"
        self._sofof("init", ca)
        self._authorities.append(ca)
        return ca

    def renew(self, host):
        self._sofof("renew", self._ca, host)

    def replace(self, host):
        """Another certificate, as one that is revoked cannot be renewed."""
        self._give(host, self._ca)

    def _give(self, host, ca):
        self._count += 1
        aside = self._folder / f"keys_{self._count}"
        names = next(names for names, its in self._hosts() if its == host)
        self._sofof("issue", ca, *names, "--out", aside)
        for file in ("key.pem", "cert.pem"):
            shutil.copy(aside / file, host / file)

    def revoke(self, host, told):
        """Takes a host's certificates back, and lets the other one know."""
        names = next(names for names, its in self._hosts() if its == host)
        # Of earlier CAs, too: connections that are open go on with theirs.
        for ca in self._authorities:
            self._sofof("revoke", ca, *names)
        (told / "revoked").write_text("".join(
            (ca / "revoked").read_text() for ca in self._authorities))

    def break_certificate(self, host):
        """@returns how to mend it."""
        file = host / "cert.pem"
        whole = file.read_bytes()
        file.write_text("broken\n")
        return lambda: file.write_bytes(whole)

    def roll_over(self, tell):
        """To another CA, as docs/deployment.md says; `tell` is called after each
        step, with nothing or with the host that has changed."""
        following = self._new_ca()
        old, new = ((ca / "ca.pem").read_text() for ca in (self._ca, following))
        for _, host in self._hosts():
            (host / "ca.pem").write_text(old + new)
        tell()
        for _, host in self._hosts():
            self._give(host, following)
            tell(host)
        for _, host in self._hosts():
            (host / "ca.pem").write_text(new)
        tell()
        self._ca = following
