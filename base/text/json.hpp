// Objects as JSON text: fixed order, fixed decimals, the same bytes always.
#pragma once

#include "base/text/csv.hpp"

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace sofof {

/// Appends `text` as a JSON string. What is not UTF-8 becomes U+FFFD.
void append_quoted(std::string& out, std::string_view text);

/// Writes one object, member by member, over several indented lines or on a
/// single one.
class json_object {
public:
  enum class layout { lines, one_line };

  json_object(std::string& out, layout how) : json_object{out, how, 1} {}

  json_object(const json_object&) = delete;
  json_object& operator=(const json_object&) = delete;

  /// Closes the object.
  ~json_object();

  void member(std::string_view name, std::string_view text);
  void member(std::string_view name, const char* text) {
    member(name, std::string_view{text});
  }
  void member(std::string_view name, decimal x); ///< null when absent.
  void member(std::string_view name, bool x);
  void member(std::string_view name, std::unsigned_integral auto x) {
    start(name);
    append(out_, std::uint64_t{x});
  }

  /// @returns an object inside this one; it must be closed before the next
  /// member.
  json_object object(std::string_view name);

private:
  json_object(std::string& out, layout how, int depth)
      : out_{out}, how_{how}, depth_{depth} {
    out_ += '{';
  }

  void start(std::string_view name);
  void new_line(int depth);

  std::string& out_;
  layout how_;
  int depth_;
  bool empty_ = true;
};

} // namespace sofof
