// Optima of velocity problems by Ipopt, to compare those of SOFOF with.
//
//   ipopt_optima IN PLANS OUT MOST
//
// Reads a file of `sofof solve` (velocity problems without stops) and what that
// wrote of it (--out), and writes the first MOST of those that Ipopt finds a
// solution of, with its cost as their reference. The problem is stated as in
// docs/planner.md, in all states and controls, with exact derivatives. It has
// many local optima: where a car waits for the one ahead is a choice. Of
// several starts, the plans among them, the best counts.
// Reference: Wächter, Biegler, Math. Program. 106, 2006.
#include <nlohmann/json.hpp>

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace {

using Ipopt::Index;
using Ipopt::Number;
using nlohmann::json;

constexpr double infinite = 2e19; // as Ipopt has it

/// v(w), smooth at rest, and its derivatives.
struct speed {
  double v, slope, bend;

  speed(double w, double eps) {
    v = std::sqrt(2 * std::max(w, 0.0) + eps * eps);
    slope = w > 0 ? 1 / v : 0;
    bend = w > 0 ? -1 / (v * v * v) : 0;
  }
};

/// One problem. Variables: t, w, a of the knots 1 to N, then u of 0 to N - 1.
/// Rows: those of w, a and t, jerk at 0 to N - 1, then total acceleration.
class velocity_nlp final : public Ipopt::TNLP {
public:
  velocity_nlp(const json& file, const json& one)
      : n_{file["N"]}, ds_{file["ds_m"]}, eps_{file["eps_mps"]},
        first_total_{file["k_a_tot"]}, qv_{file["weights"]["v"]},
        qa_{file["weights"]["a"]}, qj_{file["weights"]["j"]},
        terminal_m_{file["weights"]["terminal_m"]}, one_{one},
        w_max_{one["w_max"].get<std::vector<double>>()},
        w_ref_{one["w_ref"].get<std::vector<double>>()},
        kappa_{one["kappa"].get<std::vector<double>>()} {
    const auto& limits = one["limits"];
    a_min_ = limits["a_min"];
    a_max_ = limits["a_max"];
    j_max_ = limits["j_max"];
    a_tot_ = limits["a_tot"];
  }

  /// The first guess: the car brakes to a share of its leader's speed, until it
  /// is as far behind as it has to be, and follows it from then on.
  void start_at(double share) { share_ = share; }

  /// Or it drives by these controls.
  void start_at(std::vector<double> controls) {
    controls_ = std::move(controls);
  }

  bool is_solved = false;
  double cost = infinite;

  bool get_nlp_info(Index& n, Index& m, Index& jacobian, Index& hessian,
                    IndexStyleEnum& style) override {
    n = 4 * n_;
    m = 4 * n_ + totals();
    style = C_STYLE;
    // Two passes: the first one counts.
    entries_.count_only = true;
    jacobian = each_slope(nullptr);
    hessian = each_bend(nullptr, 0, nullptr);
    entries_.count_only = false;
    return true;
  }

  bool get_bounds_info(Index, Number* low, Number* high, Index, Number* row_low,
                       Number* row_high) override {
    for (auto k = 1; k <= n_; ++k) {
      low[t(k)] = bound("t_lo", k, -infinite);
      high[t(k)] = bound("t_hi", k, infinite);
      low[w(k)] = 0;
      high[w(k)] = w_max_[at(k)];
      low[a(k)] = a_min_;
      high[a(k)] = a_max_;
      low[u(k - 1)] = -infinite;
      high[u(k - 1)] = infinite;
    }
    for (auto k = 0; k < n_; ++k) {
      for (auto row : {w_row(k), a_row(k), t_row(k)})
        row_low[row] = row_high[row] = 0;
      row_low[jerk_row(k)] = -j_max_;
      row_high[jerk_row(k)] = j_max_;
    }
    for (auto k = first_total_; k <= n_; ++k) {
      row_low[total_row(k)] = -infinite;
      row_high[total_row(k)] = a_tot_ * a_tot_;
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* x, bool, Number*, Number*, Index,
                          bool, Number*) override {
    const auto leader_mps =
        ds_ / (bound("t_lo", n_, 0) - bound("t_lo", n_ - 1, 0));
    auto now_s = x0(0), here_w = x0(1), here_a = x0(2);
    for (auto k = 0; k < n_; ++k) {
      const speed here{here_w, eps_};
      // When the leader leaves it the place, also where that is no bound.
      const auto free_s = bound("t_lo", n_, 0) - (n_ - k) * ds_ / leader_mps;
      const auto wanted_mps = (now_s < free_s ? share_ : 1) * leader_mps;
      const auto wanted_w = std::min(squared(wanted_mps) / 2, w_ref_[at(k)]);
      constexpr auto closes_m = 4.0;
      const auto wanted_a =
          std::clamp((wanted_w - here_w) / closes_m, a_min_, a_max_);
      const auto most = 0.9 * j_max_ / here.v;
      x[u(k)] = controls_.empty()
                    ? std::clamp((wanted_a - here_a) / ds_, -most, most)
                    : controls_[at(k)];
      const auto next_w = here_w + ds_ * here_a + ds_ * ds_ / 2 * x[u(k)];
      here_w = std::clamp(next_w, 0.01, w_max_[at(k + 1)]);
      here_a += ds_ * x[u(k)];
      now_s += 2 * ds_ / (here.v + speed{here_w, eps_}.v);
      x[w(k + 1)] = here_w;
      x[a(k + 1)] = here_a;
      x[t(k + 1)] = now_s;
    }
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& sum) override {
    sum = 0;
    for (auto k = 0; k <= n_; ++k) {
      const auto dw = w_of(x, k) - w_ref_[at(k)];
      const auto stage =
          qv_ * dw * dw / (2 * w_ref_[at(k)]) + qa_ * a_of(x, k) * a_of(x, k);
      sum += (k == n_ ? terminal_m_ : ds_) * stage;
      if (k < n_) {
        const auto jerk = x[u(k)] * speed{w_of(x, k), eps_}.v;
        sum += ds_ * qj_ * jerk * jerk;
      }
    }
    return true;
  }

  bool eval_grad_f(Index n, const Number* x, bool, Number* slope) override {
    std::fill(slope, slope + n, 0.0);
    for (auto k = 1; k <= n_; ++k) {
      const auto m = k == n_ ? terminal_m_ : ds_;
      slope[w(k)] += m * qv_ * (w_of(x, k) - w_ref_[at(k)]) / w_ref_[at(k)];
      slope[a(k)] += 2 * m * qa_ * a_of(x, k);
    }
    for (auto k = 0; k < n_; ++k) {
      const auto v2 = squared(speed{w_of(x, k), eps_}.v);
      slope[u(k)] += 2 * ds_ * qj_ * x[u(k)] * v2;
      if (k > 0)
        slope[w(k)] += 2 * ds_ * qj_ * squared(x[u(k)]);
    }
    return true;
  }

  bool eval_g(Index, const Number* x, bool, Index, Number* g) override {
    for (auto k = 0; k < n_; ++k) {
      const speed here{w_of(x, k), eps_}, then{w_of(x, k + 1), eps_};
      g[w_row(k)] = w_of(x, k + 1) - w_of(x, k) - ds_ * a_of(x, k)
                    - ds_ * ds_ / 2 * x[u(k)];
      g[a_row(k)] = a_of(x, k + 1) - a_of(x, k) - ds_ * x[u(k)];
      g[t_row(k)] =
          x[t(k + 1)] - (k ? x[t(k)] : x0(0)) - 2 * ds_ / (here.v + then.v);
      g[jerk_row(k)] = x[u(k)] * here.v;
    }
    for (auto k = first_total_; k <= n_; ++k)
      g[total_row(k)] =
          squared(a_of(x, k)) + squared(2 * w_of(x, k) * kappa_[at(k)]);
    return true;
  }

  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows,
                  Index* columns, Number* values) override {
    entries_ = {rows, columns, values, false, 0};
    each_slope(x);
    return true;
  }

  bool eval_h(Index, const Number* x, bool, Number of_cost, Index,
              const Number* of_rows, bool, Index, Index* rows, Index* columns,
              Number* values) override {
    entries_ = {rows, columns, values, false, 0};
    each_bend(x, of_cost, of_rows);
    return true;
  }

  void finalize_solution(Ipopt::SolverReturn status, Index, const Number*,
                         const Number*, const Number*, Index, const Number*,
                         const Number*, Number value, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    is_solved =
        status == Ipopt::SUCCESS || status == Ipopt::STOP_AT_ACCEPTABLE_POINT;
    cost = value;
  }

private:
  /// Entries of a sparse matrix, in the order of calls: their places, or their
  /// values.
  struct sparse {
    Index *rows = nullptr, *columns = nullptr;
    Number* values = nullptr;
    bool count_only = false;
    Index count = 0;

    template <class Value>
    void add(Index row, Index column, Value value) {
      if (!count_only && values)
        values[count] = value();
      else if (!count_only) {
        rows[count] = row;
        columns[count] = column;
      }
      ++count;
    }
    /// Of a symmetric one: its lower half.
    template <class Value>
    void add_lower(Index i, Index j, Value value) {
      add(std::max(i, j), std::min(i, j), value);
    }
  };

  static double squared(double x) { return x * x; }
  static std::size_t at(Index k) { return static_cast<std::size_t>(k); }

  Index totals() const { return n_ - first_total_ + 1; }
  Index t(Index k) const { return k - 1; }
  Index w(Index k) const { return n_ + k - 1; }
  Index a(Index k) const { return 2 * n_ + k - 1; }
  Index u(Index k) const { return 3 * n_ + k; }
  Index w_row(Index k) const { return k; }
  Index a_row(Index k) const { return n_ + k; }
  Index t_row(Index k) const { return 2 * n_ + k; }
  Index jerk_row(Index k) const { return 3 * n_ + k; }
  Index total_row(Index k) const { return 4 * n_ + k - first_total_; }
  double x0(std::size_t i) const { return one_["x0"][i]; }
  double w_of(const Number* x, Index k) const { return k ? x[w(k)] : x0(1); }
  double a_of(const Number* x, Index k) const { return k ? x[a(k)] : x0(2); }
  double bound(const char* name, Index k, double none) const {
    const auto& x = one_[name][at(k)];
    return x.is_null() ? none : x.get<double>();
  }

  Index each_slope(const Number* x) {
    entries_.count = 0;
    const auto number = [](double value) { return [value] { return value; }; };
    for (auto k = 0; k < n_; ++k) {
      const auto times = [&](Index of) {
        return [this, x, k, of] {
          const speed here{w_of(x, k), eps_}, then{w_of(x, k + 1), eps_};
          return 2 * ds_ * (of == k ? here : then).slope
                 / squared(here.v + then.v);
        };
      };
      entries_.add(w_row(k), w(k + 1), number(1));
      entries_.add(a_row(k), a(k + 1), number(1));
      entries_.add(t_row(k), t(k + 1), number(1));
      entries_.add(t_row(k), w(k + 1), times(k + 1));
      entries_.add(w_row(k), u(k), number(-ds_ * ds_ / 2));
      entries_.add(a_row(k), u(k), number(-ds_));
      entries_.add(jerk_row(k), u(k), [this, x, k] {
        return speed{w_of(x, k), eps_}.v;
      });
      if (k == 0)
        continue;
      entries_.add(w_row(k), w(k), number(-1));
      entries_.add(w_row(k), a(k), number(-ds_));
      entries_.add(a_row(k), a(k), number(-1));
      entries_.add(t_row(k), t(k), number(-1));
      entries_.add(t_row(k), w(k), times(k));
      entries_.add(jerk_row(k), w(k), [this, x, k] {
        return x[u(k)] * speed{w_of(x, k), eps_}.slope;
      });
    }
    for (auto k = first_total_; k <= n_; ++k) {
      entries_.add(total_row(k), a(k), [this, x, k] { return 2 * a_of(x, k); });
      entries_.add(total_row(k), w(k), [this, x, k] {
        return 8 * w_of(x, k) * squared(kappa_[at(k)]);
      });
    }
    return entries_.count;
  }

  Index each_bend(const Number* x, double of_cost, const Number* of_rows) {
    entries_.count = 0;
    for (auto k = 1; k <= n_; ++k) {
      const auto m = k == n_ ? terminal_m_ : ds_;
      entries_.add(w(k), w(k),
                   [=, this] { return of_cost * m * qv_ / w_ref_[at(k)]; });
      entries_.add(a(k), a(k), [=, this] { return of_cost * 2 * m * qa_; });
    }
    for (auto k = 0; k < n_; ++k) {
      entries_.add(u(k), u(k), [=, this] {
        return of_cost * 2 * ds_ * qj_ * squared(speed{w_of(x, k), eps_}.v);
      });
      // 2 ds / (v_k + v_{k+1}), which a row has with a minus.
      const auto same = [=, this](Index of) {
        return [=, this] {
          const speed here{w_of(x, k), eps_}, then{w_of(x, k + 1), eps_};
          const auto& own = of == k ? here : then;
          const auto sum = here.v + then.v;
          return of_rows[t_row(k)] * 2 * ds_
                 * (own.bend / squared(sum)
                    - 2 * squared(own.slope) / (sum * sum * sum));
        };
      };
      entries_.add(w(k + 1), w(k + 1), same(k + 1));
      if (k == 0)
        continue;
      entries_.add(w(k), w(k), same(k));
      entries_.add_lower(w(k), w(k + 1), [=, this] {
        const speed here{w_of(x, k), eps_}, then{w_of(x, k + 1), eps_};
        const auto sum = here.v + then.v;
        return -of_rows[t_row(k)] * 4 * ds_ * here.slope * then.slope
               / (sum * sum * sum);
      });
      entries_.add_lower(w(k), u(k), [=, this] {
        return of_cost * 4 * ds_ * qj_ * x[u(k)]
               + of_rows[jerk_row(k)] * speed{w_of(x, k), eps_}.slope;
      });
      entries_.add(w(k), w(k), [=, this] {
        return of_rows[jerk_row(k)] * x[u(k)] * speed{w_of(x, k), eps_}.bend;
      });
    }
    for (auto k = first_total_; k <= n_; ++k) {
      entries_.add(a(k), a(k), [=, this] { return 2 * of_rows[total_row(k)]; });
      entries_.add(w(k), w(k), [=, this] {
        return of_rows[total_row(k)] * 8 * squared(kappa_[at(k)]);
      });
    }
    return entries_.count;
  }

  Index n_;
  double ds_, eps_;
  Index first_total_;
  double qv_, qa_, qj_, terminal_m_;
  const json& one_;
  std::vector<double> w_max_, w_ref_, kappa_;
  double a_min_ = 0, a_max_ = 0, j_max_ = 0, a_tot_ = 0;
  double share_ = 1;
  std::vector<double> controls_;
  sparse entries_;
};

/// @returns the least cost that any start leads to; infinite for none.
double best_cost(Ipopt::IpoptApplication& solver, const json& file,
                 const json& one, const json& plan) {
  auto best = infinite;
  const auto from = [&](const auto& start) {
    Ipopt::SmartPtr<velocity_nlp> problem = new velocity_nlp{file, one};
    problem->start_at(start);
    solver.OptimizeTNLP(GetRawPtr(problem));
    if (problem->is_solved)
      best = std::min(best, problem->cost);
  };
  const auto controls = plan["u"].get<std::vector<double>>();
  if (!controls.empty())
    from(controls);
  for (const auto share : {0.95, 0.8, 0.6, 0.3})
    from(share);
  return best;
}

} // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fprintf(stderr, "ipopt_optima IN PLANS OUT MOST\n");
    return 2;
  }
  std::ifstream in{argv[1]}, plans{argv[2]};
  auto file = json::parse(in);
  const auto most = std::stoul(argv[4]);
  Ipopt::IpoptApplication solver;
  solver.Options()->SetNumericValue("tol", 1e-7);
  solver.Options()->SetNumericValue("acceptable_tol", 1e-5);
  solver.Options()->SetIntegerValue("acceptable_iter", 5);
  solver.Options()->SetIntegerValue("max_iter", 200);
  solver.Options()->SetNumericValue("max_cpu_time", 2.0); // of the start
  solver.Options()->SetIntegerValue("print_level", 0);
  solver.Options()->SetStringValue("sb", "yes");
  if (solver.Initialize() != Ipopt::Solve_Succeeded)
    return 1;
  auto kept = json::array();
  std::size_t without = 0;
  for (const auto& one : file["instances"]) {
    if (kept.size() == most)
      break;
    std::string plan;
    std::getline(plans, plan);
    const auto cost = best_cost(solver, file, one, json::parse(plan));
    if (cost >= infinite) {
      ++without;
      continue;
    }
    kept.push_back(one);
    kept.back()["reference"] = {{"feasible", true}, {"cost", cost}};
  }
  std::printf("%zu with an optimum, %zu without\n", kept.size(), without);
  file["instances"] = std::move(kept);
  std::ofstream{argv[3]} << file;
  return 0;
}
