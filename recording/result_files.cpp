// One line per record.
#include "recording/result_files.hpp"

#include "base/text/json.hpp"
#include "recording/results_folder.hpp"
#include "recording/summary.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace sofof::recording {

namespace {

constexpr duration distribution_width = std::chrono::microseconds{100};

constexpr int timing_places = 6;

/// What pictures of plans need: docs/results.md.
constexpr duration plans_period = std::chrono::milliseconds{200};
constexpr duration plan_step = std::chrono::milliseconds{500};

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

/// @param file  May be in a folder that is to be made.
void write_policy_file(const std::filesystem::path& file,
                       const policy_copy& copy) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  write_file(file, copy.text); // which says what is wrong
  if (copy.is_executable)
    fs::permissions(file,
                    fs::perms::owner_exec | fs::perms::group_exec
                        | fs::perms::others_exec,
                    fs::perm_options::add, error);
}

} // namespace

result_files::result_files(std::filesystem::path folder, const run_info& run)
    : pcap_{capture_of(run)}, folder_{cleared(std::move(folder))},
      start_{run.start}, names_{run.provider_names},
      episodes_{folder_ / "episodes.csv", columns::of_episodes},
      disturbed_{folder_ / "disturbed.csv", columns::of_disturbed},
      events_{folder_ / "events.jsonl"} {
  if (run.cycles)
    cycles_.emplace(folder_ / "cycles.csv", columns::of_cycles);
  if (run.tracks)
    tracks_.emplace(folder_ / "tracks.csv", columns::of_tracks);
  if (run.margins)
    margins_.emplace(folder_ / "margins.csv", columns::of_margins);
  if (run.plans)
    plans_.emplace(folder_ / "plans.csv", columns::of_plans);
  if (run.trace)
    trace_.emplace(folder_ / "protocol_trace.csv", columns::of_trace);
  if (!run.map_toml.empty())
    write_file(folder_ / "map.toml", run.map_toml);
  for (const auto& [name, text] : run.provider_maps)
    write_file(folder_ / name, text);
  if (!run.trace_text.empty())
    write_file(folder_ / "trace.txt", run.trace_text);
  if (!run.forecast_csv.empty())
    write_file(folder_ / "forecast.csv", run.forecast_csv);
  for (const auto& [name, copy] : run.policy_files)
    write_policy_file(folder_ / name, copy);
  write_file(folder_ / "config.toml", run.config_toml);
}

void result_files::on_record(const messages::record& x) {
  std::visit([this](const auto& which) { write(which); }, x);
}

void result_files::write_quality(std::string_view csv) const {
  write_file(folder_ / "quality.csv", csv);
}

void result_files::write(const messages::event_record& x) {
  auto& out = events_.text();
  {
    json_object line{out, json_object::layout::one_line};
    line.member("t_s", seconds(x.at - start_));
    line.member("what", messages::name_of(x.what));
    line.member("station", x.station.value());
    line.member("provider", name_of(x.provider));
    line.member("provider_id", x.provider.value());
    line.member("service", x.service.view());
    line.member("counter", x.counter);
    line.member("detail", x.detail);
  }
  out += '\n';
  events_.end_line();
}

void result_files::write(const messages::cycle_record& x) {
  const auto in = context_of(x.session);
  if (margins_)
    for (const auto& margin : x.margins)
      margins_->write({x, margin, in});
  if (cycles_)
    cycles_->write({x, in});
}

void result_files::write(const messages::episode_record& x) {
  episodes_.write({x, context_of(x.session)});
}

void result_files::write(const messages::track_record& x) {
  if (tracks_)
    tracks_->write({x, {"", start_}});
  if (!plans_ || !x.plan)
    return;
  const auto period = (x.at - start_) / plans_period;
  const auto [last, is_first] = planned_.try_emplace(x.ego.own.station, period);
  if (!is_first && std::exchange(last->second, period) == period)
    return;
  for (auto t = x.at; t <= x.plan->end(); t += plan_step)
    plans_->write({x, {"", start_}, x.plan->at(t), t - x.at});
}

void result_files::write(const messages::claim_record& x) {
  if (!claims_)
    claims_.emplace(folder_ / "claims.csv", columns::of_claims);
  claims_->write({x, {"", start_}});
}

