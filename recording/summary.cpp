// The figures as nested objects, in the order of their table.
#include "recording/summary.hpp"

#include "base/text/csv.hpp"
#include "base/text/json.hpp"
#include "recording/figures.hpp"
#include "recording/headline.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace sofof::recording {

namespace {

constexpr int places_of_margin = 4;
constexpr int places_of_load = 6;
constexpr int places_of_full = 1;

/// Writes a figure as what it is.
class member_writer {
public:
  member_writer(json_object& to, std::string_view name, int places)
      : to_{to}, name_{name}, places_{places} {}

  void operator()(bool x) const { to_.member(name_, x); }
  void operator()(std::uint64_t x) const { to_.member(name_, x); }
  void operator()(std::optional<double> x) const {
    to_.member(name_, rounded(x, places_));
  }
  void operator()(std::optional<duration> x) const {
    to_.member(name_, x ? seconds(*x) : decimal{});
  }

private:
  json_object& to_;
  std::string_view name_;
  int places_;
};

/// Writes figures whose names begin with the same objects, `depth` characters
/// long, into the last one of these.
template <class Of>
void write(json_object& to, std::span<const figure<Of>> figures, const Of& of,
           std::size_t depth = 0) {
  while (!figures.empty()) {
    const auto& first = figures.front();
    const auto dot = first.name.find('.', depth);
    if (dot == first.name.npos) {
      std::visit(member_writer{to, first.name.substr(depth), first.places},
                 first.value(of));
      figures = figures.subspan(1);
      continue;
    }
    const auto path = first.name.substr(0, dot + 1);
    const auto end = std::ranges::find_if_not(
        figures,
        [path](std::string_view name) { return name.starts_with(path); },
        &figure<Of>::name);
    const auto count = static_cast<std::size_t>(end - figures.begin());
    auto object = to.object(first.name.substr(depth, dot - depth));
    write(object, figures.first(count), of, path.size());
    figures = figures.subspan(count);
  }
}

void endings(json_object& to, const end_counts& counts) {
  auto object = to.object("ended_by");
  for (std::size_t i = 0; i < end_reason_count; ++i)
    object.member(messages::name_of(static_cast<messages::end_reason>(i)),
                  counts[i]);
}

/// Whose results were refused, by check.
void refusals(json_object& to, const refusal_counts& counts) {
  if (counts.empty())
    return;
  auto object = to.object("implausible");
  for (const auto& [provider, checks] : counts) {
    auto of = object.object(provider);
    for (const auto& [check, count] : checks)
      of.member(check, count);
  }
}

/// How near to a refusal the used results came.
void margins_of(json_object& to, const std::map<std::string, double>& least) {
  if (least.empty())
    return;
  auto object = to.object("margin");
  for (const auto& [name, left] : least)
    object.member(name, rounded(left, places_of_margin));
}

/// What its own functions computed though results of providers were used.
void ran_along(json_object& to, const cycle_figures& cycles) {
  if (cycles.along > 0)
    to.object("warm_standby").member("cycles", cycles.along);
}

/// How busy workers and cells were.
void loads(json_object& to, const load_table& table, duration length) {
  auto all = to.object("load");
  for (auto x = table.servers.begin(); x != table.servers.end();) {
    auto of = all.object(x->provider);
    for (const auto name = x->provider;
         x != table.servers.end() && x->provider == name; ++x) {
      const auto sum = summary_of(x->of, length);
      auto what = of.object(x->what);
      what.member("jobs", sum.jobs);
      what.member("busy_share", rounded(sum.busy_share, places_of_load));
      what.member("asked_share", rounded(sum.asked_share, places_of_load));
      what.member("peak_share", rounded(sum.peak_share, places_of_load));
      what.member("full_s", rounded(sum.full_s, places_of_full));
      auto wait = what.object("wait_ms");
      wait.member("mean", rounded(sum.mean_wait_ms, places_of_load));
      wait.member("p99", rounded(sum.p99_wait_ms, places_of_load));
      wait.member("max", rounded(sum.max_wait_ms, places_of_load));
    }
  }
}

/// How late vehicles responded to what they saw, by split.
void responses(json_object& to, const response_table& table,
               const std::vector<std::string>& chain) {
  if (table.empty())
    return;
  auto all = to.object("response");
  for (const auto& [split, x] : table) {
    auto of = all.object(split);
    of.member("looks", x.all.ms().count());
    of.member("skipped", x.skipped);
    of.member("p50_ms", rounded(x.all.quantile_ms(0.5), places_of_load));
    of.member("p99_ms", rounded(x.all.quantile_ms(0.99), places_of_load));
    of.member("max_ms", rounded(x.all.ms().max(), places_of_load));
    of.member("predicted_p99_ms",
              rounded(x.predicted_p99_ms.mean(), places_of_load));
    auto mean = of.object("mean_ms");
    const auto part = [&mean](std::string_view name, const statistics& s) {
      const auto mean_s = s.mean();
      mean.member(name, rounded(mean_s ? std::optional{1e3 * *mean_s} : mean_s,
                                places_of_load));
    };
    part("waited", x.waited_s);
    for (std::size_t k = 0; k < x.services_s.size(); ++k)
      part(chain[k], x.services_s[k]);
    part("control", x.control_s);
  }
}

/// What each split of each chain took and saved, all vehicles together.
void splits(json_object& to, const energy_table& table, const run_info& run) {
  constexpr int nj_places = 9, w_places = 6, m_places = 3;
  if (table.splits.empty())
    return;
  auto all = to.object("splits");
  for (std::size_t c = 0; c < run.energy.chains.size(); ++c) {
    auto chain = all.object(run.energy.chains[c].back());
    for (const auto& [which, x] : table.splits) {
      if (which.first != c)
        continue;
      const auto energy = [](std::int64_t nj) {
        return decimal{nj, nj_places};
      };
      auto of = chain.object(name_of(which.second));
      of.member("driven_s", seconds(x.driven));
      of.member("distance_m", rounded(x.distance_m, m_places));
      of.member("vehicle_j", energy(x.spent.vehicle_nj()));
      of.member("radio_j", energy(x.spent.radio_nj()));
      of.member("server_j", energy(x.spent.server_nj()));
      of.member("home_j", energy(x.home_nj));
      of.member("saved_j", energy(x.saved_nj()));
      of.member("saved_per_km_j", rounded(x.saved_j_per_km(), w_places));
      of.member("break_even_w", rounded(x.break_even_w(), w_places));
    }
  }
}

/// The provider's view.
void served(json_object& to, const service_in_run& x) {
  constexpr std::string_view path = "served.";
  auto object = to.object(path.substr(0, path.size() - 1));
  write(object, served_figures(), x, path.size());
  endings(object, x.of.served_until);
}

} // namespace

