// In, turned, out; the next.
#include "apps/filter_lines.hpp"

#include "base/input_error.hpp"
#include "base/text/json.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <system_error>

namespace sofof::apps {

namespace {

struct input_line {
  std::string text;
  bool is_too_long = false; ///< Then `text` is its beginning.
};

/// @returns false at the end. Streams tell an end and a fault the same way.
bool read_line(input_line& line) {
  line.text.clear();
  line.is_too_long = false;
  int c = EOF;
  while ((c = std::getc(stdin)) != EOF && c != '\n')
    if (line.text.size() < longest_line)
      line.text += static_cast<char>(c);
    else
      line.is_too_long = true;
  if (std::ferror(stdin))
    throw input_error(fmt::format("standard input cannot be read: {}",
                                  std::generic_category().message(errno)));
  return c != EOF || !line.text.empty();
}

} // namespace

int filter_lines(const std::vector<std::string>& words,
                 const std::function<turned_line(const std::string&)>& turn) {
  std::signal(SIGPIPE, SIG_DFL); // who reads no more ends us without a word
  auto exit_code = 0;
  const auto print = [&](turned_line line, std::uint64_t number) {
    if (!line.error.empty()) {
      exit_code = 1;
      line.text.clear();
      json_object object{line.text, json_object::layout::one_line};
      object.member("error", line.error);
      object.member("line", number);
    }
    std::cout << line.text
              << std::endl; // NOLINT(performance-avoid-endl): at once
  };
  std::uint64_t number = 0;
  for (const auto& word : words) {
    if (word != "-") {
      print(turn(word), ++number);
      continue;
    }
    for (input_line line; std::cout && read_line(line);) {
      ++number;
      if (line.is_too_long)
        print({{},
               fmt::format("the line is longer than {} MiB",
                           longest_line / (1024 * 1024))},
              number);
      else if (line.text.find_first_not_of(" \t\r") != line.text.npos)
        print(turn(line.text), number);
    }
  }
  return exit_code;
}

} // namespace sofof::apps
