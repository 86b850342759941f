// A program that serves as a function, and does odd things when it is told to:
// odd_program WHAT AFTER does WHAT at the input after so many answers.
#include "examples/programs/service_program.hpp"
#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace {

using service_program::octets;

/// Never returns.
[[noreturn]] void stand_still() {
  for (;;)
    std::this_thread::sleep_for(std::chrono::hours{1});
}

void write_text(const std::string& text) {
  service_program::detail::write_all({text.begin(), text.end()});
}

std::optional<octets> answer(const std::string& what,
                             const service_program::input& x) {
  constexpr std::size_t much = 64 << 20;
  if (what == "exits")
    std::exit(3);
  if (what == "dies")
    std::raise(SIGKILL);
  if (what == "is_silent")
    stand_still();
  if (what == "closes") {
    close(STDIN_FILENO);
    close(STDOUT_FILENO);
    stand_still();
  }
  if (what == "babbles")
    for (;;)
      service_program::detail::send(17, {}, octets(1000));
  if (what == "talks_nonsense")
    write_text("Segmentation fault, or whatever it prints by mistake");
  if (what == "sends_much")
    return octets(100'000);
  if (what == "foresees")
    service_program::detail::send(17, {0, x.number + 1, {}}, {});
  if (what == "eats")
    for (;;) {
      constexpr std::size_t page = 4096;
      auto* some = static_cast<volatile char*>(std::malloc(much));
      for (std::size_t i = 0; i < much; i += page)
        some[i] = 1;
    }
  if (what == "answers_twice") {
    service_program::detail::send(17, {0, x.number, {}}, x.what);
    return octets{'2'};
  }
  if (what == "answers_and_exits") {
    service_program::detail::send(17, {0, x.number, {}}, x.what);
    std::exit(3);
  }
  if (what == "answers_and_babbles") {
    service_program::detail::send(17, {0, x.number, {}}, x.what);
    write_text("Segmentation fault, or whatever it prints by mistake");
    std::exit(3);
  }
  if (what == "leaves_another") {
    if (fork() == 0)
      stand_still(); // with its standard files
    std::exit(4);
  }
  if (what == "has_none")
    return std::nullopt;
  if (what == "is_slow")
    std::this_thread::sleep_for(std::chrono::milliseconds{60});
  if (what == "tells_its_process") {
    const auto id = std::to_string(getpid());
    return octets{id.begin(), id.end()};
  }
  return x.what;
}

} // namespace

int main(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  const auto after = count > 2 ? std::strtoull(words[2], nullptr, 10) : 0;
  if (what == "leaves_its_group") {
    setpgid(0, getpgid(getppid()));
    std::signal(SIGTERM, SIG_IGN);
    write_text("it has left");
  }
  if (what == "never_ready" || what == "leaves_its_group")
    stand_still();
  if (what == "ends_at_once")
    return 3;
  std::string told;
  service_program::handlers does;
  does.configure = [&](const service_program::configuration& all) {
    for (const auto& [key, value] : all)
      told += key + "=" + value + " ";
  };
  does.activate = [&](bool is_active, const auto& all) {
    told += is_active ? "on " : "off ";
    for (const auto& [key, value] : all)
      told += key + "=" + value + " ";
  };
  does.run = [&](const service_program::input& x) -> std::optional<octets> {
    if (what == "tells_its_steps")
      return octets{told.begin(), told.end()};
    return x.number > after ? answer(what, x) : std::optional{x.what};
  };
  return service_program::serve(does);
}
