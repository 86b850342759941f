// One line per record.
#include "scenario/results.hpp"

#include "scenario/json.hpp"
#include "scenario/results_folder.hpp"
#include "scenario/summary.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace sofof {

namespace {

constexpr std::string_view episodes_header =
    "side,station,provider,provider_id,service,counter,accepted_s,"
    "first_data_s,ended_s,t_off_s,reason,fallback";
constexpr std::string_view cycles_header =
    "station,provider,provider_id,service,counter,cycle,created_s,received_s,"
    "latency_ms,interarrival_ms,used,doubt_ms";
constexpr std::string_view tracks_header =
    "t_s,station,x_m,y_m,heading_rad,speed_mps,accel_mps2,s_m,lateral_m,"
    "plan_age_ms,source";
constexpr std::string_view vehicles_header =
    "station,driven_s,distance_m,without_fresh_plan_s,off_road_s,collisions,"
    "max_plan_age_ms,plans,emergency_plans,kept_plans,stop_plans,"
    "imperfect_plans,safe_stops,min_accel_mps2,max_jerk_mps3,"
    "max_lateral_accel_mps2,hard_brakes,comfort_cost_m2ps3,on_board_cycles,"
    "offloaded_cycles,energy_j,all_on_board_j";
constexpr std::string_view distributions_header =
    "service,figure,up_to_ms,count";
constexpr duration distribution_width = std::chrono::microseconds{100};

constexpr int length_places = 3;
constexpr int angle_places = 6;
constexpr int comfort_places = 6;
constexpr int timing_places = 6;
constexpr int places_of_energy = 6;

std::optional<pcap_file> capture_of(const run_info& run) {
  if (run.pcap.empty())
    return std::nullopt;
  return std::optional<pcap_file>{std::in_place, run.pcap, run.time_of_day};
}

/// Makes room for the files of a run, before the first one is opened.
std::filesystem::path cleared(std::filesystem::path folder) {
  remove_results(folder);
  return folder;
}

} // namespace

results::results(std::filesystem::path folder, run_info run)
    : pcap_{capture_of(run)}, folder_{cleared(std::move(folder))},
      run_{std::move(run)}, metrics_{run_},
      names_(run_.provider_names.begin(), run_.provider_names.end()),
      episodes_{folder_ / "episodes.csv", episodes_header},
      events_{folder_ / "events.jsonl"} {
  if (run_.cycles)
    cycles_.emplace(folder_ / "cycles.csv", cycles_header);
  if (run_.tracks)
    tracks_.emplace(folder_ / "tracks.csv", tracks_header);
  if (!run_.map_toml.empty())
    write_file(folder_ / "map.toml", run_.map_toml);
  if (!run_.trace_text.empty())
    write_file(folder_ / "trace.txt", run_.trace_text);
  write_file(folder_ / "config.toml", run_.config_toml);
}

void results::take(const event_record& x) {
  metrics_.take(x);
  auto& out = events_.text();
  {
    json_object line{out, json_object::layout::one_line};
    line.member("t_s", seconds(x.at - run_.start));
    line.member("what", x.what);
    line.member("station", x.station);
    line.member("provider", name_of(x.provider));
    line.member("provider_id", x.provider);
    line.member("service", x.kind.view());
    line.member("counter", x.counter);
    line.member("detail", x.detail);
  }
  out += '\n';
  events_.end_line();
}

void results::take(const decision_record& x) {
  metrics_.take(x);
}

void results::take(const cycle_record& x) {
  metrics_.take(x);
  if (!cycles_)
    return;
  const auto& id = x.running;
  cycles_->row(id.station, name_of(id.provider), id.provider, id.kind.view(),
               id.counter, x.cycle, seconds(x.created - run_.start),
               seconds(x.received - run_.start),
               milliseconds(x.received - x.created),
               milliseconds(x.interarrival), x.used,
               x.doubt > duration{} ? milliseconds(x.doubt) : decimal{});
}

void results::take(const episode_record& x) {
  metrics_.take(x);
  const auto& id = x.running;
  const auto requester = x.of == side::requester;
  const auto if_data = [switched = requester && x.got_data](duration d) {
    return switched ? seconds(d) : decimal{};
  };
  episodes_.row(std::string_view{requester ? "requester" : "provider"},
                id.station, name_of(id.provider), id.provider, id.kind.view(),
                id.counter, seconds(x.accepted - run_.start),
                if_data(x.first_data - run_.start),
                seconds(x.ended - run_.start), if_data(x.ended - x.first_data),
                sofof::name_of(x.reason), x.fallback);
}

void results::take(const track_record& x) {
  if (!tracks_)
    return;
  const auto& own = x.ego.own;
  tracks_->row(seconds(x.at - run_.start), own.station,
               rounded(own.position.x_m, length_places),
               rounded(own.position.y_m, length_places),
               rounded(own.heading_rad, angle_places),
               rounded(own.speed_mps, length_places),
               rounded(own.accel_mps2, length_places),
               rounded(x.ego.s_m, length_places),
               rounded(x.lateral_m, length_places), milliseconds(x.plan_age),
               std::string_view{x.remote ? "remote" : "local"});
}

