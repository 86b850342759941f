// Lining up figures.
#include "recording/table.hpp"

#include "base/text/terminal_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof {

namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t label_width = 17;
constexpr std::size_t least_column_width = 18;
constexpr std::size_t column_gap = 2;
constexpr std::size_t drive_label_width = 24;
constexpr std::size_t drive_column_width = 14;

/// What a reader sees of an absent figure.
constexpr auto absent = "-";

std::string with_unit(std::optional<double> x, int places,
                      std::string_view unit) {
  return x ? fmt::format("{:.{}f} {}", *x, places, unit) : absent;
}

std::string in_s(std::optional<double> x) {
  return with_unit(x, 2, "s");
}
std::string in_ms(std::optional<double> x) {
  return with_unit(x, 2, "ms");
}

std::string mean_and_deviation(const statistics& ms) {
  if (!ms.deviation())
    return in_ms(ms.mean());
  return fmt::format("{:.2f} ± {:.2f} ms", *ms.mean(), *ms.deviation());
}

/// Figures in lines, a column for each kind of service.
class block {
public:
  explicit block(std::span<const service_metrics> services)
      : services_{services} {}

  /// A heading, and the names of the services.
  void names(std::string_view heading) {
    add({std::string{heading}, true, {}},
        [](const auto& x) { return x.kind.view(); });
  }

  /// @param of  Gives a service's figure, as a number or as text.
  template <class Figure>
  void row(std::string_view label, Figure of) {
    add({fmt::format("  {}", label), false, {}}, of);
  }

  void endings(end_counts service_metrics::*of) {
    lines_.push_back({"  ended by", false, {}});
    for (std::size_t i = 0; i < end_reason_count; ++i) {
      const auto count = [i, of](const auto& x) { return (x.*of)[i]; };
      if (std::ranges::any_of(services_, count))
        row(fmt::format("  {}", name_of(static_cast<end_reason>(i))), count);
    }
  }

  /// Whose results were refused, by check.
  void refusals() {
    std::set<std::pair<std::string, std::string>> all;
    for (const auto& service : services_)
      for (const auto& [provider, checks] : service.implausible)
        for (const auto& [check, count] : checks)
          all.emplace(provider, check);
    for (const auto& [provider, check] : all)
      row(fmt::format("    {}: {}", provider, check),
          [&](const service_metrics& x) -> std::uint64_t {
            const auto of = x.implausible.find(provider);
            if (of == x.implausible.end())
              return 0;
            const auto count = of->second.find(check);
            return count == of->second.end() ? 0 : count->second;
          });
  }

  void running() {
    if (std::ranges::any_of(services_, &service_metrics::running_at_end))
      row("  still running", &service_metrics::running_at_end);
  }

  /// Appends it, as many columns side by side as fit into a line.
  void print(std::string& out, const terminal_style& paint) const {
    for (std::size_t first = 0; first < services_.size();) {
      auto used = label_width + width(first);
      auto end = first + 1;
      while (end < services_.size() && used + width(end) <= line_width)
        used += width(end++);
      print(out, paint, first, end);
      first = end;
    }
  }

private:
  struct line {
    std::string label;
    bool is_heading = false;
    std::vector<std::string> figures; ///< One per service, or none.
  };

  template <class Figure>
  void add(line made, Figure of) {
    for (const auto& service : services_)
      made.figures.push_back(fmt::format("{}", std::invoke(of, service)));
    lines_.push_back(std::move(made));
  }

  /// @returns that of a column, its gap included.
  std::size_t width(std::size_t column) const {
    auto widest = least_column_width;
    for (const auto& line : lines_)
      if (!line.figures.empty())
        widest = std::max(widest, column_gap + width_of(line.figures[column]));
    return widest;
  }

  void print(std::string& out, const terminal_style& paint, std::size_t first,
             std::size_t end) const {
    for (const auto& line : lines_) {
      auto text = line.label;
      if (!line.figures.empty())
        text = fmt::format("{:<{}}", text, label_width);
      for (auto i = first; i < end && !line.figures.empty(); ++i)
        text += fmt::format("{:>{}}", line.figures[i], width(i));
      out += line.is_heading ? '\n' + paint.heading(text) : text;
      out += '\n';
    }
  }

