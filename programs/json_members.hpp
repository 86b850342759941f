// The members of an object of a stranger, each of which is known.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace sofof::programs {

/// @returns the object that a line is. @throws answer_error for all else, and
/// where a member stands twice.
std::shared_ptr<const nlohmann::json> parse_object(std::string_view line);

/// Reads members by their names. Each call throws answer_error when a member is
/// of another kind.
class json_members {
public:
  /// @param of  Outlives it.
  /// @param where  Before the names of members, in complaints: "requests[0].".
  explicit json_members(const nlohmann::json& of, std::string where = {});

  bool has(std::string_view name);
  /// @returns the member; @throws answer_error also when it is missing.
  const nlohmann::json& need(std::string_view name);

  std::string text(std::string_view name);
  bool flag(std::string_view name);
  std::uint64_t count(std::string_view name);
  /// @returns a number from `least` to `most`.
  double number(std::string_view name, double least, double most);
  /// @returns a list.
  const nlohmann::json& list(std::string_view name);

  /// Nothing but what was asked for is there.
  void finish() const;

  [[noreturn]] void refuse(std::string_view name, std::string_view why) const;

private:
  const nlohmann::json& of_;
  std::string where_;
  std::set<std::string, std::less<>> known_;
};

} // namespace sofof::programs
