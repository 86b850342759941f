// Line by line.
#include "recording/exposition.hpp"

#include <fmt/format.h>

#include <cassert>
#include <utility>

namespace sofof::recording {

namespace {

std::string_view word_for(exposition::kind what) {
  switch (what) {
    case exposition::kind::counter:
      return "counter";
    case exposition::kind::gauge:
      return "gauge";
    case exposition::kind::histogram:
      return "histogram";
  }
  return "unknown";
}

/// @returns a bucket's limit, with a point also where it is a whole number.
std::string in_buckets(double limit) {
  auto text = fmt::format("{}", limit);
  if (text.find_first_of(".e") == text.npos)
    text += ".0";
  return text;
}

void append_escaped(std::string& to, std::string_view text) {
  for (const auto c : text) {
    if (c == '\n') {
      to += "\\n";
      continue;
    }
    if (c == '"' || c == '\\')
      to += '\\';
    to += c;
  }
}

} // namespace

exposition_format format_for(std::string_view accept) {
  return accept.find("application/openmetrics-text") != accept.npos
             ? exposition_format::openmetrics
             : exposition_format::text;
}

std::string_view type_of(exposition_format format) {
  return format == exposition_format::openmetrics
             ? "application/openmetrics-text; version=1.0.0; charset=utf-8"
             : "text/plain; version=0.0.4; charset=utf-8";
}

void exposition::family(std::string_view name, kind what, std::string_view help,
                        std::string_view unit) {
  assert(unit.empty() || name.ends_with(unit));
  name_ = name;
  kind_ = what;
  // OpenMetrics names the family, the older format its samples.
  const auto is_open = format_ == exposition_format::openmetrics;
  const auto whole =
      !is_open && what == kind::counter ? name_ + "_total" : name_;
  text_ += fmt::format("# TYPE {} {}\n", whole, word_for(what));
  if (is_open && !unit.empty())
    text_ += fmt::format("# UNIT {} {}\n", whole, unit);
  text_ += fmt::format("# HELP {} {}\n", whole, help);
}

void exposition::line(std::string_view suffix, const labels& of,
                      std::string_view le, std::string_view value) {
  text_ += name_;
  text_ += suffix;
  auto separator = '{';
  const auto add = [&](std::string_view name, std::string_view x) {
    text_ += std::exchange(separator, ',');
    text_ += name;
    text_ += "=\"";
    append_escaped(text_, x);
    text_ += '"';
  };
  for (const auto& [name, x] : of)
    add(name, x);
  if (!le.empty())
    add("le", le);
  if (separator == ',')
    text_ += '}';
  text_ += ' ';
  text_ += value;
  text_ += '\n';
}

void exposition::sample(const labels& of, double value) {
  line(kind_ == kind::counter ? "_total" : "", of, {},
       fmt::format("{}", value));
}

void exposition::sample(const labels& of, std::uint64_t value) {
  line(kind_ == kind::counter ? "_total" : "", of, {},
       fmt::format("{}", value));
}

void exposition::histogram(const labels& of, std::span<const double> limits,
                           std::span<const std::uint64_t> counts, double sum) {
  assert(kind_ == kind::histogram);
  assert(counts.size() == limits.size() + 1);
  std::uint64_t all = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    all += counts[i];
    line("_bucket", of, i < limits.size() ? in_buckets(limits[i]) : "+Inf",
         fmt::format("{}", all));
  }
  line("_sum", of, {}, fmt::format("{}", sum));
  line("_count", of, {}, fmt::format("{}", all));
}

std::string exposition::finish() {
  if (format_ == exposition_format::openmetrics)
    text_ += "# EOF\n";
  return std::move(text_);
}

} // namespace sofof::recording
