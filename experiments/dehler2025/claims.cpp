// Each claim: its parts, each held against the figures.
#include "experiments/dehler2025/claims.hpp"

#include "experiments/dehler2025/paper.hpp"
#include "experiments/dehler2025/share_interval.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sofof::experiments::study {

namespace {

using findings = std::vector<finding>;

/// @returns the point with the longest limit, if it has a value.
const interval* height_of(const vehicle_figures& f) {
  return !f.curve.empty() && f.curve.back().t_off_s ? &*f.curve.back().t_off_s
                                                    : nullptr;
}

const vehicle_figures* with(const paper_figures& f, int vehicles) {
  const auto found =
      std::ranges::find(f.by_vehicles, vehicles, &vehicle_figures::vehicles);
  return found == f.by_vehicles.end() ? nullptr : &*found;
}

/// @returns whether a is below b: shown, not shown, or shown to be above.
finding below(const interval& a, const interval& b) {
  if (a.high < b.low)
    return finding::holds;
  return a.low > b.high ? finding::opposite : finding::open;
}

/// @returns whether x is within a share of what it should be.
finding near(const interval& x, double should, double share) {
  if (std::abs(x.mean - should) <= share * should)
    return finding::holds;
  const auto apart =
      x.low > should * (1 + share) || x.high < should * (1 - share);
  return apart ? finding::opposite : finding::open;
}

finding near(double x, double should, double share) {
  return near(interval{x, x, x}, should, share);
}

/// @returns whether x is at most `times` as much as what it should be, or as
/// little; opposite where all of its interval is beyond `other_times`.
finding within_factor(const interval& x, double should, double times,
                      double other_times) {
  if (x.mean <= times * should && should <= times * x.mean)
    return finding::holds;
  const auto beyond =
      x.low > other_times * should || other_times * x.high < should;
  return beyond ? finding::opposite : finding::open;
}

/// @returns whether a figure is small: holds up to `few`, opposite from `many`.
finding at_most(double x, double few, double many) {
  if (x <= few)
    return finding::holds;
  return x >= many ? finding::opposite : finding::open;
}

std::string text_of(const interval& x, int digits = 1) {
  return fmt::format("{:.{}f} ({:.{}f}–{:.{}f})", x.mean, digits, x.low, digits,
                     x.high, digits);
}

judged_claim claim(const char* name, const findings& parts, std::string ours) {
  return {name, std::move(ours), verdict_of(parts)};
}

/// @returns whether no point of a curve is below the one before.
finding never_falls(const vehicle_figures& f) {
  const interval* before = nullptr;
  for (const auto& point : f.curve) {
    if (!point.t_off_s)
      continue;
    if (before && below(*point.t_off_s, *before) == finding::holds)
      return finding::opposite;
    before = &*point.t_off_s;
  }
  return finding::holds;
}

judged_claim rises(const paper_figures& f) {
  findings parts;
  std::string ours;
  for (const auto& n : f.by_vehicles) {
    const auto* top = height_of(n);
    if (!top || !n.curve.front().t_off_s)
      continue;
    const auto& first = *n.curve.front().t_off_s;
    auto ends_higher = finding::open;
    if (top->low >= tolerance::rise_times * first.high)
      ends_higher = finding::holds;
    else if (top->high <= first.low)
      ends_higher = finding::opposite;
    parts.push_back(ends_higher);
    // Of a curve that does not rise it says nothing that it never falls.
    if (const auto steady = never_falls(n);
        steady != finding::holds || ends_higher == finding::holds)
      parts.push_back(steady);
    ours += fmt::format("{}{}: {:.2f} to {:.1f} s", ours.empty() ? "" : "; ",
                        n.vehicles, first.mean, top->mean);
  }
  return claim("rises", parts, ours);
}

/// Adds whether one vehicle's curve ends at a height, if both are known.
void add_height(const paper_figures& f, std::optional<double> height_s,
                findings& parts, std::string& ours) {
  const auto* one = with(f, 1);
  const auto* top = one ? height_of(*one) : nullptr;
  if (!top || !height_s)
    return;
  parts.push_back(near(*top, *height_s, tolerance::height));
  ours += fmt::format("{} s of {:.1f} s", text_of(*top), *height_s);
}

judged_claim saturates(const paper_figures& f) {
  findings parts;
  std::string ours;
  add_height(f, paper::saturation_s, parts, ours);
  const auto* one = parts.empty() ? nullptr : with(f, 1);
  const auto last = one ? one->curve.size() - 1 : 0;
  if (last > 0 && one->curve[last - 1].t_off_s) {
    const auto& before = *one->curve[last - 1].t_off_s;
    parts.push_back(
        near(before, one->curve[last].t_off_s->mean, tolerance::plateau));
    ours += fmt::format("; {} s at {} ms", text_of(before),
                        one->curve[last - 1].limit_ms);
  }
  return claim("saturates", parts, ours);
}

judged_claim time_in_area(const paper_figures& f) {
  findings parts;
  std::string ours;
  if (const auto* one = with(f, 1))
    add_height(f, one->time_in_area_s, parts, ours);
  return claim("time_in_area", parts, ours);
}

judged_claim rises_slower(const paper_figures& f) {
  findings parts;
  std::string ours;
  const auto* one = with(f, 1);
  const auto* six = with(f, 6);
  const auto* top = one ? height_of(*one) : nullptr;
  for (std::size_t i = 0; top && six && i < one->curve.size(); ++i) {
    const auto& alone = one->curve[i].t_off_s;
    const auto& together = six->curve[i].t_off_s;
    if (!alone || !together || alone->mean < tolerance::rising_from * top->mean
        || alone->mean > tolerance::rising_to * top->mean)
      continue;
    parts.push_back(below(*together, *alone));
    ours += fmt::format("{}at {} ms {} and {} s", ours.empty() ? "" : "; ",
                        one->curve[i].limit_ms, text_of(*alone),
                        text_of(*together));
  }
  return claim("rises_slower", parts, ours);
}

judged_claim six_lowest(const paper_figures& f) {
  findings parts;
  std::string ours;
  const auto* six = with(f, 6);
  const auto* top = six ? height_of(*six) : nullptr;
  for (const auto& n : f.by_vehicles)
    if (const auto* other = height_of(n); top && other && n.vehicles != 6) {
      parts.push_back(below(*top, *other));
      ours += fmt::format("{}: {}; ", n.vehicles, text_of(*other));
    }
  if (top)
    ours += "6: " + text_of(*top) + " s";
  return claim("six_lowest", parts, ours);
}

/// @returns what a growth over all is worth, where a step on the way falls.
finding despite(const std::optional<interval>& step, finding over_all) {
  return step && step->high < 0 && over_all == finding::holds ? finding::open
                                                              : over_all;
}

judged_claim latency_grows(const paper_figures& f) {
  findings parts;
  std::string ours;
  const vehicle_figures* before = nullptr;
  const vehicle_figures* first = nullptr;
  for (const auto& n : f.by_vehicles) {
    if (!n.latency_ms)
      continue;
    ours += fmt::format("{}{}: {:.2f} ± {:.2f}", ours.empty() ? "" : "; ",
                        n.vehicles, n.latency_ms->mean, n.latency_deviation_ms);
    first = first ? first : &n;
    before = &n;
  }
  if (before && before != first) {
    auto mean = below(*first->latency_ms, *before->latency_ms);
    const auto grown =
        before->latency_deviation_ms / first->latency_deviation_ms - 1;
    auto deviation = grown > tolerance::grown    ? finding::holds
                     : grown < -tolerance::grown ? finding::opposite
                                                 : finding::open;
    for (const auto& n : f.by_vehicles) {
      mean = despite(n.mean_step_ms, mean);
      deviation = despite(n.deviation_step_ms, deviation);
    }
    parts = {mean, deviation};
    ours += " ms";
  }
  return claim("latency_grows", parts, ours);
}

judged_claim latency_of_one(const paper_figures& f) {
  findings parts;
  std::string ours;
  const auto* one = with(f, 1);
  if (one && one->latency_ms) {
    parts = {near(*one->latency_ms, paper::latency_mean_ms, tolerance::fitted),
             near(one->latency_deviation_ms, paper::latency_deviation_ms,
                  tolerance::fitted)};
    ours = fmt::format("{:.2f} ± {:.2f} ms", one->latency_ms->mean,
                       one->latency_deviation_ms);
  }
  return claim("latency_of_one", parts, ours);
}

judged_claim nearly_all_in_time(const paper_figures& f) {
  findings parts;
  double most = 0;
  for (const auto& n : f.by_vehicles)
    if (n.latency_ms) {
      parts.push_back(
          at_most(n.late_share, tolerance::few_late, tolerance::many_late));
      most = std::max(most, n.late_share);
    }
  return claim("nearly_all_in_time", parts,
               fmt::format("at most {:.4f} % later", 100 * most));
}

judged_claim real_latency(const paper_figures& f) {
  const auto& x = f.real_latency_ms;
  findings parts;
  if (x.count > 0)
    parts = {
        near(x.mean, paper::real_latency_mean_ms, tolerance::fitted),
        near(x.deviation, paper::real_latency_deviation_ms, tolerance::fitted)};
  return claim("real_latency", parts,
               fmt::format("{:.2f} ± {:.2f} ms", x.mean, x.deviation));
}

judged_claim real_early_ends(const paper_figures& f) {
  if (f.drives == 0)
    return claim("real_early_ends", {}, "");
  const auto ours = share_interval(f.drives_ended_early, f.drives);
  constexpr double theirs =
      static_cast<double>(paper::real_early_ends) / paper::real_drives;
  auto part = finding::open;
  const auto is_narrow = ours.low >= theirs / tolerance::rate_times
                         && ours.high <= tolerance::rate_times * theirs;
  if (ours.low <= theirs && theirs <= ours.high && is_narrow)
    part = finding::holds;
  else if (ours.low > tolerance::rate_times * theirs
           || ours.high < theirs / tolerance::rate_times)
    part = finding::opposite;
  return claim("real_early_ends", {part},
               fmt::format("{} of {} drives, so {:.2f} ({:.2f}–{:.2f}) of {}",
                           f.drives_ended_early, f.drives,
                           ours.mean * paper::real_drives,
                           ours.low * paper::real_drives,
                           ours.high * paper::real_drives, paper::real_drives));
}

judged_claim switch_unnoticed(const paper_figures& f) {
  findings parts;
  if (f.switches > 0)
    parts = {at_most(f.largest_speed_jump_mps, tolerance::quiet_jump_mps,
                     tolerance::loud_jump_mps),
             at_most(f.largest_acceleration_jump_mps2,
                     tolerance::quiet_jump_mps2, tolerance::loud_jump_mps2)};
  return claim("switch_unnoticed", parts,
               fmt::format("{:.4f} m/s, {:.4f} m/s²", f.largest_speed_jump_mps,
                           f.largest_acceleration_jump_mps2));
}

judged_claim costs(const char* name, const std::optional<cost_figures>& ours,
                   const recording::cpu_shares& theirs) {
  if (!ours)
    return claim(name, {}, "");
  findings parts;
  std::string text;
  for (const auto& [x, should] : {std::pair{ours->active, theirs.active},
                                  {ours->inactive, theirs.inactive},
                                  {ours->requester_remote, theirs.requester}}) {
    parts.push_back(within_factor(x, should, tolerance::cost_times,
                                  tolerance::other_cost_times));
    text += (text.empty() ? "" : "; ") + text_of(x, 3);
  }
  return claim(name, parts, text + " %");
}

judged_claim pays(const char* name, const std::optional<cost_figures>& ours,
                  double printed_percent) {
  if (!ours)
    return claim(name, {}, "");
  constexpr double always = 100;
  const auto& from = ours->break_even;
  if (!from || from->low >= always)
    return claim(name, {finding::opposite}, "never");
  return claim(name,
               {from->high < always ? finding::holds : finding::open,
                within_factor(*from, printed_percent, tolerance::pays_times,
                              tolerance::other_pays_times)},
               std::isinf(from->high) ? fmt::format(
                   "{:.2f} % ({:.2f} to never)", from->mean, from->low)
                                      : text_of(*from, 2) + " %");
}

judged_claim v2x_negligible(const paper_figures& f) {
  if (!f.v2x_at_most)
    return claim("v2x_negligible", {}, "");
  return claim(
      "v2x_negligible",
      {at_most(*f.v2x_at_most, tolerance::little_v2x, tolerance::much_v2x)},
      fmt::format("at most {:.3f} %", *f.v2x_at_most));
}

} // namespace

