// In, turned, out; the next.
#include "apps/line_by_line.hpp"

#include "scenario/json.hpp"

#include <csignal>
#include <cstdint>
#include <iostream>

namespace sofof {

int line_by_line(const std::vector<std::string>& words,
                 const std::function<turned_line(const std::string&)>& turn) {
  std::signal(SIGPIPE, SIG_DFL); // who reads no more ends us without a word
  auto exit_code = 0;
  const auto print = [&](const std::string& line, std::uint64_t number) {
    auto [text, error] = turn(line);
    if (!error.empty()) {
      exit_code = 1;
      text.clear();
      json_object object{text, json_object::layout::one_line};
      object.member("error", error);
      object.member("line", number);
    }
    std::cout << text << std::endl; // NOLINT(performance-avoid-endl): at once
  };
  std::uint64_t number = 0;
  for (const auto& word : words) {
    if (word != "-") {
      print(word, ++number);
      continue;
    }
    for (std::string line; std::cout && std::getline(std::cin, line);) {
      ++number;
      if (line.find_first_not_of(" \t\r") != line.npos)
        print(line, number);
    }
  }
  return exit_code;
}

} // namespace sofof
