// From JSON to problems.
#include "experiments/solve/problem_file.hpp"

#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "base/options/toml_file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <utility>

namespace sofof::experiments {

namespace {

using json = nlohmann::json;

constexpr auto no_number = std::numeric_limits<double>::quiet_NaN();
constexpr auto never = std::numeric_limits<double>::infinity();

/// A value and where in which file it stands.
class node {
public:
  node(const json& value, std::string file)
      : node{value, std::move(file), ""} {}

  [[noreturn]] void refuse(std::string_view what) const {
    throw input_error(fmt::format("{}: {}{}{}", file_, place_,
                                  place_.empty() ? "" : ": ", what));
  }

  bool has(const char* name) const {
    return value_.is_object() && value_.contains(name)
           && !value_[name].is_null();
  }

  node operator[](const char* name) const {
    if (!value_.is_object())
      refuse("this should be an object.");
    if (!value_.contains(name))
      refuse(fmt::format("the field \"{}\" is missing.", name));
    return {value_[name], file_,
            place_.empty() ? name : fmt::format("{}.{}", place_, name)};
  }

  std::size_t size() const {
    if (!value_.is_array())
      refuse("this should be a list.");
    return value_.size();
  }

  node operator[](std::size_t i) const {
    return {value_[i], file_, fmt::format("{}[{}]", place_, i)};
  }

  /// @returns `absent` for null.
  double number(double absent = no_number) const {
    if (value_.is_null())
      return absent;
    if (!value_.is_number())
      refuse("this should be a number.");
    return value_.get<double>();
  }

  /// @returns -1 for what no knot or step can be.
  int integer() const {
    constexpr auto largest = 1 << 20;
    const auto x = number();
    return x >= 0 && x <= largest ? static_cast<int>(x) : -1;
  }

  bool flag() const {
    if (!value_.is_boolean())
      refuse("this should be true or false.");
    return value_.get<bool>();
  }

  std::string text() const {
    if (!value_.is_string())
      refuse("this should be a text.");
    return value_.get<std::string>();
  }

  std::vector<double> numbers(double absent = no_number) const {
    std::vector<double> all(size());
    for (std::size_t i = 0; i < all.size(); ++i)
      all[i] = (*this)[i].number(absent);
    return all;
  }

private:
  node(const json& value, std::string file, std::string place)
      : value_{value}, file_{std::move(file)}, place_{std::move(place)} {}

  const json& value_;
  std::string file_, place_;
};

std::array<double, 3> state(const node& x) {
  if (x.size() != 3)
    x.refuse("this should be a list of 3 numbers.");
  const auto all = x.numbers();
  return {all[0], all[1], all[2]};
}

instance_info info_of(const node& x, int position) {
  instance_info info;
  info.continues = x.has("continues") ? x["continues"].flag() : position > 0;
  info.nominal = !x.has("variant") || x["variant"].text() == "nominal";
  info.step = x.has("step") ? x["step"].integer() : position;
  if (x.has("reference")) {
    const auto known = x["reference"];
    info.reference = reference_solution{
        known["feasible"].flag(),
        known.has("cost") ? known["cost"].number() : no_number};
  }
  return info;
}

// The file goes knot by knot; the problem disc by disc.
std::vector<std::vector<double>> by_disc(const node& x, std::size_t discs) {
  std::vector<std::vector<double>> all(discs);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const auto at_knot = x[k].numbers();
    for (std::size_t j = 0; j < std::min(discs, at_knot.size()); ++j)
      all[j].push_back(at_knot[j]);
  }
  return all;
}

std::unique_ptr<path_instance> path_from(const node& file, const node& x,
                                         int position) {
  auto made = std::make_unique<path_instance>();
  auto& p = made->problem;
  const auto ahead = file["disc_offsets_m"].numbers();
  const auto weights = file["weights"];
  const auto from = state(x["x0"]);
  made->info = info_of(x, position);
  made->curvature = x["kappa_ref"].numbers();
  made->wanted = x["d_ref"].numbers();
  made->lo = by_disc(x["lo"], ahead.size());
  made->hi = by_disc(x["hi"], ahead.size());
  for (std::size_t j = 0; j < ahead.size(); ++j)
    made->discs.push_back({ahead[j], made->lo[j], made->hi[j]});
  p.steps = file["N"].integer();
  p.ds_m = file["ds_m"].number();
  p.start = {from[0], from[1], from[2]};
  p.curvature_1pm = made->curvature;
  p.wanted_m = made->wanted;
  p.discs = made->discs;
  p.curvature_max_1pm = file["curvature_max"].number();
  p.rate_max_1pm2 = file["curvature_rate_max"].number();
  p.weights = {weights["d"].number(), weights["theta"].number(),
               weights["kappa"].number(), weights["u"].number(),
               weights["terminal_factor"].number()};
  return made;
}

std::unique_ptr<velocity_instance> velocity_from(const node& file,
                                                 const node& x, int position) {
  auto made = std::make_unique<velocity_instance>();
  auto& p = made->problem;
  const auto weights = file["weights"];
  const auto limits = x["limits"];
  const auto from = state(x["x0"]);
  made->info = info_of(x, position);
  made->w_max = x["w_max"].numbers();
  made->wanted = x["w_ref"].numbers();
  made->curvature = x["kappa"].numbers();
  made->earliest = x["t_lo"].numbers(-never);
  made->latest = x["t_hi"].numbers(never);
  p.steps = file["N"].integer();
  p.ds_m = file["ds_m"].number();
  p.start = {from[0], from[1], from[2]};
  p.w_max_m2ps2 = made->w_max;
  p.wanted_m2ps2 = made->wanted;
  p.curvature_1pm = made->curvature;
  p.earliest_s = made->earliest;
  p.latest_s = made->latest;
  if (x.has("k_stop"))
    p.stop_knot = x["k_stop"].integer();
  p.limits = {limits["a_min"].number(), limits["a_max"].number(),
              limits["j_max"].number(), limits["a_tot"].number(),
              file["k_a_tot"].integer()};
  p.weights = {weights["v"].number(), weights["a"].number(),
               weights["j"].number(), weights["terminal_m"].number()};
  return made;
}

template <class Instance, class From>
instances<Instance> read_all(const node& file, From from) {
  const auto list = file["instances"];
  instances<Instance> all;
  for (std::size_t i = 0; i < list.size(); ++i)
    all.push_back(from(file, list[i], static_cast<int>(i)));
  return all;
}

json parse(const std::filesystem::path& path) {
  const auto text = require_text(path);
  try {
    return json::parse(text);
  } catch (const json::parse_error& e) {
    throw input_error(fmt::format("{}: this is no JSON from character {} on.",
                                  path.string(), e.byte));
  }
}

} // namespace

problem_file load_problems(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 2> kinds{"path", "velocity"};
  const auto document = parse(path);
  const node file{document, path.string()};
  problem_file all;
  if (file.has("tolerances")) {
    all.violation = file["tolerances"]["violation"].number();
    all.cost_share = file["tolerances"]["cost_relative"].number();
  }
  const auto kind = file["problem"].text();
  if (kind == kinds[0])
    all.list = read_all<path_instance>(file, path_from);
  else if (kind == kinds[1])
    all.list = read_all<velocity_instance>(file, velocity_from);
  else
    file["problem"].refuse(unknown_word("kind of problem", kind, kinds));
  return all;
}

} // namespace sofof::experiments
