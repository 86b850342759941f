// A few lines for people, then the text that learners read.
#include "policies/algorithms/learning/snapshot_file.hpp"

#include "policies/algorithms/learning/state_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace sofof::policies {

namespace {

constexpr std::string_view first_line = "sofof snapshot 1";
constexpr std::string_view last_line = "learned";

/// The lines of a header, one after the other.
class header_reader {
public:
  explicit header_reader(std::string_view text) : rest_{text} {}

  /// @returns the next line without its end.
  std::string_view next() {
    const auto end = std::min(rest_.find('\n'), rest_.size());
    const auto line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    return line;
  }
  std::size_t number() const { return number_; } ///< Of that line, from 1.
  std::string_view rest() const { return rest_; }

private:
  std::string_view rest_;
  std::size_t number_ = 0;
};

/// @returns what follows a key in a line; nullopt for another key.
std::optional<std::string_view> value_of(std::string_view line,
                                         std::string_view key) {
  if (!line.starts_with(key) || line.size() <= key.size()
      || line[key.size()] != ' ')
    return std::nullopt;
  return line.substr(key.size() + 1);
}

} // namespace

std::string snapshot_file(const snapshot_header& header,
                          std::string_view learned) {
  assert(header.seeds >= 1);
  auto text = fmt::format("{}\npolicy {}\nshape {}\n", first_line,
                          header.policy, header.shape);
  for (const auto& name : header.scenarios)
    text += fmt::format("scenario {}\n", name);
  for (const auto& change : header.changes)
    text += fmt::format("set {}\n", change);
  text += fmt::format("seeds {} to {}\nprogram {}\n{}\n", header.first_seed,
                      header.first_seed
                          + static_cast<std::int64_t>(header.seeds) - 1,
                      header.program, last_line);
  text += learned;
  return text;
}

std::string_view learned_in(std::string_view text) {
  header_reader lines{text};
  if (lines.next() != first_line)
    return text;
  while (!lines.rest().empty())
    if (lines.next() == last_line)
      return lines.rest();
  return {};
}

std::optional<std::string> restore_from(std::string_view text,
                                        local_policy& policy) {
  const auto* use = policy.learned_from();
  assert(use);
  header_reader lines{text};
  const auto refuse = [&](const std::string& why) {
    return fmt::format("line {}: {}", lines.number(), why);
  };
  if (lines.next() != first_line)
    return refuse(fmt::format("expected \"{}\"", first_line));
  const auto whose = value_of(lines.next(), "policy");
  if (!whose)
    return refuse("expected \"policy NAME\"");
  if (*whose != policy.name())
    return refuse(fmt::format("it is of the policy \"{}\", not of \"{}\"",
                              *whose, policy.name()));
  const auto shape = value_of(lines.next(), "shape");
  if (shape != use->shape)
    return refuse(fmt::format("it has the shape \"{}\", but this policy has "
                              "\"{}\"",
                              shape.value_or(""), use->shape));
  while (lines.next() != last_line)
    if (lines.rest().empty())
      return refuse(fmt::format("expected a line \"{}\"", last_line));
  return policy.restore(placed_in(text, lines.rest()));
}

} // namespace sofof::policies