verdict verdict_of(std::span<const finding> parts) {
  if (parts.empty())
    return verdict::not_measured;
  const auto holds = std::ranges::count(parts, finding::holds);
  if (holds == std::ssize(parts))
    return verdict::reproduced;
  if (holds > 0)
    return verdict::in_part;
  return std::ranges::count(parts, finding::opposite) > 0
             ? verdict::contradicts
             : verdict::not_reproduced;
}

std::string_view word_of(verdict v) {
  switch (v) {
    case verdict::reproduced:
      return "reproduced";
    case verdict::in_part:
      return "in part";
    case verdict::not_reproduced:
      return "not reproduced";
    case verdict::contradicts:
      return "contradicts";
    case verdict::not_measured:
      break;
  }
  return "not measured";
}

std::vector<judged_claim> judge(const paper_figures& f) {
  return {rises(f),
          saturates(f),
          time_in_area(f),
          rises_slower(f),
          six_lowest(f),
          latency_grows(f),
          latency_of_one(f),
          nearly_all_in_time(f),
          costs("cost_20_hz", f.cpu_20_hz, paper::cpu_20_hz),
          pays("pays_20_hz", f.cpu_20_hz, paper::printed_share_20_hz),
          v2x_negligible(f),
          real_latency(f),
          real_early_ends(f),
          switch_unnoticed(f),
          costs("cost_100_hz", f.cpu_100_hz, paper::cpu_100_hz),
          pays("pays_100_hz", f.cpu_100_hz, paper::printed_share_100_hz)};
}

} // namespace sofof::experiments::study
