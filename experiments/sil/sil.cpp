// Starts processes in the order in which they need each other.
#include "experiments/sil/sil.hpp"

#include "experiments/sil/member.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <ostream>
#include <poll.h>
#include <stdexcept>
#include <utility>

namespace sofof::experiments {

namespace {

constexpr std::chrono::seconds longest_start{20}, longest_end{10};

constexpr int interrupted_exit = 130;

/// A process that others need has not begun.
struct not_ready : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using words = std::vector<std::string>;

words operator+(words a, const words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Broker and providers, and then the cars.
class loop {
public:
  loop(const sil_options& what, const std::atomic<bool>& interrupted,
       std::ostream& console)
      : what_{what}, interrupted_{interrupted}, console_{console} {}

  int run() {
    auto code = interrupted_exit;
    try {
      if (!what_.directly)
        start_broker();
      for (const auto& name : what_.providers)
        start_provider(name);
      start_cars();
      code = drive();
    } catch (const not_ready& problem) {
      if (!interrupted_) {
        console_ << problem.what() << std::endl;
        code = 1;
      }
    }
    end_servers();
    return code != 0 ? code : exit_code_;
  }

private:
  void start_broker() {
    auto& broker = start("broker", {"broker", "--listen", "127.0.0.1:0"});
    url_ = fmt::format("amqp://{}", await(broker, "listens on "));
  }

  void start_provider(const std::string& name) {
    const auto of = "provider_" + name;
    const auto folder = (what_.out / of).string();
    const auto way = what_.directly ? words{"--listen", "127.0.0.1:0"}
                                    : words{"--broker", url_};
    auto& provider = start(of, words{"provide", what_.scenario, "--name", name,
                                     "--quiet", "--out", folder}
                                   + way + what_.changes);
    if (what_.directly)
      where_ =
          std::move(where_)
          + words{"--provider",
                  fmt::format("{}={}", name, await(provider, "listens on "))};
    else
      await(provider, "connected to the broker ");
  }

  void start_cars() {
    if (!what_.directly)
      where_ = {"--broker", url_};
    const auto folder = (what_.out / "cars").string();
    cars_ = std::make_unique<member>(
        "cars",
        words{what_.program.string(), "drive", what_.scenario, "--out", folder}
            + where_ + what_.changes + what_.for_cars,
        what_.out / "cars.log",
        [this](std::string_view line) { console_ << line << std::endl; });
  }

  member& start(const std::string& name, const words& arguments) {
    servers_.push_back(std::make_unique<member>(
        name, words{what_.program.string()} + arguments,
        what_.out / (name + ".log")));
    return *servers_.back();
  }

  /// @returns the word that follows these in what a process says.
  std::string await(member& one, std::string_view text) {
    const auto last = child::clock::now() + longest_start;
    for (;;) {
      one.read();
      if (auto found = one.word_behind(text))
        return *found;
      const auto end = one.poll_end();
      if (end || interrupted_ || child::clock::now() > last)
        throw not_ready(
            fmt::format("{} {}{}{}", one.name(),
                        end ? end->in_words() : "was not ready within 20 s",
                        one.last_line().empty() ? "" : ": ", one.last_line()));
      rest({&one});
    }
  }

  /// Waits a little, or until one of them says something.
  static void rest(const std::vector<const member*>& members) {
    constexpr int longest_ms = 50;
    std::vector<pollfd> all;
    for (const auto* one : members)
      if (!one->is_silent())
        all.push_back({one->socket(), POLLIN, 0});
    poll(all.data(), all.size(), longest_ms);
  }

  /// @returns the exit code of the cars.
  int drive() {
    while (!cars_->poll_end() && !interrupted_) {
      cars_->read();
      std::erase_if(servers_, [this](const auto& one) {
        one->read();
        const auto end = one->poll_end();
        if (end)
          complain(*one, *end);
        return end.has_value();
      });
      std::vector<const member*> all{cars_.get()};
      for (const auto& one : servers_)
        all.push_back(one.get());
      rest(all);
    }
    if (interrupted_)
      cars_->interrupt();
    const auto end = cars_->wait_for_end(longest_end);
    if (end.signal == 0)
      return end.code;
    complain(*cars_, end);
    return 1;
  }

  void end_servers() {
    std::ranges::reverse(servers_); // the broker last
    for (const auto& one : servers_) {
      one->interrupt();
      if (const auto end = one->wait_for_end(longest_end); end.code != 0)
        complain(*one, end);
    }
  }

  void complain(const member& one, const child_end& end) {
    exit_code_ = 1;
    console_ << fmt::format("{} {}", one.name(), end.in_words());
    if (const auto line = one.last_line(); !line.empty())
      console_ << ": " << line;
    console_ << std::endl;
  }

  const sil_options& what_;
  const std::atomic<bool>& interrupted_;
  std::ostream& console_;
  std::string url_;
  words where_; // how cars reach providers
  std::vector<std::unique_ptr<member>> servers_;
  std::unique_ptr<member> cars_;
  int exit_code_ = 0;
};

} // namespace

int run_sil(const sil_options& what, const std::atomic<bool>& interrupted,
            std::ostream& console) {
  return loop{what, interrupted, console}.run();
}

} // namespace sofof::experiments
