// Strict reading of JSON.
#include "programs/json_members.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "programs/answers.hpp"
#include "programs/line_pipe.hpp"
#include <cassert>
#include <utility>
#include <vector>

namespace sofof::programs {

namespace {

using nlohmann::json;

/// Objects and lists within each other; no answer comes near it.
constexpr int deepest = 8;

/// Notices members that stand twice, which a parser passes over.
class double_members {
public:
  bool operator()(int depth, json::parse_event_t event, const json& found) {
    using met = json::parse_event_t;
    if (depth > deepest)
      throw answer_error{
          fmt::format("it must not be nested more than {} times", deepest)};
    if (event == met::object_start)
      met_.emplace_back();
    else if (event == met::object_end)
      met_.pop_back();
    else if (event == met::key
             && !met_.back().insert(found.get_ref<const std::string&>()).second)
      throw answer_error{
          fmt::format("it must give \"{}\" only once",
                      quoted_line(found.get_ref<const std::string&>()))};
    return true;
  }

private:
  std::vector<std::set<std::string>> met_;
};

} // namespace

std::shared_ptr<const json> parse_object(std::string_view line) {
  try {
    double_members twice;
    auto all = std::make_shared<json>(json::parse(
        line, [&](int depth, json::parse_event_t event, json& value) {
          return twice(depth, event, value);
        }));
    if (!all->is_object())
      throw answer_error{"it must be a JSON object"};
    return all;
  } catch (const json::exception&) {
    throw answer_error{"it must be a JSON object"};
  }
}

json_members::json_members(const json& of, std::string where)
    : of_{of}, where_{std::move(where)} {
  if (!of_.is_object())
    throw answer_error{fmt::format("\"{}\" must be an object",
                                   where_.substr(0, where_.size() - 1))};
}

bool json_members::has(std::string_view name) {
  known_.emplace(name);
  return of_.contains(name);
}

const json& json_members::need(std::string_view name) {
  if (!has(name))
    throw answer_error{fmt::format("it must have \"{}{}\"", where_, name)};
  return of_.at(std::string{name});
}

std::string json_members::text(std::string_view name) {
  const auto& x = need(name);
  if (!x.is_string())
    refuse(name, "must be a text");
  return x.get<std::string>();
}

bool json_members::flag(std::string_view name) {
  const auto& x = need(name);
  if (!x.is_boolean())
    refuse(name, "must be true or false");
  return x.get<bool>();
}

std::uint64_t json_members::count(std::string_view name) {
  const auto& x = need(name);
  if (!x.is_number_unsigned())
    refuse(name, "must be a whole number, not below 0");
  return x.get<std::uint64_t>();
}

double json_members::number(std::string_view name, double least, double most) {
  assert(least <= most);
  const auto& x = need(name);
  if (!x.is_number())
    refuse(name, "must be a number");
  const auto value = x.get<double>();
  if (!(value >= least && value <= most))
    refuse(name, fmt::format("must be from {} to {}", least, most));
  return value;
}

const json& json_members::list(std::string_view name) {
  const auto& x = need(name);
  if (!x.is_array())
    refuse(name, "must be a list");
  return x;
}

void json_members::finish() const {
  for (const auto& member : of_.items())
    if (!known_.contains(member.key()))
      refuse(member.key(), "is unknown here");
}

void json_members::refuse(std::string_view name, std::string_view why) const {
  throw answer_error{
      fmt::format("\"{}{}\" {}", where_, quoted_line(name), why)};
}

} // namespace sofof::programs
