// Every record is written, then counted.
#include "recording/results.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

namespace sofof::recording {

namespace {

constexpr int jump_places = 6;

/// What of a record stands in events.jsonl besides events.
template <class Record>
std::optional<messages::event_record> event_of(const Record&) {
  return std::nullopt;
}

std::optional<messages::event_record>
event_of(const messages::collision_record& x) {
  return messages::event_record{.at = x.at,
                                .what = messages::event_type::collision,
                                .station = x.first,
                                .detail = fmt::format("with {}", x.second)};
}

std::optional<messages::event_record>
event_of(const messages::plan_switch_record& x) {
  const auto& id = x.session;
  std::string detail = x.remote ? "remote" : "local";
  const auto figure = [&detail](std::string_view name, double value) {
    detail += name;
    append(detail, rounded(value, jump_places));
  };
  figure(" d_m=", x.jump.d_m);
  figure(" kappa_1pm=", x.jump.curvature_1pm);
  figure(" v_mps=", x.jump.speed_mps);
  figure(" a_mps2=", x.jump.accel_mps2);
  return messages::event_record{.at = x.at,
                                .what = messages::event_type::plan_switch,
                                .station = id.station,
                                .provider = id.provider,
                                .service = id.service,
                                .counter = id.counter,
                                .detail = std::move(detail)};
}

} // namespace

results::results(std::filesystem::path folder, run_info run)
    : run_{std::move(run)}, metrics_{run_}, ledger_{run_.chain},
      files_{std::in_place, std::move(folder), run_} {}

results::results(run_info run)
    : run_{std::move(run)}, metrics_{run_}, ledger_{run_.chain} {}

void results::on_record(const messages::record& x) {
  if (auto line = std::visit([](const auto& r) { return event_of(r); }, x))
    keep(std::move(*line));
  keep(x);
  std::visit([this](const auto& r) { follow(r); }, x);
}

void results::follow(const messages::stage_record& x) {
  std::vector<messages::response_record> known;
  ledger_.add(x, known);
  for (const auto& response : known)
    keep(response);
}

void results::keep(const messages::record& x) {
  if (files_)
    files_->on_record(x);
  metrics_.on_record(x);
}

void results::add_timing(std::string name, double value) {
  of_clock_.timings.push_back({std::move(name), value});
}

void results::add_cpu(const cpu_table& x) {
  of_clock_.cpu_csv = to_csv(x);
}

void results::add_disturbed(std::span<const disturbed_messages> all,
                            time_point until) {
  if (files_)
    files_->write(all);
  metrics_.add(all, until);
}

void results::flush() {
  if (files_)
    files_->flush();
}

run_end results::finish(time_point end, double wall_s, bool interrupted,
                        standstill stood_still) {
  const run_end outcome{to_seconds(end - run_.start), wall_s, interrupted,
                        stood_still};
  std::vector<messages::response_record> rest;
  ledger_.finish(rest);
  for (const auto& response : rest)
    keep(response);
  metrics_.finish(end);
  if (files_ && !quality_csv_.empty())
    files_->write_quality(quality_csv_);
  if (files_)
    files_->finish(metrics_, run_, outcome, of_clock_);
  return outcome;
}

} // namespace sofof::recording
