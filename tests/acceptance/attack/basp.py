"""The protocol of CAF 0.18's remote actors (BASP), as far as an attacker needs
it, with the messages of sofof; for tests/acceptance/attacks.

Numbers are big-endian, sizes are of 7 bits an octet. A frame is a header of 32
octets and a payload; that of a message begins with the actors that it shall be
forwarded to, then come the ids of its elements' types, then the elements.
"""
import os
import re
import select
import socket
import ssl
import struct
import subprocess
import threading
import time

SERVER_HANDSHAKE, CLIENT_HANDSHAKE, DIRECT, ROUTED, MONITOR, DOWN, HEARTBEAT = \
    range(7)
TOLD = 1 << 60            # the id of a message that expects no answer
RESPONSE = 1 << 63
HEADER = struct.Struct(">BxxBIQQQ")
NONE = b"\xff"            # no node
OUR_ACTOR = 77


def type_ids():
    """Ids of CAF's types that matter, and of ours, counted in type_ids.hpp."""
    ids = {"u32": 9, "u64": 10, "string": 12, "actor": 48, "error": 27,
           "message": 39, "forced_close": 26, "u8": 11, "bool": 0}
    here = os.path.dirname(__file__)
    with open(f"{here}/../../../messages/type_ids.hpp") as file:
        names = re.findall(r"CAF_ADD_TYPE_ID\(sofof, \(([\w:<>]+)\)",
                           file.read())
    for n, name in enumerate(names):
        ids[re.sub(r"\w+::", "", name)] = 200 + n
    return ids


TYPE = type_ids()


def u8(x): return struct.pack(">B", x)
def u16(x): return struct.pack(">H", x)
def u32(x): return struct.pack(">I", x)
def u64(x): return struct.pack(">Q", x)
def i64(x): return struct.pack(">q", x)
def f64(x): return struct.pack(">d", x)


def size(n):
    out = bytearray()
    while n > 0x7f:
        out.append(n & 0x7f | 0x80)
        n >>= 7
    return bytes(out + bytes([n]))


def text(x):
    x = x.encode() if isinstance(x, str) else x
    return size(len(x)) + x


def sequence(items):
    return size(len(items)) + b"".join(items)


def new_node():
    return b"\x01" + os.urandom(24)


def handle(actor, node):
    return u64(actor) + node


def content(types, values, stages=()):
    """A payload; types by name or id."""
    ids = [u16(TYPE.get(t, t)) for t in types]
    return sequence(list(stages)) + sequence(ids) + values


def frame(operation, payload=b"", data=0, source=0, dest=0, flags=0):
    return HEADER.pack(operation, flags, len(payload), data, source,
                       dest) + payload


class Reader:
    def __init__(self, octets):
        self.octets, self.at = octets, 0

    def take(self, n):
        part = self.octets[self.at:self.at + n]
        self.at += n
        if len(part) < n:
            raise EOFError
        return part

    def number(self, n): return int.from_bytes(self.take(n), "big")

    def size(self):
        n = shift = 0
        while True:
            octet = self.number(1)
            n |= (octet & 0x7f) << shift
            shift += 7
            if octet < 0x80:
                return n

    def text(self): return self.take(self.size())
    def node(self): return NONE if self.octets[self.at] == 255 \
        and self.take(1) else self.take(25)

    def handle(self): return self.number(8), self.node()

    def types(self):
        for _ in range(self.size()):
            self.handle()
        return [self.number(2) for _ in range(self.size())]


class Line:
    """A connection, by TLS with a folder of keys, or plain. One thread may read
    while another one writes."""

    def __init__(self, link):
        self.link, self.lock = link, threading.Lock()  # TLS serves one thread
        self.link.setblocking(False)
        self.ended = self.lives = False

    @classmethod
    def to(cls, port, keys=None):
        link = socket.create_connection(("127.0.0.1", port), timeout=5)
        link.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        if keys:
            context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
            context.check_hostname = False
            context.verify_mode = ssl.CERT_NONE
            context.load_cert_chain(f"{keys}/cert.pem", f"{keys}/key.pem")
            link = context.wrap_socket(link)
        return cls(link)

    def when_ready(self, act, for_writing, timeout_s=5):
        """What act gives, once the socket lets it."""
        until = time.monotonic() + timeout_s
        while True:
            try:
                with self.lock:
                    return act()
            except ssl.SSLWantReadError:
                writes = False
            except ssl.SSLWantWriteError:
                writes = True
            except BlockingIOError:
                writes = for_writing
            if time.monotonic() >= until:
                raise TimeoutError
            select.select([] if writes else [self.link],
                          [self.link] if writes else [], [],
                          max(0, until - time.monotonic()))

    def send(self, octets):
        left = memoryview(octets)
        while left:
            left = left[self.when_ready(lambda: self.link.send(left), True):]

    def some(self, n, timeout_s=5):
        """What has come, at most n octets; none at the end."""
        try:
            part = self.when_ready(lambda: self.link.recv(n), False, timeout_s)
        except TimeoutError:
            raise
        except OSError:
            part = b""
        self.ended = not part
        return part

    def take(self, n):
        out = b""
        while len(out) < n:
            part = self.some(n - len(out))
            if not part:
                raise EOFError
            out += part
        return out

    def receive(self):
        """(operation, flags, size, data, source, dest), payload"""
        header = HEADER.unpack(self.take(HEADER.size))
        return header, self.take(header[2])

    def is_open(self):
        try:
            self.send(frame(HEARTBEAT))
            time.sleep(0.2)
            self.send(frame(HEARTBEAT))
            if self.lives:
                time.sleep(0.05)
            else:
                while not self.ended:
                    self.some(65536, 0.05)
        except TimeoutError:
            return True
        except OSError:
            return False
        return not self.ended

    def close(self):
        self.link.close()


