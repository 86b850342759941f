// Reads a process line by line.
#include "experiments/sil/member.hpp"

#include <array>
#include <csignal>
#include <span>
#include <utility>

namespace sofof::experiments {

namespace {

/// Of those that are kept for questions; its file has all.
constexpr std::size_t most_lines = 200;

constexpr std::size_t longest_line = 4096;

child_setup setup_of(std::vector<std::string> command) {
  child_setup setup;
  setup.command = std::move(command);
  setup.ends_with_thread = true;
  return setup;
}

} // namespace

member::member(std::string name, std::vector<std::string> command,
               const std::filesystem::path& log,
               std::function<void(std::string_view)> on_line)
    : name_{std::move(name)}, child_{setup_of(std::move(command))}, log_{log},
      on_line_{std::move(on_line)} {}

void member::read() {
  std::array<std::byte, 4096> some{};
  while (!is_silent_) {
    const auto count = child_.read_some(some);
    if (count && *count == 0)
      return;
    is_silent_ = !count;
    for (const auto octet : std::span{some}.first(count.value_or(0)))
      if (const auto c = static_cast<char>(octet); c == '\n')
        end_line();
      else if (line_.size() < longest_line)
        line_ += c;
  }
  if (!line_.empty())
    end_line();
}

void member::end_line() {
  log_ << line_ << std::endl;
  if (on_line_)
    on_line_(line_);
  if (lines_.size() == most_lines)
    lines_.erase(lines_.begin());
  lines_.push_back(std::exchange(line_, {}));
}

std::optional<std::string> member::word_behind(std::string_view begin) const {
  for (const auto& line : lines_)
    if (const auto at = line.find(begin); at != line.npos) {
      const auto rest = std::string_view{line}.substr(at + begin.size());
      return std::string{rest.substr(0, rest.find_first_of(" ;,"))};
    }
  return std::nullopt;
}

std::string member::last_line() const {
  return lines_.empty() ? std::string{} : lines_.back();
}

void member::interrupt() {
  kill(child_.id(), SIGTERM);
}

child_end member::wait_for_end(std::chrono::seconds patience) {
  constexpr std::chrono::milliseconds between_looks{20};
  const auto last = child::clock::now() + patience;
  for (;;) {
    read();
    const auto now = child::clock::now();
    if (child_.poll_end() || now >= last)
      break;
    child_.wait(false, now + between_looks);
  }
  read();
  return child_.stop({});
}

} // namespace sofof::experiments