  std::span<const service_metrics> services_;
  std::vector<line> lines_;
};

void offloading(block& to, const run_info& run, const run_end& end) {
  using service = service_metrics;
  to.names("offloading");
  to.row("requests", &service::requests);
  to.row("accepted", &service::accepted);
  to.row("rejected", &service::rejected);
  to.row("no data", &service::no_data);
  to.row("episodes", &service::episodes);
  to.endings(&service::ended_by);
  to.refusals();
  to.running();
  to.row("fallbacks", &service::fallbacks);
  to.row("t_off mean", [](const service& x) { return in_s(x.t_off_s.mean()); });
  to.row("t_off max", [](const service& x) { return in_s(x.t_off_s.max()); });
  to.row("offloaded share", [&](const service& x) {
    const auto share = x.offloaded_share(run.vehicles, end.virtual_s);
    return with_unit(share ? std::optional{100 * *share} : share, 1, "%");
  });
}

void remote_results(block& to) {
  using service = service_metrics;
  to.names("remote results");
  to.row("received", [](const service& x) { return x.latency.ms().count(); });
  to.row("used", &service::results_used);
  to.row("latency",
         [](const service& x) { return mean_and_deviation(x.latency.ms()); });
  to.row("  p50",
         [](const service& x) { return in_ms(x.latency.quantile_ms(0.5)); });
  to.row("  p99",
         [](const service& x) { return in_ms(x.latency.quantile_ms(0.99)); });
  to.row("  max", [](const service& x) { return in_ms(x.latency.ms().max()); });
  to.row("inter-arrival",
         [](const service& x) { return in_ms(x.interarrival.ms().mean()); });
  to.row("  p99", [](const service& x) {
    return in_ms(x.interarrival.quantile_ms(0.99));
  });
  to.row("  max",
         [](const service& x) { return in_ms(x.interarrival.ms().max()); });
}

/// What a process has to say that only provides.
void providing(block& to) {
  using service = service_metrics;
  to.names("providing");
  to.row("services run", [](const service& x) { return x.served_s.count(); });
  to.endings(&service::served_until);
  to.row("time mean", [](const service& x) { return in_s(x.served_s.mean()); });
  to.row("time max", [](const service& x) { return in_s(x.served_s.max()); });
}

void drive_line(std::string& out, std::string_view label,
                const std::string& figure, const std::string& verdict = {}) {
  out += fmt::format("  {:<{}}{:>{}}{}\n", label, drive_label_width, figure,
                     drive_column_width, verdict);
}

void safety_lines(std::string& out, const terminal_style& paint,
                  const safety_metrics& safety) {
  out += '\n' + paint.heading("safety") + '\n';
  if (safety.driven == duration::zero()) {
    out += "  not recorded\n";
    return;
  }
  const auto line = [&](std::string_view label, const std::string& figure,
                        bool ok) {
    drive_line(out, label, figure,
               "   " + (ok ? paint.good("ok") : paint.bad("VIOLATED")));
  };
  const auto none = duration::zero();
  const auto time = [&](std::string_view label, duration d) {
    line(label, with_unit(to_seconds(d), 3, "s"), d == none);
  };
  time("without a fresh plan", safety.without_fresh_plan);
  time("off the road", safety.off_road);
  line("collisions", fmt::format("{}", safety.collisions),
       safety.collisions == 0);
  drive_line(out, "oldest plan in use",
             with_unit(to_seconds(safety.max_plan_age), 3, "s"));
}

void comfort_lines(std::string& out, const terminal_style& paint,
                   const drive_metrics& drive) {
  if (drive.safety.driven == duration::zero())
    return;
  out += '\n' + paint.heading("comfort") + '\n';
  const auto& ride = drive.ride;
  drive_line(out, "lateral acceleration",
             with_unit(ride.extremes.lateral_accel_mps2, 2, "m/s²"));
  drive_line(out, "jerk", with_unit(ride.extremes.jerk_mps3, 2, "m/s³"));
  drive_line(out, "hard brakes", fmt::format("{}", ride.hard_brakes));
  drive_line(out, "emergency plans", fmt::format("{}", drive.plans.emergency));
}