class Peer(Line):
    """A connection to a provider."""

    @classmethod
    def at(cls, port, keys=None, node=None):
        """node: the one to introduce, a function of the provider's own."""
        self = cls.to(port, keys)
        _, payload = self.receive()
        read = Reader(payload)
        self.provider = read.node()
        for _ in range(read.size()):
            read.text()
        self.acceptor = read.number(8)
        self.server_hello = payload
        self.node = node(self) if node else new_node()
        if self.node:
            self.introduce_node()
        return self

    def introduce_node(self):
        self.send(frame(CLIENT_HANDSHAKE, self.node))

    def tell(self, dest, types, values, source=OUR_ACTOR, stages=(), data=TOLD):
        self.send(frame(DIRECT, content(types, values, stages), data, source,
                        dest))

    def answer_of(self, *types):
        """Waits for a message of these types; what else comes is lost."""
        wanted = [TYPE[t] for t in types]
        while True:
            header, payload = self.receive()
            if header[0] != DIRECT:
                continue
            read = Reader(payload)
            found = read.types()
            if found == wanted:
                return read
            if found == [TYPE["error"]]:
                raise PermissionError(payload)

    def check_version(self, protocol):
        """Sets types, nonce and handshake."""
        for types in (0, None):
            self.tell(self.acceptor, ["u32", "u64"],
                      u32(protocol) + u64(0 if types == 0 else self.types),
                      data=TOLD | 1)
            read = self.answer_of("u32", "u64", "string", "actor")
            read.number(4)
            self.types = read.number(8)
        self.nonce, self.handshake = read.text(), read.handle()[0]

    def enter(self, stations, world, keys=None, provider="mec"):
        """Sets boot and endpoint."""
        self.check_version(PROTOCOL)
        self.tell(self.handshake, ["peer_hello", "vehicle_endpoint_actor"],
                  hello(provider, stations, world, self.nonce, keys)
                  + handle(OUR_ACTOR, self.node), data=TOLD | 2)
        read = self.answer_of("peer_welcome", "provider_endpoint_actor")
        self.boot, _, self.endpoint = read.number(8), read.number(8), \
            read.handle()[0]

    def live(self):
        """Answers life signs from now on, and reads all else."""
        def answer():
            try:
                while True:
                    header, payload = self.receive()
                    if header[0] != DIRECT:
                        continue
                    read = Reader(payload)
                    if read.types() == [TYPE["ping"]]:
                        now = i64(time.monotonic_ns())
                        self.tell(self.endpoint, ["pong"],
                                  read.take(16) + now + now)
            except TimeoutError:
                self.lives = False
            except (OSError, EOFError, ValueError):
                self.ended = True
        self.lives = True
        threading.Thread(target=answer, daemon=True).start()


def protocol():
    here = os.path.dirname(__file__)
    with open(f"{here}/../../../messages/protocol/remote.hpp") as file:
        return int(re.search(r"remote_protocol = (\d+)", file.read())[1])


PROTOCOL = protocol()


def hello(provider, stations, world, nonce=b"", keys=None):
    certificate = signature = b""
    if keys:
        with open(f"{keys}/cert.pem", "rb") as file:
            certificate = file.read()
        signature = subprocess.run(
            ["openssl", "dgst", "-sha256", "-sign", f"{keys}/key.pem"],
            input=b"sofof proof 1\n" + proof(nonce, provider, stations),
            capture_output=True, check=True).stdout
    epoch_ms = int(time.time() * 1000) - time.monotonic_ns() // 1_000_000
    return (text(provider) + sequence([u32(s) for s in stations]) + u64(world)
            + i64(epoch_ms) + text(certificate) + text(signature))


def proof(nonce, provider, stations):
    def number(n): return struct.pack("<I", n)
    def words(x):
        x = x.encode() if isinstance(x, str) else x
        return number(len(x)) + x
    return (words("SOFOF speaks for stations") + words(nonce) + words(provider)
            + number(len(stations)) + b"".join(map(number, stations)))


def running(boot, station, kind, counter):
    return u64(boot) + u32(station) + text(kind) + u32(counter)
