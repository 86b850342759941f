// Lining up figures.
#include "recording/console_summary.hpp"

#include "base/overloaded.hpp"
#include "base/text/terminal_style.hpp"
#include "base/text/wrapped.hpp"
#include "recording/figures.hpp"
#include "recording/headline.hpp"
#include "recording/safety_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::recording {

namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t label_width = 17;
constexpr std::size_t least_column_width = 18;
constexpr std::size_t column_gap = 2;
constexpr std::size_t drive_label_width = 24;
constexpr std::size_t drive_column_width = 14;
constexpr std::size_t narrow_column_width = 13;
constexpr std::size_t most_load_lines = 9;

/// What a reader sees of an absent figure.
constexpr auto absent = "-";

/// @returns a figure as the console shows it; nothing where there is none.
template <class Of>
std::optional<std::string> shown(const figure<Of>& x, const Of& of) {
  const auto& as = x.console;
  if (as.text)
    return as.text(of);
  const auto number = [&as](double value) {
    return fmt::format("{:.{}f} {}", as.scale * value, as.decimals, as.unit);
  };
  using text = std::optional<std::string>;
  return std::visit(
      overloaded{[](auto count) { return text{fmt::format("{}", count)}; },
                 [&](std::optional<double> value) {
                   return value ? text{number(*value)} : std::nullopt;
                 },
                 [&](std::optional<duration> value) {
                   return value ? text{number(to_seconds(*value))}
                                : std::nullopt;
                 }},
      x.value(of));
}

/// @returns those of a block, in their order.
template <class Of>
std::vector<const figure<Of>*> in_block(std::span<const figure<Of>> all,
                                        console_block block) {
  std::vector<const figure<Of>*> found;
  for (const auto& x : all)
    if (x.console.in == block)
      found.push_back(&x);
  std::ranges::sort(found, {}, [](const auto* x) { return x->console.place; });
  return found;
}

/// Figures in lines, a column for each kind of service.
class block {
public:
  block(const metrics& all, const run_info& run, const run_end& end)
      : all_{all}, services_{all.services()}, run_{run}, end_{end} {}

  /// A heading, and the names of the services.
  void names(std::string_view heading) {
    add({std::string{heading}, true, {}},
        [](const auto& x) { return x.service.view(); });
  }

  /// @param of  Gives a service's figure, as a number or as text.
  template <class Figure>
  void row(std::string_view label, Figure of) {
    add({fmt::format("  {}", label), false, {}}, of);
  }

  /// The figures of a block, one under the other.
  void rows(std::span<const service_figure> all, console_block which) {
    for (const auto* x : in_block(all, which))
      row(x->console.label, [this, x](const service_metrics& service) {
        return shown(*x, {service, all_, run_, end_}).value_or(absent);
      });
  }

