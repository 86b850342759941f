// Drives solvers along the instances.
#include "experiments/solve/solve.hpp"

#include "base/files/output_file.hpp"
#include "base/stopwatch.hpp"
#include "experiments/solve/problem_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace sofof::experiments {

namespace {

struct answer {
  planners::ocp::solve_report report;
  double time_us = 0;
  std::vector<double> controls; ///< Empty when nothing was solved.
};

template <class Instance>
struct kind_of;

template <>
struct kind_of<path_instance> {
  using solver = planners::path_ocp;
  static constexpr int knots_a_step = 1; ///< How far the vehicle drives on.
  static constexpr std::array<std::string_view, 6> rows{
      "disc 0", "disc 1", "disc 2", "disc 3", "curvature", "rate"};
  static auto controls(const solver& s) { return s.rate_1pm2(); }
};

template <>
struct kind_of<velocity_instance> {
  using solver = planners::velocity_ocp;
  static constexpr int knots_a_step = 2;
  static constexpr std::array<std::string_view, 5> rows{
      "time", "speed", "accel", "total", "jerk"};
  static auto controls(const solver& s) { return s.u_1ps2(); }
};

/// Solvers along a drive: each starts from the last plan that was driven.
template <class Instance>
class driver {
  using kind = kind_of<Instance>;
  using solver = typename kind::solver;

public:
  explicit driver(bool cold) : cold_{cold} {}

  answer solve(const Instance& instance) {
    const auto& info = instance.info;
    if (!info.continues)
      has_driven_ = false;
    const auto warm = !cold_ && has_driven_;
    auto& solver = info.nominal ? *driving_ : what_if();
    if (warm)
      solver.shift(kind::knots_a_step * std::max(0, info.step - step_));
    answer a;
    const cpu_stopwatch watch;
    a.report =
        solver.solve(instance.problem, warm ? planners::ocp::start::warm
                                            : planners::ocp::start::cold);
    a.time_us = watch.elapsed_us();
    if (a.report.iterations > 0) {
      const auto u = kind::controls(solver);
      a.controls.assign(u.begin(), u.end());
    }
    if (info.nominal) {
      const auto refused = a.report.iterations == 0; // the plan is the old one
      has_driven_ = refused ? warm : publishable(a.report.status);
      step_ = info.step;
    }
    return a;
  }

private:
  /// What is solved here leaves the plan that is driven alone.
  solver& what_if() {
    *trying_ = *driving_;
    return *trying_;
  }

  bool cold_;
  std::unique_ptr<solver> driving_ = std::make_unique<solver>();
  std::unique_ptr<solver> trying_ = std::make_unique<solver>();
  bool has_driven_ = false;
  int step_ = 0; ///< Of the plan that was driven last.
};

std::string number(double x) {
  return std::isfinite(x) ? fmt::format("{}", x) : "null";
}

std::string list(std::span<const double> values) {
  std::string text;
  for (const auto x : values) {
    text += text.empty() ? "" : ",";
    text += number(x);
  }
  return text;
}

std::string line(const answer& a, std::span<const std::string_view> rows) {
  const auto& r = a.report;
  auto text =
      fmt::format(R"({{"status":"{}","cost":{},"violation":{},"iterations":{},)"
                  R"("time_us":{:.3f})",
                  name(r.status), number(r.cost), number(r.violation),
                  r.iterations, a.time_us);
  if (r.worst.row >= 0)
    text +=
        fmt::format(R"(,"row":"{}","knot":{})",
                    rows[static_cast<std::size_t>(r.worst.row)], r.worst.knot);
  return text + fmt::format(R"(,"u":[{}]}})", list(a.controls)) + '\n';
}

bool is_ok(const answer& a, const reference_solution& known,
           const problem_file& file) {
  using enum planners::ocp::solve_status;
  const auto& r = a.report;
  if (!known.feasible)
    return r.status == soft_infeasible;
  return publishable(r.status) && r.violation < file.violation
         && r.cost <= known.cost * (1 + file.cost_share);
}

double quantile(const std::vector<double>& sorted, double p) {
  const auto at =
      static_cast<std::size_t>(p * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

/// What is printed in the end.
class tally {
public:
  void add(const answer& a) {
    times_us_.push_back(a.time_us);
    iterations_.push_back(a.report.iterations);
  }

  void judge(const answer& a, const instance_info& info,
             const problem_file& file) {
    ++states_[name(a.report.status)];
    if (!info.reference)
      return;
    ++known_;
    ok_ += is_ok(a, *info.reference, file) ? 1 : 0;
  }

  void print(std::ostream& screen) {
    if (times_us_.empty()) {
      screen << "no instances\n";
      return;
    }
    std::ranges::sort(times_us_);
    std::ranges::sort(iterations_);
    const auto row = [&](const auto& name, const auto& sorted, int places) {
      screen << fmt::format("{:<12} p50 {:.{}f}   p99 {:.{}f}   max {:.{}f}\n",
                            name, quantile(sorted, 0.5), places,
                            quantile(sorted, 0.99), places, sorted.back(),
                            places);
    };
    row("time, us", times_us_, 1);
    row("iterations", iterations_, 0);
    screen << fmt::format("{:<12}", "status");
    for (const auto& [status, count] : states_)
      screen << fmt::format(" {} {}  ", status, count);
    screen << '\n';
    if (known_ > 0)
      screen << fmt::format("{:<12} {} of {}\n", "ok", ok_, known_);
  }

private:
  std::vector<double> times_us_, iterations_;
  std::map<std::string_view, int> states_;
  int known_ = 0, ok_ = 0;
};

template <class Instance>
void solve_list(const instances<Instance>& list, const problem_file& file,
                const solve_options& options, std::ostream& screen) {
  tally tally;
  std::vector<answer> answers;
  for (int pass = 0; pass < options.repeat; ++pass) {
    driver<Instance> driver{options.cold};
    for (const auto& instance : list) {
      auto a = driver.solve(*instance);
      tally.add(a);
      if (pass == 0)
        answers.push_back(std::move(a));
    }
  }
  for (std::size_t i = 0; i < answers.size(); ++i)
    tally.judge(answers[i], list[i]->info, file);
  if (options.out) {
    output_file out{*options.out};
    for (const auto& a : answers) {
      out.text() += line(a, kind_of<Instance>::rows);
      out.end_line();
    }
    out.close();
  }
  tally.print(screen);
}

} // namespace

void solve_problems(const std::filesystem::path& file,
                    const solve_options& options, std::ostream& screen) {
  assert(options.repeat >= 1);
  const auto problems = load_problems(file);
  std::visit(
      [&](const auto& list) { solve_list(list, problems, options, screen); },
      problems.list);
}

} // namespace sofof::experiments