std::string summary_json(const metrics& m, const run_info& run,
                         const run_end& end) {
  std::string text;
  {
    json_object top{text, json_object::layout::lines};
    top.member("version", run.version);
    top.member("scenario", run.scenario);
    top.member("clock", run.clock);
    top.member("start_unix_ms",
               decimal{std::chrono::floor<std::chrono::milliseconds>(
                           run.time_of_day.unix_time(run.start))
                           .count()});
    top.member("profile", run.profile);
    top.member("lodm", run.lodm);
    top.member("codm", run.codm);
    top.member("seed", decimal{run.seed});
    if (run.provider.empty()) {
      const auto said = headline_of(m, run, end);
      auto object = top.object("headline");
      object.member("offloading", said.offloading);
      object.member("safety", said.safety);
      object.member("load", said.load);
    }
    const whole_run whole{m, run, end};
    write(top, run_figures(), whole);
    write(top, service_figures(), {m.headline(), m, run, end});
    write(top, vehicle_figures(), whole);
    write(top, run_cost_figures(), whole);
    endings(top, m.headline().ended_by);
    {
      auto services = top.object("services");
      for (const auto& service : m.services()) {
        auto object = services.object(service.service.view());
        const service_in_run x{service, m, run, end};
        write(object, service_figures(), x);
        endings(object, service.ended_by);
        refusals(object, service.implausible);
        margins_of(object, service.margins);
        served(object, x);
        write(object, service_cost_figures(), x);
        ran_along(object, m.work().cycles(service.service));
      }
    }
    responses(top, m.responses(), run.chain);
    splits(top, m.energy(), run);
    loads(top, m.load(), from_seconds(end.virtual_s));
    write(top, clock_figures(), whole);
  }
  text += '\n';
  return text;
}

} // namespace sofof::recording