  void endings(end_counts service_metrics::*of) {
    lines_.push_back({"  ended by", false, {}});
    for (std::size_t i = 0; i < end_reason_count; ++i) {
      const auto count = [i, of](const auto& x) { return (x.*of)[i]; };
      if (std::ranges::any_of(services_, count))
        row(fmt::format("  {}", messages::name_of(
                                    static_cast<messages::end_reason>(i))),
            count);
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

  /// Figures of results look better where episodes ended early.
  void say_what_is_cut_off() {
    const auto ends = [](const service_metrics& x) { return !x.early.empty(); };
    if (std::ranges::any_of(services_, ends))
      lines_.push_back(
          {"  (without what would have come after an early end)", false, {}});
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

  const metrics& all_;
  std::span<const service_metrics> services_;
  const run_info& run_;
  const run_end& end_;
  std::vector<line> lines_;
};

void offloading(block& to) {
  to.names("offloading");
  to.rows(service_figures(), console_block::asked);
  to.endings(&service_metrics::ended_by);
  to.refusals();
  to.running();
  to.rows(service_figures(), console_block::offloaded);
}

void remote_results(block& to) {
  to.names("remote results");
  to.rows(service_figures(), console_block::results);
  to.say_what_is_cut_off();
}

/// What a process has to say that only provides.
void providing(block& to) {
  to.names("providing");
  to.rows(served_figures(), console_block::provided);
  to.endings(&service_metrics::served_until);
  to.rows(served_figures(), console_block::provided_time);
}

void drive_line(std::string& out, std::string_view label,
                const std::string& figure, const std::string& verdict = {}) {
  out += fmt::format("  {:<{}}{:>{}}{}\n", label, drive_label_width, figure,
                     drive_column_width, verdict);
}

/// The figures of a block, one under the other, as far as there are any.
/// @param verdict  Of a figure, for the end of its line.
template <class Verdict>
void drive_lines(std::string& out, const whole_run& x, console_block which,
                 Verdict verdict) {
  for (const auto all : {vehicle_figures(), run_cost_figures()})
    for (const auto* figure : in_block(all, which))
      if (const auto text = shown(*figure, x))
        drive_line(out, figure->console.label, *text, verdict(*figure));
}

void safety_lines(std::string& out, const terminal_style& paint,
                  const whole_run& x) {
  out += '\n' + paint.heading("safety") + '\n';
  if (x.of.safety().driven == duration::zero()) {
    out += "  not recorded\n";
    return;
  }
  drive_lines(out, x, console_block::safety, [&](const run_figure& figure) {
    const auto judged =
        std::ranges::find(safety_line, figure.name, &safety_criterion::name);
    if (judged == std::end(safety_line))
      return std::string{};
    const auto ok = judged->of(x.of.safety()) == 0;
    return "   " + (ok ? paint.good("ok") : paint.bad("VIOLATED"));
  });
}

void lines_of(std::string& out, const terminal_style& paint, const whole_run& x,
              std::string_view heading, console_block which) {
  out += '\n' + paint.heading(std::string{heading}) + '\n';
  drive_lines(out, x, which, [](const run_figure&) { return std::string{}; });
}

/// @returns a line of four figures in columns.
std::string figures_line(std::string_view label, std::string_view first,
                         std::string_view second, std::string_view third,
                         std::string_view fourth) {
  constexpr auto width = narrow_column_width;
  return fmt::format("{:<{}}{:>{}}{:>{}}{:>{}}{:>{}}", label,
                     drive_label_width + 2, first, width, second, width, third,
                     width, fourth, width);
}

/// How busy workers and cells were, those of the most work alone if there are
/// many.
void load_lines(std::string& out, const terminal_style& paint,
                const load_table& table, duration length) {
  if (table.servers.empty())
    return;
  std::vector<std::pair<const server_load*, load_summary>> all;
  for (const auto& x : table.servers)
    all.emplace_back(&x, summary_of(x.of, length));
  const auto count = all.size();
  if (count > most_load_lines) {
    std::ranges::stable_sort(all, std::ranges::greater{},
                             [](const auto& x) { return x.second.peak_share; });
    all.resize(most_load_lines);
  }
  const auto percent = [](double x) {
    return fmt::format("{:.1f} %", 100 * x);
  };
  const auto ms = [](std::optional<double> x) {
    return x ? fmt::format("{:.2f} ms", *x) : std::string{absent};
  };
  out += '\n'
         + paint.heading(
             figures_line("load", "busy", "peak", "wait mean", "wait p99"))
         + '\n';
  for (const auto& [of, sum] : all)
    out += figures_line(fmt::format("  {} {}", of->provider, of->what),
                        percent(sum.busy_share), percent(sum.peak_share),
                        ms(sum.mean_wait_ms), ms(sum.p99_wait_ms))
           + '\n';
  if (count > all.size())
    out += fmt::format("  {} more, with less to do: load.csv\n",
                       count - all.size());
  auto full = full_ones(table, length);
  full.resize(std::min(full.size(), most_load_lines));
  for (const auto& [of, sum] : full)
    out += paint.bad(fmt::format("  {} {} asked for over {:.0f} % in {:g} of "
                                 "{:.0f} s",
                                 of->provider, of->what, 100 * full_share,
                                 sum.full_s, to_seconds(length)))
           + '\n';
}

/// How late vehicles responded to what they saw, whatever the split was.
void response_lines(std::string& out, const terminal_style& paint,
                    const distribution& of) {
  const auto p50 = of.quantile_ms(0.5), p99 = of.quantile_ms(0.99),
             worst = of.ms().max();
  if (!worst)
    return;
  const auto ms = [](std::optional<double> x) {
    return fmt::format("{:.0f} ms", *x);
  };
  out += '\n'
         + paint.heading(
             figures_line("response time", "looks", "p50", "p99", "worst"))
         + '\n';
  out +=
      figures_line("  from look to control", fmt::format("{}", of.ms().count()),
                   ms(p50), ms(p99), ms(worst))
      + '\n';
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

/// The run in three sentences, where the eye ends.
void headline_lines(std::string& out, const terminal_style& paint,
                    const headline& x, bool is_safe) {
  const auto line = [](const std::string& text) {
    return wrapped(text, line_width);
  };
  const auto safety = line(x.safety);
  out += fmt::format("\n{}\n{}\n{}\n", line(x.offloading),
                     is_safe ? safety : paint.bad(safety), line(x.load));
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

  block services{m, run, end};
  if (run.provider.empty()) {
    offloading(services);
    remote_results(services);
  } else {
    providing(services);
  }
  services.print(out, paint);
  response_lines(out, paint, m.response());
  if (run.provider.empty()) {
    const whole_run whole{m, run, end};
    safety_lines(out, paint, whole);
    if (m.safety().driven > duration::zero())
      lines_of(out, paint, whole, "comfort", console_block::comfort);
    if (m.traffic().longest_stop_s())
      lines_of(out, paint, whole, "traffic", console_block::traffic);
    if (m.work().energy().all_on_board_j > 0)
      lines_of(out, paint, whole, "energy of all services",
               console_block::energy);
  }
  load_lines(out, paint, m.load(), from_seconds(end.virtual_s));
  air_lines(out, paint, m.air());
  out += '\n';
  if (!folder.empty())
    out += fmt::format("results in {}\n", folder.string());
  if (!folder.empty() && !run.pcap.empty())
    out += fmt::format("{} message{} in {}\n", messages_of(m.air()),
                       messages_of(m.air()) == 1 ? "" : "s", run.pcap);
  if (run.provider.empty())
    headline_lines(out, paint, headline_of(m, run, end), m.safety().ok());
  else if (const auto late = lateness_of(end.stood_still); !late.empty())
    out += wrapped(late, line_width) + '\n';
  return out;
}

} // namespace sofof::recording