void energy_lines(std::string& out, const terminal_style& paint,
                  const cycle_figures& cycles, double distance_m) {
  constexpr auto m_per_km = 1e3;
  if (cycles.all_on_board_j <= 0)
    return;
  out += '\n' + paint.heading("energy of planning in the vehicles") + '\n';
  drive_line(out, "all together", with_unit(cycles.energy_j(), 1, "J"));
  if (distance_m > 0)
    drive_line(out, "per km",
               with_unit(cycles.energy_j() * m_per_km / distance_m, 1, "J"));
  drive_line(out, "saved by offloading",
             with_unit(100 * *cycles.saved_share(), 1, "%"));
}

std::uint64_t messages_of(const air_metrics& air) {
  return air.cam.messages + air.cpm.messages + air.mcm_up.messages
         + air.mcm_down.messages;
}

void air_lines(std::string& out, const terminal_style& paint,
               const air_metrics& air) {
  if (messages_of(air) == 0)
    return;
  const auto line = [](std::string_view label, std::string_view messages,
                       std::string_view octets) {
    return fmt::format("{:<{}}{:>{}}{:>{}}", label, drive_label_width + 2,
                       messages, drive_column_width, octets,
                       drive_column_width);
  };
  out += '\n' + paint.heading(line("on the air", "messages", "mean octets"))
         + '\n';
  const auto count = [&](std::string_view label, const air_count& x) {
    const auto mean = x.mean_octets();
    out += line(label, fmt::format("{}", x.messages),
                mean ? fmt::format("{:.1f}", *mean) : absent)
           + '\n';
  };
  count("  CAM", air.cam);
  count("  CPM", air.cpm);
  count("  MCM up", air.mcm_up);
  count("  MCM down", air.mcm_down);
}

} // namespace

std::string table(const metrics& m, const run_info& run, const run_end& end,
                  const std::filesystem::path& folder, bool colour) {
  const terminal_style paint{colour};
  std::string out;
  out += paint.heading(fmt::format("{}, seed {}", run.scenario, run.seed));
  out += fmt::format("   (sofof {})\n", run.version);
  if (end.interrupted)
    out += "  " + paint.bad("INTERRUPTED, figures up to here") + '\n';
  if (run.provider.empty())
    out += fmt::format("  {} vehicle{}", run.vehicles,
                       run.vehicles == 1 ? "" : "s");
  else
    out += fmt::format("  provider {}", run.provider);
  out += fmt::format(" for {:.1f} s in {:.1f} s", end.virtual_s, end.wall_s);
  if (const auto speed = end.x_real_time())
    out += fmt::format(", {:.1f} x real time", *speed);
  if (run.provider.empty())
    out += fmt::format("; {} offer{}", m.offers(), m.offers() == 1 ? "" : "s");
  out += '\n';
  out += fmt::format("  {} clock, channel {}, LODM {}, CODM {}\n", run.clock,
                     run.profile, run.lodm, run.codm);

  block services{m.services()};
  if (run.provider.empty()) {
    offloading(services, run, end);
    remote_results(services);
  } else {
    providing(services);
  }
  services.print(out, paint);
  if (run.provider.empty()) {
    safety_lines(out, paint, m.safety());
    comfort_lines(out, paint, m.together());
    energy_lines(out, paint, m.cycles(), m.together().ride.distance_m);
  }
  air_lines(out, paint, m.air());
  if (folder.empty())
    return out;
  out += fmt::format("\nresults in {}\n", folder.string());
  if (!run.pcap.empty())
    out += fmt::format("{} message{} in {}\n", messages_of(m.air()),
                       messages_of(m.air()) == 1 ? "" : "s", run.pcap);
  return out;
}

} // namespace sofof
