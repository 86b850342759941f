// One run in a process of its own.
#include "experiments/torture/trial.hpp"

#include "base/options/toml_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

namespace sofof::experiments::torture {

namespace fs = std::filesystem;

namespace {

constexpr auto complaint_name = "complaint", run_name = "run";
constexpr std::string_view broken_word = "broken ";
/// A run needs seconds; one that goes round and round for ever is ended, and so
/// is one that waits for ever.
constexpr rlim_t longest_cpu_s = 120;
constexpr unsigned longest_wall_s = 1200;

/// @returns the last line of what a process has complained.
std::string complaint_in(const fs::path& folder) {
  auto text = read_text(folder / complaint_name).value_or("");
  while (text.ends_with('\n'))
    text.pop_back();
  const auto last = text.rfind('\n');
  return last == std::string::npos ? text : text.substr(last + 1);
}

verdict ended_badly(const std::string& how, const fs::path& folder) {
  const auto why = complaint_in(folder);
  return {{}, {{"it_ends", why.empty() ? how : how + ": " + why}}};
}

void write_all(int pipe, std::string_view text) {
  while (!text.empty()) {
    const auto count = write(pipe, text.data(), text.size());
    if (count <= 0)
      return; // the parent has ended
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// In the child; does not return.
[[noreturn]] void run_in_child(const tried_scenario& what,
                               const fs::path& folder, int pipe) {
  const rlimit cpu{longest_cpu_s, longest_cpu_s + 1}, core{0, 0};
  setrlimit(RLIMIT_CPU, &cpu);
  setrlimit(RLIMIT_CORE, &core);
  alarm(longest_wall_s);
  std::signal(SIGINT, SIG_IGN); // the parent tells
  std::signal(SIGTERM, SIG_DFL);
  const auto file = open((folder / complaint_name).c_str(),
                         O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  dup2(file, STDERR_FILENO);
  try {
    write_all(pipe, text_of(try_here(what, folder / run_name)));
    _exit(0);
  } catch (const std::exception& problem) {
    fmt::print(stderr, "{}\n", problem.what());
    std::fflush(stderr);
    _exit(1);
  }
}

} // namespace

std::string text_of(const verdict& v) {
  std::string text;
  for (const auto x : v.counts.sums())
    text += fmt::format("{}\n", x);
  for (const auto& [promise, what] : v.broken)
    text += fmt::format("{}{} {}\n", broken_word, promise, what);
  return text;
}

std::optional<verdict> parse_verdict(std::string_view text) {
  verdict v;
  const auto line = [&text]() {
    const auto end = text.find('\n');
    const auto one = text.substr(0, end);
    text.remove_prefix(end == text.npos ? text.size() : end + 1);
    return one;
  };
  for (auto& sum : v.counts.sums()) {
    const auto one = line();
    const auto [end, error] =
        std::from_chars(one.data(), one.data() + one.size(), sum);
    if (error != std::errc{} || end != one.data() + one.size())
      return std::nullopt;
  }
  while (!text.empty()) {
    auto one = line();
    if (!one.starts_with(broken_word))
      return std::nullopt;
    one.remove_prefix(broken_word.size());
    const auto space = one.find(' ');
    if (space == one.npos)
      return std::nullopt;
    v.broken.push_back({std::string{one.substr(0, space)},
                        std::string{one.substr(space + 1)}});
  }
  return v;
}

verdict try_here(const tried_scenario& tried, const fs::path& folder) {
  const auto loaded = load(tried);
  const auto hostile = run(loaded, folder);
  auto finished = read_finished(loaded.what, folder);
  finished.has_liars = loaded.lies.has_value();
  finished.has_ghosts = loaded.hostile.has_value();
  verdict found{count(finished), check(finished)};
  found.counts[counted::hostile] = static_cast<double>(hostile);
  return found;
}

trial::trial(const tried_scenario& what, fs::path folder)
    : folder_{std::move(folder)} {
  fs::remove_all(folder_);
  fs::create_directories(folder_);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) == 0)
    child_ = fork();
  if (child_ == 0)
    run_in_child(what, folder_, ends[1]);
  if (child_ < 0)
    throw std::runtime_error{
        fmt::format("no process can be started: {}.", std::strerror(errno))};
  close(ends[1]);
  pipe_ = ends[0];
}

trial::~trial() {
  close(pipe_);
  if (child_ > 0) {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

void trial::keep_results(const fs::path& at) const {
  fs::remove_all(at);
  if (fs::exists(folder_ / run_name))
    fs::rename(folder_ / run_name, at);
}

std::optional<verdict> trial::poll_verdict() {
  std::array<char, 4096> some{};
  const auto count = read(pipe_, some.data(), some.size());
  if (count > 0)
    said_.append(some.data(), static_cast<std::size_t>(count));
  return count == 0 ? std::optional{end()} : std::nullopt;
}

verdict trial::end() {
  int status = 0;
  waitpid(child_, &status, 0);
  child_ = -1;
  if (WIFSIGNALED(status)) {
    const auto signal = WTERMSIG(status);
    return ended_badly(signal == SIGXCPU || signal == SIGALRM
                           ? "it went on for too long"
                           : fmt::format("it died by signal {} ({})", signal,
                                         strsignal(signal)),
                       folder_);
  }
  const auto found = parse_verdict(said_);
  return found && WEXITSTATUS(status) == 0
             ? *found
             : ended_badly("it ended without results", folder_);
}

verdict try_apart(const tried_scenario& what, const fs::path& folder,
                  const fs::path& kept) {
  trial running{what, folder};
  for (;;)
    if (auto found = running.poll_verdict()) {
      if (!kept.empty())
        running.keep_results(kept);
      return *found;
    }
}

} // namespace sofof::experiments::torture
