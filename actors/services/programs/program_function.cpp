// Steps and inputs go to the process, results come back.
#include "actors/services/programs/program_function.hpp"

#include <utility>

namespace sofof::actors {

program_function::program_function(kept_setup what, program_session whose)
    : whose_{std::move(whose)}, program_{std::move(what),
                                         [this](program_news news) {
                                           report(std::move(news));
                                         }} {}

offloading::service_output
program_function::run(time_point now, const messages::service_input& input) {
  now_ = now;
  if (whose_.besides)
    whose_.besides();
  const auto given = input.what.as<program_octets>();
  if (!given || given->octets.size() > whose_.most_input_octets)
    return {};
  if (!whose_.is_virtual && now - input.at > whose_.oldest_input)
    return {}; // many wait behind it, where the program is too slow for all
  auto result = program_.exchange(now, given->octets);
  if (!result)
    return {};
  return messages::payload::of(program_octets{std::move(*result)});
}

void program_function::observe(time_point now, const messages::service_input&) {
  now_ = now;
  if (!whose_.is_virtual)
    program_.look(now);
}

void program_function::on_step(messages::lifecycle_step step, time_point now) {
  now_ = now;
  switch (step) {
    case messages::lifecycle_step::configure:
      return program_.configure(now);
    case messages::lifecycle_step::activate:
      return program_.activate(now);
    case messages::lifecycle_step::deactivate:
      return program_.deactivate(now);
    case messages::lifecycle_step::shut_down:
      return program_.shut_down(now);
  }
}

std::optional<duration> program_function::measured(std::uint64_t cycle) const {
  if (!whose_.run_times || whose_.run_times->empty())
    return std::nullopt;
  return (*whose_.run_times)[cycle % whose_.run_times->size()];
}

void program_function::report(program_news news) {
  auto event = whose_.about;
  event.at = now_;
  event.what = news.is_there ? messages::event_type::program_back
                             : messages::event_type::program_lost;
  event.detail = std::move(news.why);
  if (whose_.report)
    whose_.report(std::move(event));
}

} // namespace sofof::actors
