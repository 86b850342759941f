"""The tables of a results folder: their columns, types and units, as
docs/results.md describes them. The one list that `load` goes by."""
import dataclasses

# Ends of names that say the unit; the longest that fits counts.
UNIT_OF_ENDING = {
    "_s": "s", "_ms": "ms", "_us": "us", "_m": "m", "_rad": "rad",
    "_mps": "m/s", "_mps2": "m/s^2", "_mps3": "m/s^3", "_m2ps3": "m^2/s^3",
    "_j": "J", "_share": "1",
}

# Letters of `_columns` below.
DTYPE_OF_LETTER = {
    "f": "float64",    # a quantity; empty: NaN
    "i": "int64",      # a count, never empty
    "n": "int64",      # the number of something, never empty
    "N": "Int64",      # the same, may be empty: <NA>
    "b": "bool",       # 1 and 0
    "c": "category",   # one of a few names; empty: NaN
    "t": "string",     # text; empty: <NA>
}


@dataclasses.dataclass(frozen=True)
class Column:
    """One column.

    Attributes:
        name: as in the file.
        dtype: of pandas.
        unit: "s", "m/s", "octets", "1" for a count; None for names, numbers of
            things, and text.
    """
    name: str
    dtype: str
    unit: str | None


def unit_of(name: str) -> str | None:
    """What a name says of its unit: "m/s" of "speed_mps"; None: nothing."""
    fits = [x for x in UNIT_OF_ENDING if name.endswith(x)]
    return UNIT_OF_ENDING[max(fits, key=len)] if fits else None


def _columns(text: str,
             units: dict[str, str] | None = None) -> tuple[Column, ...]:
    """Of "name:letter" words; a word alone is a quantity."""
    columns = []
    for word in text.split():
        name, _, letter = word.partition(":")
        dtype = DTYPE_OF_LETTER[letter or "f"]
        unit = (units or {}).get(name)
        if unit is None and (letter or "f") in "fi":
            unit = unit_of(name) or "1"
        columns.append(Column(name, dtype, unit))
    return tuple(columns)


_SESSION = "station:n provider:c provider_id:n service:c counter:n "

TABLES: dict[str, tuple[Column, ...]] = {
    "events": _columns(
        "t_s what:c station:n provider:c provider_id:n service:c counter:n "
        "detail:t"),
    "episodes": _columns(
        "side:c " + _SESSION + "accepted_s first_data_s ended_s t_off_s "
        "reason:c fallback:b because:t"),
    "cycles": _columns(
        _SESSION + "cycle:n created_s received_s latency_ms input_age_ms "
        "interarrival_ms used:b doubt_ms uplink_wait_ms uplink_ms queue_ms "
        "computing_ms downlink_wait_ms downlink_ms rest_ms"),
    "margins": _columns(
        _SESSION + "cycle:n received_s margin:c left",
        {"left": "as the end of margin says"}),
    "protocol_trace": _columns(
        "t_s by:c step:n what:c provider_id:n station:n number:n services:t "
        "detail:t"),
    "tracks": _columns(
        "t_s station:n x_m y_m heading_rad speed_mps accel_mps2 s_m lateral_m "
        "plan_age_ms source:c"),
    "plans": _columns("t_s station:n ahead_s x_m y_m speed_mps"),
    "vehicles": _columns(
        "station:n driven_s distance_m without_fresh_plan_s off_road_s "
        "collisions:i max_plan_age_ms plans:i emergency_plans:i kept_plans:i "
        "stop_plans:i imperfect_plans:i safe_stops:i min_accel_mps2 "
        "max_jerk_mps3 max_lateral_accel_mps2 hard_brakes:i comfort_cost_m2ps3 "
        "delay_s stops:i longest_stop_s arrived:b on_board_cycles:i "
        "offloaded_cycles:i energy_j all_on_board_j"),
    "distributions": _columns("service:c figure:c up_to_ms count:i"),
    "load": _columns(
        "t_s provider:c what:c jobs:i asked_share busy_share mean_wait_ms "
        "max_wait_ms"),
    "octets": _columns(
        "t_s provider:c direction:c what:c messages:i sent:i delivered:i "
        "lost:i under_way:i",
        dict.fromkeys(("sent", "delivered", "lost", "under_way"), "octets")),
    "energy": _columns(
        "station:N chain:c split:c service:c place:c driven_s distance_m "
        "own_results:i computing_s resting_s octets_up:i octets_down:i "
        "results:i served_s computing_j resting_j framework_j sending_j "
        "receiving_j server_busy_j server_idle_j home_j",
        dict.fromkeys(("octets_up", "octets_down"), "octets")),
    "disturbed": _columns(
        "t_s provider:c direction:c station:n what:c lost:i outage:i stall:i "
        "slow:i copied:i overtaken:i"),
    "responses": _columns(
        "t_s station:n split:c response_ms waited_ms services_ms:t control_ms",
        {"services_ms": "ms"}),
    "scene": _columns("t_s station:n service:c safe_ms because:c response_ms"),
    "claims": _columns(
        "station:n lane:c claimed_s bound_s enters_s leaves_s kept:b"),
    "quality": _columns("provider:c service:c x_m y_m visits late latency_s"),
    "timing": _columns("figure:t value",
                       {"value": "as the end of figure says"}),
    "cpu": _columns(
        "station:N actor:c service:c source:c cpu_s time_s percent wakes:i",
        {"percent": "%"}),
}

FILES: dict[str, str] = {
    name: name + (".jsonl" if name == "events" else ".csv") for name in TABLES
}
