// What a process says to people, for machines that collect it.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace sofof::apps {

/// Turns each line that is written to it into an object on a line of its own:
/// {"time": "2026-03-07T20:26:35.123Z", "role": "provide", "message": "..."}.
class json_log final : public std::streambuf {
public:
  /// @param to  Outlives it.
  json_log(std::ostream& to, std::string_view role);

private:
  int_type overflow(int_type c) override;
  std::streamsize xsputn(const char* text, std::streamsize size) override;
  int sync() override;
  void add(char c);

  std::ostream& to_;
  std::string role_;
  std::string line_;
};

} // namespace sofof::apps
