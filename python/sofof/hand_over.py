"""Run as the process of a policy by an environment: hands its standard input
to the environment over a local socket, and waits until that lets go of it. So
the simulation talks to the environment without anybody between them."""
import socket
import sys


def main(address: str) -> None:
    with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as to:
        to.connect(address)
        socket.send_fds(to, [b"0"], [0])
        to.recv(1)


if __name__ == "__main__":
    try:
        main(sys.argv[1])
    except OSError:
        sys.exit(1)  # the environment is gone