void results::take(const air_record& x) {
  metrics_.take(x);
  if (pcap_)
    pcap_->write(x);
}

void results::take(const safety_record& x) {
  metrics_.take(x);
}

void results::take(const collision_record& x) {
  metrics_.take(x);
  take(event_record{x.at, "collision", x.first, 0, "", 0,
                    fmt::format("with {}", x.second)});
}

void results::take(const drive_record& x) {
  metrics_.take(x);
}

void results::take(const plan_switch_record& x) {
  metrics_.take(x);
  const auto& id = x.running;
  std::string detail = x.remote ? "remote" : "local";
  const auto figure = [&detail](std::string_view name, double value) {
    detail += name;
    append(detail, rounded(value, comfort_places));
  };
  figure(" d_m=", x.jump.d_m);
  figure(" kappa_1pm=", x.jump.curvature_1pm);
  figure(" v_mps=", x.jump.speed_mps);
  figure(" a_mps2=", x.jump.accel_mps2);
  take(event_record{x.at, "plan_switch", id.station, id.provider, id.kind,
                    id.counter, std::move(detail)});
}

void results::take_timing(std::string name, double value) {
  timings_.push_back({std::move(name), value});
}

void results::take(const cpu_table& x) {
  cpu_csv_ = to_csv(x);
}

void results::flush() {
  episodes_.flush();
  if (cycles_)
    cycles_->flush();
  if (tracks_)
    tracks_->flush();
  events_.flush();
  if (pcap_)
    pcap_->flush();
}

run_end results::finish(time_point end, double wall_s, bool interrupted) {
  const run_end outcome{to_seconds(end - run_.start), wall_s, interrupted};
  metrics_.finish(end);
  episodes_.close();
  if (cycles_)
    cycles_->close();
  if (tracks_)
    tracks_->close();
  events_.close();
  if (pcap_)
    pcap_->close();
  write_vehicles();
  write_distributions();
  write_timing(outcome);
  if (!cpu_csv_.empty())
    write_file(folder_ / "cpu.csv", cpu_csv_);
  write_file(folder_ / "summary.json", summary_json(metrics_, run_, outcome));
  return outcome;
}

std::string_view results::name_of(boot_id provider) const {
  auto found = names_.find(provider);
  if (found == names_.end()) // of a process of its own
    found = names_.find(place_of(provider));
  return found != names_.end() ? std::string_view{found->second} : "";
}

void results::write_vehicles() const {
  csv_file file{folder_ / "vehicles.csv", vehicles_header};
  for (const auto& [station, x] : metrics_.vehicles()) {
    const auto cycles = metrics_.cycles(station);
    file.row(station, seconds(x.safety.driven),
             rounded(x.ride.distance_m, length_places),
             seconds(x.safety.without_fresh_plan), seconds(x.safety.off_road),
             x.safety.collisions, milliseconds(x.safety.max_plan_age),
             x.plans.count, x.plans.emergency, x.plans.kept, x.plans.stops,
             x.plans.imperfect, x.plans.safe_stops,
             rounded(x.ride.extremes.min_accel_mps2, comfort_places),
             rounded(x.ride.extremes.jerk_mps3, comfort_places),
             rounded(x.ride.extremes.lateral_accel_mps2, comfort_places),
             x.ride.hard_brakes,
             rounded(x.ride.comfort_cost_m2ps3, comfort_places),
             cycles.on_board, cycles.offloaded,
             rounded(cycles.energy_j(), places_of_energy),
             rounded(cycles.all_on_board_j, places_of_energy));
  }
  file.close();
}

void results::write_distributions() const {
  csv_file file{folder_ / "distributions.csv", distributions_header};
  const auto rows = [&file](const service_name& kind, std::string_view figure,
                            const distribution& x) {
    for (const auto& bin : x.bins(distribution_width))
      file.row(kind.view(), figure, rounded(bin.up_to_ms, length_places),
               bin.count);
  };
  for (const auto& service : metrics_.services()) {
    rows(service.kind, "latency", service.latency);
    rows(service.kind, "interarrival", service.interarrival);
  }
  file.close();
}

void results::write_timing(const run_end& end) const {
  std::string text = "figure,value\n";
  const auto line = [&text](std::string_view name, std::optional<double> x) {
    append(text, name);
    text += ',';
    append(text, rounded(x, timing_places));
    text += '\n';
  };
  line("wall_s", end.wall_s);
  line("x_real_time", end.x_real_time());
  for (const auto& figure : timings_)
    line(figure.name, figure.value);
  write_file(folder_ / "timing.csv", text);
}

} // namespace sofof
