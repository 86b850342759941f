// One line per record.
#include "recording/result_files.hpp"

#include "base/text/json.hpp"
#include "recording/results_folder.hpp"
#include "recording/summary.hpp"

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
constexpr std::string_view margins_header =
    "station,provider,provider_id,service,counter,cycle,received_s,margin,left";
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
constexpr int margin_places = 4;
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

result_files::result_files(std::filesystem::path folder, const run_info& run)
    : pcap_{capture_of(run)}, folder_{cleared(std::move(folder))},
      start_{run.start}, names_{run.provider_names},
      episodes_{folder_ / "episodes.csv", episodes_header},
      events_{folder_ / "events.jsonl"} {
  if (run.cycles)
    cycles_.emplace(folder_ / "cycles.csv", cycles_header);
  if (run.tracks)
    tracks_.emplace(folder_ / "tracks.csv", tracks_header);
  if (run.margins)
    margins_.emplace(folder_ / "margins.csv", margins_header);
  if (!run.map_toml.empty())
    write_file(folder_ / "map.toml", run.map_toml);
  if (!run.trace_text.empty())
    write_file(folder_ / "trace.txt", run.trace_text);
  write_file(folder_ / "config.toml", run.config_toml);
}

void result_files::on_record(const record& x) {
  std::visit([this](const auto& which) { write(which); }, x);
}

void result_files::write(const event_record& x) {
  auto& out = events_.text();
  {
    json_object line{out, json_object::layout::one_line};
    line.member("t_s", seconds(x.at - start_));
    line.member("what", sofof::name_of(x.what));
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

void result_files::write(const cycle_record& x) {
  const auto& id = x.running;
  if (margins_)
    for (const auto& margin : x.margins)
      margins_->row(id.station, name_of(id.provider), id.provider,
                    id.kind.view(), id.counter, x.cycle,
                    seconds(x.received - start_), margin.name,
                    rounded(margin.left, margin_places));
  if (!cycles_)
    return;
  cycles_->row(
      id.station, name_of(id.provider), id.provider, id.kind.view(), id.counter,
      x.cycle, seconds(x.created - start_), seconds(x.received - start_),
      milliseconds(x.received - x.created), milliseconds(x.interarrival),
      x.used, x.doubt > duration{} ? milliseconds(x.doubt) : decimal{});
}

void result_files::write(const episode_record& x) {
  const auto& id = x.running;
  const auto requester = x.of == side::requester;
  const auto if_data = [switched = requester && x.got_data](duration d) {
    return switched ? seconds(d) : decimal{};
  };
  episodes_.row(std::string_view{requester ? "requester" : "provider"},
                id.station, name_of(id.provider), id.provider, id.kind.view(),
                id.counter, seconds(x.accepted - start_),
                if_data(x.first_data - start_), seconds(x.ended - start_),
                if_data(x.ended - x.first_data), sofof::name_of(x.reason),
                x.fallback);
}

void result_files::write(const track_record& x) {
  if (!tracks_)
    return;
  const auto& own = x.ego.own;
  tracks_->row(seconds(x.at - start_), own.station,
               rounded(own.position.x_m, length_places),
               rounded(own.position.y_m, length_places),
               rounded(own.heading_rad, angle_places),
               rounded(own.speed_mps, length_places),
               rounded(own.accel_mps2, length_places),
               rounded(x.ego.s_m, length_places),
               rounded(x.lateral_m, length_places), milliseconds(x.plan_age),
               std::string_view{x.remote ? "remote" : "local"});
}

void result_files::write(const air_record& x) {
  if (pcap_)
    pcap_->write(x);
}

void result_files::flush() {
  episodes_.flush();
  if (cycles_)
    cycles_->flush();
  if (tracks_)
    tracks_->flush();
  if (margins_)
    margins_->flush();
  events_.flush();
  if (pcap_)
    pcap_->flush();
}

void result_files::finish(const metrics& all, const run_info& run,
                          const run_end& end, const figures_of_clock& clock) {
  episodes_.close();
  if (cycles_)
    cycles_->close();
  if (tracks_)
    tracks_->close();
  if (margins_)
    margins_->close();
  events_.close();
  if (pcap_)
    pcap_->close();
  write_vehicles(all);
  write_distributions(all);
  write_timing(end, clock.timings);
  if (!clock.cpu_csv.empty())
    write_file(folder_ / "cpu.csv", clock.cpu_csv);
  write_file(folder_ / "summary.json", summary_json(all, run, end));
}

std::string_view result_files::name_of(provider_id provider) const {
  return sofof::name_of(provider, names_);
}

void result_files::write_vehicles(const metrics& all) const {
  csv_file file{folder_ / "vehicles.csv", vehicles_header};
  for (const auto& [station, x] : all.vehicles()) {
    const auto cycles = all.cycles(station);
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

void result_files::write_distributions(const metrics& all) const {
  csv_file file{folder_ / "distributions.csv", distributions_header};
  const auto rows = [&file](const service_name& kind, std::string_view figure,
                            const distribution& x) {
    for (const auto& bin : x.bins(distribution_width))
      file.row(kind.view(), figure, rounded(bin.up_to_ms, length_places),
               bin.count);
  };
  for (const auto& service : all.services()) {
    rows(service.kind, "latency", service.latency);
    rows(service.kind, "interarrival", service.interarrival);
  }
  file.close();
}

void result_files::write_timing(const run_end& end,
                                const std::vector<timing>& timings) const {
  std::string text = "figure,value\n";
  const auto line = [&text](std::string_view name, std::optional<double> x) {
    append(text, name);
    text += ',';
    append(text, rounded(x, timing_places));
    text += '\n';
  };
  line("wall_s", end.wall_s);
  line("x_real_time", end.x_real_time());
  for (const auto& figure : timings)
    line(figure.name, figure.value);
  write_file(folder_ / "timing.csv", text);
}

} // namespace sofof
