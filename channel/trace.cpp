// Measured round trips, to be replayed.
#include "channel/trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sofof::channel {

namespace {

[[noreturn]] void refuse(std::size_t line, std::string_view why) {
  throw std::invalid_argument{fmt::format("line {}: {}", line, why)};
}

// Cuts the first line off `text`.
std::string_view take_line(std::string_view& text) {
  const auto end = text.find('\n');
  const auto line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  return line;
}

// Cuts the first word off `line`; empty when there is none.
std::string_view take_word(std::string_view& line) {
  constexpr auto separators = " \t\r,";
  line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
  const auto word = line.substr(0, line.find_first_of(separators));
  line.remove_prefix(word.size());
  return word;
}

double take_number(std::string_view& line, std::size_t number) {
  const auto word = take_word(line);
  double value = 0;
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty())
    refuse(number, "a column is missing");
  if (error != std::errc{} || end != word.data() + word.size()
      || !std::isfinite(value))
    refuse(number, fmt::format("'{}' is not a number", word));
  return value;
}

// Where a header line says that time and delay are.
struct layout {
  double seconds_per_time;
  bool receive_time_between;
};

layout read_header(std::string_view line) {
  const auto first = take_word(line);
  const auto second = take_word(line);
  if (first == "pub_time(ms)" && second == "sub_time(ms)"
      && take_word(line) == "delay(ms)")
    return {1e-3, true};
  if (first == "time_s" && second == "delay_ms")
    return {1, false};
  refuse(1, "the header must begin with 'pub_time(ms) sub_time(ms) delay(ms)' "
            "or be 'time_s,delay_ms'");
}

} // namespace

std::vector<trace_sample> parse_trace(std::string_view text) {
  const auto columns = read_header(take_line(text));
  std::vector<trace_sample> samples;
  double first = 0;
  for (std::size_t number = 2; !text.empty(); ++number) {
    auto line = take_line(text);
    if (line.find_first_not_of(" \t\r") == line.npos)
      continue;
    const auto time = take_number(line, number);
    if (columns.receive_time_between)
      take_number(line, number);
    const auto delay_ms = take_number(line, number);
    if (samples.empty())
      first = time;
    const trace_sample sample{(time - first) * columns.seconds_per_time,
                              delay_ms * 1e-3};
    if (sample.delay_s < 0)
      refuse(number, "the delay is negative");
    if (!samples.empty() && sample.at_s < samples.back().at_s)
      refuse(number, "the time is before that of the line above");
    samples.push_back(sample);
  }
  if (samples.empty())
    refuse(1, "no samples below the header");
  return samples;
}

double replay_length_s(std::span<const trace_sample> samples) {
  if (samples.size() < 2)
    return 0;
  const auto gaps = static_cast<double>(samples.size() - 1);
  return samples.back().at_s * (1 + 1 / gaps);
}

double replayed_delay_s(std::span<const trace_sample> samples, double at_s) {
  assert(!samples.empty());
  const auto length_s = replay_length_s(samples);
  const auto t = length_s > 0 ? std::fmod(at_s, length_s) : 0;
  const auto after =
      std::ranges::lower_bound(samples, t, {}, &trace_sample::at_s);
  if (after == samples.begin())
    return after->delay_s;
  const auto before = std::prev(after);
  if (after == samples.end()) {
    const auto again_s = length_s + samples.front().at_s;
    return again_s - t < t - before->at_s ? samples.front().delay_s
                                          : before->delay_s;
  }
  return after->at_s - t < t - before->at_s ? after->delay_s : before->delay_s;
}

} // namespace sofof::channel
