// Lining up figures.
#include "scenario/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>

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

class painter {
public:
  explicit painter(bool colour) : colour_{colour} {}

  std::string heading(std::string_view text) const { return paint("1", text); }
  std::string good(std::string_view text) const { return paint("32", text); }
  std::string bad(std::string_view text) const { return paint("1;31", text); }

private:
  /// @param style  As terminals number them (ECMA-48, SGR).
  std::string paint(std::string_view style, std::string_view text) const {
    return colour_ ? fmt::format("\x1b[{}m{}\x1b[0m", style, text)
                   : std::string{text};
  }

  bool colour_;
};

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

/// The kinds of service that stand side by side.
class block {
public:
  /// Takes as many of `services` as fit into a line, at least one.
  block(std::string& out, const painter& paint,
        std::span<const service_metrics> services)
      : out_{out}, paint_{paint} {
    auto used = label_width;
    std::size_t n = 0;
    for (; n < services.size(); ++n) {
      used += width(services[n]);
      if (n > 0 && used > line_width)
        break;
    }
    services_ = services.first(n);
  }

  std::size_t size() const { return services_.size(); }

  /// A heading, and the names of the services.
  void names(std::string_view heading) {
    std::string line = fmt::format("{:<{}}", heading, label_width);
    for (const auto& service : services_)
      line += fmt::format("{:>{}}", service.kind.view(), width(service));
    out_ += '\n' + paint_.heading(line) + '\n';
  }

  /// @param of  Gives a service's figure, as a number or as text.
  template <class Figure>
  void row(std::string_view label, Figure of) {
    out_ += fmt::format("  {:<{}}", label, label_width - 2);
    for (const auto& service : services_)
      out_ += fmt::format("{:>{}}", std::invoke(of, service), width(service));
    out_ += '\n';
  }

  void endings() {
    out_ += "  ended by\n";
    for (std::size_t i = 0; i < end_reason_count; ++i) {
      const auto count = [i](const auto& x) { return x.ended_by[i]; };
      if (std::ranges::any_of(services_, count))
        row(fmt::format("  {}", name_of(static_cast<end_reason>(i))), count);
    }
  }

  void running() {
    if (std::ranges::any_of(services_, &service_metrics::running_at_end))
      row("  still running", &service_metrics::running_at_end);
  }

private:
  static std::size_t width(const service_metrics& service) {
    return std::max(least_column_width,
                    service.kind.view().size() + column_gap);
  }

  std::string& out_;
  const painter& paint_;
  std::span<const service_metrics> services_;
};

void offloading(block& to, const run_info& run, const run_end& end) {
  using service = service_metrics;
  to.names("offloading");
  to.row("requests", &service::requests);
  to.row("accepted", &service::accepted);
  to.row("rejected", &service::rejected);
  to.row("no data", &service::no_data);
  to.row("episodes", &service::episodes);
  to.endings();
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

void drive_line(std::string& out, std::string_view label,
                const std::string& figure, const std::string& verdict = {}) {
  out += fmt::format("  {:<{}}{:>{}}{}\n", label, drive_label_width, figure,
                     drive_column_width, verdict);
}

void safety_lines(std::string& out, const painter& paint,
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

} // namespace

void comfort_lines(std::string& out, const painter& paint,
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

std::string table(const metrics& m, const run_info& run, const run_end& end,
                  const std::filesystem::path& folder, bool colour) {
  const painter paint{colour};
  std::string out;
  out += paint.heading(fmt::format("{}, seed {}", run.scenario, run.seed));
  out += fmt::format("   (sofof {})\n", run.version);
  if (end.interrupted)
    out += "  " + paint.bad("INTERRUPTED, figures up to here") + '\n';
  out += fmt::format("  {} vehicle{} for {:.1f} s in {:.1f} s", run.vehicles,
                     run.vehicles == 1 ? "" : "s", end.virtual_s, end.wall_s);
  if (const auto speed = end.x_real_time())
    out += fmt::format(", {:.1f} x real time", *speed);
  out += fmt::format("; {} offer{}\n", m.offers(), m.offers() == 1 ? "" : "s");
  out += fmt::format("  {} clock, channel {}, LODM {}, CODM {}\n", run.clock,
                     run.profile, run.lodm, run.codm);

  for (auto rest = m.services(); !rest.empty();) {
    block services{out, paint, rest};
    offloading(services, run, end);
    remote_results(services);
    rest = rest.subspan(services.size());
  }
  safety_lines(out, paint, m.safety());
  comfort_lines(out, paint, m.together());
  out += fmt::format("\nresults in {}\n", folder.string());
  return out;
}

} // namespace sofof
