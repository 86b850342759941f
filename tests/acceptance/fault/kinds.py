"""The kinds of faults; for tests/acceptance/faults.

Each is a function of a pair of hosts and of a random generator: it brings the
fault about, holds it, mends it, and says what else matters to who judges it.
What it draws is its own, so that the same seed gives the same fault.
"""
import signal
import time

NO_RESULTS = "the run goes on without results"
DAY_S = 24 * 3600
BEYOND_THE_CERTIFICATES_S = 900 * DAY_S
LONG_S = (0.05, 0.15, 0.3, 0.6, 0.9, 1.1, 1.5, 2.0, 3.0)


def hold(draw, lengths=LONG_S):
    """For as long as one of these, or up to a third longer."""
    time.sleep(draw.choice(lengths) * draw.uniform(1, 4 / 3))


# -- processes ---------------------------------------------------------------------

def kill_edge(pair, draw):
    pair.began()
    pair.edge.end(signal.SIGKILL)
    hold(draw)
    pair.start_edge()


def kill_car(pair, draw):
    del draw
    pair.began()
    pair.car.end(signal.SIGKILL)
    pair.car.start()


def stop(host, pair, draw):
    pair.began()
    host.send(signal.SIGSTOP)
    hold(draw)
    pair.mended()
    host.send(signal.SIGCONT)


def stop_edge(pair, draw):
    stop(pair.edge, pair, draw)


def stop_car(pair, draw):
    stop(pair.car, pair, draw)


# -- the way between them ----------------------------------------------------------

def cut(pair, draw, *to):
    pair.began()
    pair.way.route("add", *to)
    hold(draw)
    pair.mended()
    pair.way.route("del", *to)


def cut_both(pair, draw):
    cut(pair, draw, pair.way.CAR, pair.way.EDGE)


def cut_up(pair, draw):
    cut(pair, draw, pair.way.EDGE)


def cut_down(pair, draw):
    cut(pair, draw, pair.way.CAR)


def unplug(pair, draw):
    pair.began()
    pair.way.plug("down")
    hold(draw)
    pair.mended()
    pair.way.plug("up")


# -- disks -------------------------------------------------------------------------

def fill(host, pair, draw):
    """The process goes on without results until it is started again. An edge
    server may have nothing to write until it ends."""
    pair.began()
    host.disk.fill()
    pair.wait_until(lambda: host.said(NO_RESULTS), 1.5)
    hold(draw)
    pair.mended()
    code = host.end()
    told = host.said(NO_RESULTS)
    host.disk.empty()
    host.start()
    return {"told": told, "code": code}


def fill_edge(pair, draw):
    more = fill(pair.edge, pair, draw)
    pair.await_edge()
    return more


def fill_car(pair, draw):
    return fill(pair.car, pair, draw)


def hang(host, pair, draw):
    """It hangs, or writes in between, ten times more slowly than it should."""
    at_once = draw.random() < 0.5
    pair.began()
    for _ in range(1 if at_once else 10):
        host.disk.hang()
        hold(draw, LONG_S if at_once else (0.2,))
        host.disk.go_on()
        time.sleep(0.02)


def slow_edge(pair, draw):
    hang(pair.edge, pair, draw)


def slow_car(pair, draw):
    hang(pair.car, pair, draw)


# -- clocks: the calendar's, which programs and certificates go by -----------------

def shift(clock, pair, offset_s):
    pair.began()
    clock.write_text(f"{offset_s:+.3f}\n")
    time.sleep(2.5)  # libfaketime looks once a second
    clock.write_text("+0\n")
    time.sleep(1.0)
    pair.mended()


def step(clock, pair, draw):
    shift(clock, pair,
          draw.choice((-1, 1)) * draw.choice((0.05, 0.5, 5, 60, DAY_S)))


def step_edge(pair, draw):
    step(pair.edge_clock, pair, draw)


def step_car(pair, draw):
    step(pair.car_clock, pair, draw)


def leap_edge(pair, draw):
    del draw
    shift(pair.edge_clock, pair, BEYOND_THE_CERTIFICATES_S)


def leap_car(pair, draw):
    del draw
    shift(pair.car_clock, pair, BEYOND_THE_CERTIFICATES_S)


# -- keys --------------------------------------------------------------------------

def read_again(pair, *hosts, says="keys were read again"):
    for host in hosts or (pair.edge, pair.car):
        before = host.said(says)
        host.send(signal.SIGHUP)
        pair.expect(lambda: host.said(says) > before, f"{host.name}: {says}")


def renew_edge(pair, draw):
    pair.began()
    pair.keys.renew(pair.keys.edge)
    read_again(pair, pair.edge)
    hold(draw, (0.3,))


def renew_car(pair, draw):
    pair.began()
    pair.keys.renew(pair.keys.car)
    read_again(pair, pair.car)
    hold(draw, (0.3,))


def break_keys(pair, draw):
    host, its = draw.choice(((pair.edge, pair.keys.edge),
                             (pair.car, pair.keys.car)))
    pair.began()
    mend = pair.keys.break_certificate(its)
    read_again(pair, host, says="keys stay as they were")
    hold(draw, (0.3,))
    mend()
    read_again(pair, host)


def roll_over(pair, draw):
    pair.began()
    hosts = {pair.keys.edge: pair.edge, pair.keys.car: pair.car}
    pair.keys.roll_over(
        lambda *changed: read_again(pair, *(hosts[x] for x in changed)))
    hold(draw, (0.3,))


def revoke(pair, draw, of, told):
    keys = {pair.edge: pair.keys.edge, pair.car: pair.keys.car}
    pair.keys.revoke(keys[of], keys[told])
    pair.began()
    told.send(signal.SIGHUP)
    time.sleep(1.0)  # by then it is out
    hold(draw, (0.2, 1.0, 2.0))
    pair.mended()
    pair.keys.replace(keys[of])
    read_again(pair, of)


def revoke_edge(pair, draw):
    revoke(pair, draw, pair.edge, pair.car)


def revoke_car(pair, draw):
    revoke(pair, draw, pair.car, pair.edge)


# How many of each are in a hundred and thirty-two.
WEIGHTS = {
    kill_edge: 12, kill_car: 12, stop_edge: 10, stop_car: 10, cut_both: 8,
    cut_up: 10, cut_down: 8, unplug: 6, fill_edge: 4, fill_car: 4, slow_edge: 5,
    slow_car: 5, step_edge: 4, step_car: 4, leap_edge: 4, leap_car: 4,
    renew_edge: 3, renew_car: 3, break_keys: 4, roll_over: 4, revoke_edge: 4,
    revoke_car: 4,
}
OF_CLOCKS = {step_edge, step_car, leap_edge, leap_car}