void result_files::write(const messages::scene_record& x) {
  if (!scenes_)
    scenes_.emplace(folder_ / "scene.csv", columns::of_scenes);
  scenes_->write({x, start_});
}

void result_files::write(const messages::response_record& x) {
  if (!cycles_)
    return;
  if (!responses_)
    responses_.emplace(folder_ / "responses.csv", columns::of_responses);
  responses_->write({x, names_, start_});
}

void result_files::write(const messages::air_record& x) {
  if (pcap_)
    pcap_->write(x);
}

response_row::response_row(const messages::response_record& record,
                           const provider_names& names, time_point t)
    : x{record}, split{split_of(record, names)}, start{t} {
  for (const auto& part : record.parts) {
    if (!services_ms.empty())
      services_ms += ' ';
    if (part.took)
      append(services_ms, milliseconds(part.took));
    else
      services_ms += '-';
  }
}

trace_row::trace_row(const messages::trace_record& record, time_point t)
    : x{record}, start{t} {
  for (const auto& [name, counter] : record.services)
    services += fmt::format("{}{}#{}", services.empty() ? "" : " ", name.view(),
                            counter);
}

void result_files::write(const messages::trace_record& x) {
  if (trace_)
    trace_->write({x, start_});
}

void result_files::write(std::span<const disturbed_messages> all) {
  for (const auto& x : all)
    disturbed_.write({x});
}

void result_files::flush() {
  episodes_.flush();
  disturbed_.flush();
  if (cycles_)
    cycles_->flush();
  if (tracks_)
    tracks_->flush();
  if (margins_)
    margins_->flush();
  if (plans_)
    plans_->flush();
  if (claims_)
    claims_->flush();
  if (scenes_)
    scenes_->flush();
  if (responses_)
    responses_->flush();
  if (trace_)
    trace_->flush();
  events_.flush();
  if (pcap_)
    pcap_->flush();
}

void result_files::finish(const metrics& all, const run_info& run,
                          const run_end& end, const figures_of_clock& clock) {
  episodes_.close();
  disturbed_.close();
  if (cycles_)
    cycles_->close();
  if (tracks_)
    tracks_->close();
  if (margins_)
    margins_->close();
  if (plans_)
    plans_->close();
  if (claims_)
    claims_->close();
  if (scenes_)
    scenes_->close();
  if (responses_)
    responses_->close();
  if (trace_)
    trace_->close();
  events_.close();
  if (pcap_)
    pcap_->close();
  write_vehicles(all);
  write_distributions(all);
  const auto& load = all.load();
  write_file(folder_ / "load.csv", load_csv(load, from_seconds(end.virtual_s)));
  write_file(folder_ / "octets.csv", octets_csv(load));
  if (!run.energy.costs.empty())
    write_file(folder_ / "energy.csv", to_csv(all.energy(), run.energy));
  write_timing(end, clock.timings);
  if (!clock.cpu_csv.empty())
    write_file(folder_ / "cpu.csv", clock.cpu_csv);
  write_file(folder_ / "summary.json", summary_json(all, run, end));
}

std::string_view result_files::name_of(provider_id provider) const {
  return recording::name_of(provider, names_);
}

row_context
result_files::context_of(const messages::session_id& session) const {
  return {name_of(session.provider), start_};
}

void result_files::write_vehicles(const metrics& all) const {
  csv_file<vehicle_row> file{folder_ / "vehicles.csv", columns::of_vehicles};
  for (const auto& [station, x] : all.vehicles())
    file.write({station, x, all.cycles(station), all.work().energy(station)});
  file.close();
}

void result_files::write_distributions(const metrics& all) const {
  csv_file<distribution_row> file{folder_ / "distributions.csv",
                                  columns::of_distributions};
  const auto rows = [&file](const messages::service_name& name,
                            std::string_view figure, const distribution& x) {
    for (const auto& bin : x.bins(distribution_width))
      file.write({name, figure, bin});
  };
  for (const auto& service : all.services()) {
    rows(service.service, "latency", service.latency);
    rows(service.service, "interarrival", service.interarrival);
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

} // namespace sofof::recording
