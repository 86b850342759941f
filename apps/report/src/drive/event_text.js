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

const short = (text) => `${Number(Number(text).toFixed(2))}`;

/// "qos_latency value_ms=61.200000 limit_ms=50.000000" in words.
function detail_text(detail) {
  const limit = detail.match(/^(.+) value(_ms)?=(\S+) limit(?:_ms)?=(\S+)$/);
  if (limit) {
    const [, what, ms, value, most] = limit;
    const unit = ms ? " ms" : "";
    return `${reasons[what] ?? what} ${short(value)}${unit}, limit ${short(most)}${unit}`;
  }
  const near = detail.match(/^(with \S+) ttc_s=(\S+)(?: limit_s=(\S+))?$/);
  if (near)
    return `${near[1]}, time to collision ${short(near[2])} s${near[3] ? `, limit ${short(near[3])} s` : ""}`;
  return reasons[detail] ?? detail;
}

/// @returns the event's name.
export const event_name = ({ what }) => names[what] ?? what.replaceAll("_", " ");

/// @returns whom and what it concerns.
export const event_about = ({ service, provider, detail }) =>
  [service, provider, detail_text(detail)].filter((part) => part).join(" · ");
