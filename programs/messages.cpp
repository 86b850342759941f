// Lines of JSON.
#include "programs/messages.hpp"

#include "programs/json_writer.hpp"
#include <cassert>
#include <span>

namespace sofof::programs {

namespace {

using namespace policies;

/// Random numbers that come with each ask.
constexpr std::uint32_t draws_of_an_ask = 4;

/// A message, from its brackets to the end of its line.
class message {
public:
  message(std::string& to, std::string_view type) : to_{to}, line{to} {
    line.open('{').key("type").text(type);
  }
  message(const message&) = delete;
  message& operator=(const message&) = delete;
  ~message() {
    line.close('}');
    to_ += '\n';
  }

private:
  std::string& to_;

public:
  json_writer line;
};

void put_place(json_writer& to, std::string_view key,
               const service_place& place) {
  to.key(key);
  if (place)
    to.number(place->value());
  else
    to.null();
}

/// @param time  Unlimited is null.
void put_time(json_writer& to, std::string_view key, duration time) {
  to.key(key);
  if (time == duration::max())
    to.null();
  else
    to.seconds(time);
}

void put_time(json_writer& to, std::string_view key,
              const std::optional<duration>& time) {
  put_time(to, key, time.value_or(duration::max()));
}

void put_points(json_writer& to, std::string_view key,
                std::span<const point> all) {
  to.key(key).open('[');
  for (const auto& x : all)
    to.open('[').number(x.x_m).number(x.y_m).close(']');
  to.close(']');
}

void put_draws(json_writer& to, const random_stream& noise,
               std::uint64_t number) {
  to.key("draws").open('[');
  for (std::uint32_t lane = 0; lane < draws_of_an_ask; ++lane)
    to.number(noise.uniform(number, lane));
  to.close(']');
}

void put_cost(json_writer& to, const world::cycle_cost& cost) {
  to.key("time_s").number(cost.time_s);
  to.key("energy_j").number(cost.energy_j);
}

void put_on_board(json_writer& to, const world::cycle_cost& cost) {
  to.key("on_board").open('{');
  put_cost(to, cost);
  to.close('}');
}

void put_needs(json_writer& to, const service_needs& needs) {
  to.key("needs").open('{');
  put_time(to, "period_s", needs.period);
  put_time(to, "max_latency_s", needs.max_latency);
  put_time(to, "max_interarrival_s", needs.max_interarrival);
  put_time(to, "worst_response_s", needs.worst_response);
  to.close('}');
}

void put_provider(json_writer& to, const provider_view& x,
                  const world::cycle_cost& on_board,
                  const service_needs& needs) {
  to.open('{').key("id").number(x.id.value());
  to.key("x_m").number(x.at.x_m).key("y_m").number(x.at.y_m);
  to.key("east_mps").number(x.velocity_mps.x_m);
  to.key("north_mps").number(x.velocity_mps.y_m).key("reach_m");
  if (x.reach_m)
    to.number(*x.reach_m);
  else
    to.null();
  to.key("utilisation").number(x.utilisation);
  to.key("workers").number(x.workers);
  to.key("computing_s").number(x.computing_s);
  to.key("late").number(x.link.late).key("gap").number(x.link.gap);
  put_time(to, "median_s", x.link.median);
  put_time(to, "p99_s", x.link.p99);
  put_cost(to, x.cost);
  to.key("gain").number(gain(x, on_board, needs)).close('}');
}

void put_providers(json_writer& to, std::span<const provider_view> all,
                   const world::cycle_cost& on_board,
                   const service_needs& needs) {
  to.key("providers").open('[');
  for (const auto& x : all)
    put_provider(to, x, on_board, needs);
  to.close(']');
}

void put_forecasts(json_writer& to, std::span<const provider_forecast> all) {
  to.key("forecasts").open('[');
  for (const auto& x : all) {
    to.open('{').key("provider").number(x.provider.value());
    to.key("along").open('[');
    for (const auto& p : x.along) {
      to.open('{').key("in_s").number(p.in_s);
      to.key("late").number(p.late);
      to.key("latency_s").number(p.latency_s).close('}');
    }
    to.close(']').close('}');
  }
  to.close(']');
}

void put_chain(json_writer& to, std::span<const chain_link> all) {
  to.key("chain").open('[');
  for (const auto& x : all) {
    to.open('{').key("service").text(x.service);
    put_place(to, "place", x.place);
    to.key("moves").flag(x.moves);
    put_on_board(to, x.on_board);
    to.key("resting_j").number(x.resting_j);
    put_needs(to, x.needs);
    put_providers(to, x.providers, x.on_board, x.needs);
    to.close('}');
  }
  to.close(']');
}

void put_task(json_writer& to, std::string_view key, const periodic_task& x) {
  to.key(key).open('{');
  put_time(to, "wcet_s", x.wcet);
  put_time(to, "period_s", x.period);
  put_time(to, "deadline_s", x.deadline);
  put_time(to, "jitter_s", x.jitter);
  put_time(to, "offset_s", x.offset);
  to.key("overrun").open('{');
  to.key("probability").number(x.overrun.probability);
  to.key("mean_s").number(x.overrun.mean_s).close('}').close('}');
}

std::string_view name_of(link_place at) {
  switch (at) {
    case link_place::none:
      return "none";
    case link_place::elsewhere:
      return "elsewhere";
    case link_place::asked:
      return "asked";
    case link_place::here:
      return "here";
  }
  return "none";
}

void put_linked(json_writer& to, std::string_view key,
                const linked_service& x) {
  to.key(key).open('{').key("service").text(x.service);
  to.key("at").text(name_of(x.at)).close('}');
}

/// What a request and a session have in common, behind `station`, `service`.
void put_work(json_writer& to, const auto& x) {
  to.key("utilisation").number(x.utilisation);
  put_task(to, "task", x.task);
  put_task(to, "at_most", x.at_most);
  to.key("candidates").open('[');
  for (const auto& c : x.candidates) {
    to.open('{').key("provider").number(c.provider.value());
    to.key("gain").number(c.gain);
    to.key("utilisation").number(c.utilisation).close('}');
  }
  to.close(']');
  put_linked(to, "follows", x.links.follows);
  put_linked(to, "followed_by", x.links.followed_by);
}

void put_request(json_writer& to, const request_view& x) {
  to.open('{').key("station").number(x.station.value());
  to.key("service").text(x.service);
  to.key("speed_mps").number(x.speed_mps);
  put_points(to, "route", x.route);
  put_work(to, x);
  to.close('}');
}

void put_session(json_writer& to, const session_view& x) {
  to.open('{').key("station").number(x.station.value());
  to.key("service").text(x.service);
  to.key("since_s").seconds(x.since.time_since_epoch());
  to.key("worker").number(x.worker);
  put_work(to, x);
  to.close('}');
}

} // namespace

void append_hello(std::string& to, std::string_view side,
                  std::string_view scenario, std::uint64_t seed) {
  message hello{to, "hello"};
  hello.line.key("sofof").number(protocol_version);
  hello.line.key("policy").text(side).key("scenario").text(scenario);
  hello.line.key("seed").number(seed);
}

void append_ask(std::string& to, std::uint64_t n, const local_context& context,
                const wishes& wanted) {
  assert(n >= 1);
  message ask{to, "ask"};
  auto& line = ask.line;
  line.key("n").number(n).key("policy").text("lodm");
  line.key("t_s").seconds(context.now.time_since_epoch());
  line.key("station").number(context.station.value());
  line.key("service").text(context.service);
  put_place(line, "current", context.current);
  line.key("since_s").seconds(context.since.time_since_epoch()).key("here");
  if (const auto* here = where_it_runs(context))
    put_provider(line, *here, context.on_board, context.needs);
  else
    line.null();
  line.key("speed_mps").number(context.speed_mps);
  put_providers(line, context.providers, context.on_board, context.needs);
  put_points(line, "path", context.path);
  put_needs(line, context.needs);
  put_on_board(line, context.on_board);
  put_draws(line, context.noise, context.number);
  if (wanted.scene)
    put_time(line, "safe_response_s", context.safe_response);
  if (wanted.forecast)
    put_forecasts(line, context.forecasts);
  if (wanted.chain)
    put_chain(line, context.chain);
}

void append_ask(std::string& to, std::uint64_t n,
                const central_context& context) {
  assert(n >= 1);
  message ask{to, "ask"};
  auto& line = ask.line;
  line.key("n").number(n).key("policy").text("codm");
  line.key("t_s").seconds(context.now.time_since_epoch());
  line.key("provider").number(context.self.value());
  line.key("utilisation").number(context.utilisation);
  line.key("workers").number(context.workers);
  put_points(line, "area", context.area.corners());
  line.key("east_mps").number(context.area_velocity_mps.x_m);
  line.key("north_mps").number(context.area_velocity_mps.y_m);
  line.key("requests").open('[');
  for (const auto& x : context.requests)
    put_request(line, x);
  line.close(']').key("sessions").open('[');
  for (const auto& x : context.sessions)
    put_session(line, x);
  line.close(']');
  put_draws(line, context.noise, context.number);
}

void append_told(std::string& to, const cycle_outcome& outcome) {
  message told{to, "told"};
  auto& line = told.line;
  line.key("what").text("cycle").key("t_s").seconds(
      outcome.at.time_since_epoch());
  line.key("station").number(outcome.station.value());
  line.key("service").text(outcome.service);
  put_place(line, "computed_at", outcome.computed_at);
  line.key("latency_s").number(outcome.latency_s);
  line.key("missed").flag(outcome.missed);
  line.key("energy_j").number(outcome.energy_j);
  line.key("cycles").number(outcome.cycles);
}

void append_told(std::string& to, const refusal_outcome& outcome) {
  message told{to, "told"};
  auto& line = told.line;
  line.key("what").text("refusal").key("t_s").seconds(
      outcome.at.time_since_epoch());
  line.key("station").number(outcome.station.value());
  line.key("service").text(outcome.service);
  line.key("provider").number(outcome.provider.value());
  line.key("why").text(outcome.why);
}

void append_told(std::string& to, const episode_outcome& outcome) {
  message told{to, "told"};
  auto& line = told.line;
  line.key("what").text("episode");
  line.key("station").number(outcome.station.value());
  line.key("service").text(outcome.service);
  line.key("provider").number(outcome.provider.value());
  line.key("remote_s").number(outcome.remote_s);
  line.key("end_reason").text(outcome.end_reason);
}

void append_bye(std::string& to) {
  message{to, "bye"};
}

} // namespace sofof::programs
