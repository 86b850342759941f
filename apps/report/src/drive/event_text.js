// What an event says to a reader.

const names = {
  violation: "QoS violation",
  implausible: "implausible result",
  collision: "collision",
  near_miss: "near miss",
  peer_lost: "provider lost",
  provider_lost: "connection lost",
  provider_connected: "connection made",
  requester_lost: "requester lost",
  clock_in_doubt: "clock in doubt",
  clock_known: "clock known",
  refused: "refused",
  result_refused: "result not used",
  arrived: "arrived",
};

const reasons = {
  latency: "latency",
  qos_latency: "latency",
  input_age: "age of the input",
  qos_input_age: "age of the input",
  qos_gap: "gap between results",
  clock_doubt: "doubt of the clock",
  session_over: "its session is over",
};

const units = { ms: " ms", s: " s", m: " m" };

/// Two numbers, with as few digits as tell them apart, but two.
function pair(value, limit) {
  const text = (x, places) => `${Number(Number(x).toFixed(places))}`;
  let places = 2;
  while (places < 6 && value !== limit && text(value, places) === text(limit, places)) ++places;
  return [text(value, places), text(limit, places)];
}

/// "qos_latency value_ms=61.200000 limit_ms=50.000000" in words.
function detail_text(detail) {
  const limit = detail.match(/^(.+) value(?:_(\w+))?=(\S+) limit(?:_\w+)?=(\S+)$/);
  if (limit) {
    const [, what, of, ...numbers] = limit;
    const unit = units[of] ?? "";
    const [value, most] = pair(...numbers);
    return `${reasons[what] ?? what} ${value}${unit}, limit ${most}${unit}`;
  }
  const near = detail.match(/^(with \S+) ttc_s=(\S+)(?: limit_s=(\S+))?$/);
  if (near) {
    const [value, most] = pair(near[2], near[3] ?? near[2]);
    return `${near[1]}, time to collision ${value} s${near[3] ? `, limit ${most} s` : ""}`;
  }
  return reasons[detail] ?? detail;
}

/// @returns the event's name.
export const event_name = ({ what }) => names[what] ?? what.replaceAll("_", " ");

/// @returns whom and what it concerns.
export const event_about = ({ service, provider, detail }) =>
  [service, provider, detail_text(detail)].filter((part) => part).join(" · ");
