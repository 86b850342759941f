// Runs the built program as its user would: arguments, a folder to stand in,
// what it prints, how it ends. Whatever happens, it does not outlive its test.
#pragma once

#include "tests/support/files.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <string>
#include <string_view>
#include <sys/resource.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

namespace sofof::test {

/// Only hung programs take longer, even under sanitizers.
inline constexpr std::chrono::seconds patience{300};

/// How often a child is looked at.
inline constexpr std::chrono::milliseconds glance{5};

/// Waits until something has happened outside of this process.
/// @returns whether it has.
template <class Condition>
bool wait_until(Condition happened) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!happened()) {
    if (std::chrono::steady_clock::now() > end)
      return false;
    std::this_thread::sleep_for(glance);
  }
  return true;
}

/// How a program ended.
struct ending {
  int code = -1;  ///< What it exited with; -1 when a signal ended it.
  int signal = 0; ///< The signal that ended it; SIGKILL when it hung.
  std::string out;
  std::string err;
};

/// What is special about a start.
struct conditions {
  std::string program = SOFOF_PROGRAM;
  rlim_t largest_file = RLIM_INFINITY; ///< bytes; a write beyond it fails.
};

/// A running program. Its output goes to two files beside its folder.
class program {
public:
  /// Starts it.
  /// @param folder  To stand in; exists.
  program(const std::vector<std::string>& arguments,
          const std::filesystem::path& folder, const conditions& how = {})
      : prints_{beside(folder)} {
    auto words = arguments;
    words.insert(words.begin(), how.program);
    std::vector<char*> argv;
    for (auto& word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = fork();
    if (pid_ < 0)
      throw std::system_error{errno, std::generic_category(), "fork"};
    if (pid_ == 0)
      become(argv.data(), folder, how);
  }

  ~program() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    std::error_code ignored;
    std::filesystem::remove(out_, ignored);
    std::filesystem::remove(err_, ignored);
  }

  program(const program&) = delete;
  program& operator=(const program&) = delete;

  void send(int signal) { kill(pid_, signal); }

  /// @returns what it has printed so far.
  std::string printed() const { return read_file(out_); }

  bool runs() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_)
      pid_ = 0;
    return pid_ > 0;
  }

  /// Waits for its end; one that hangs is killed.
  ending wait() {
    if (!wait_until([this] { return !runs(); })) {
      kill(pid_, SIGKILL);
      waitpid(std::exchange(pid_, 0), &status_, 0);
    }
    return {WIFEXITED(status_) ? WEXITSTATUS(status_) : -1,
            WIFSIGNALED(status_) ? WTERMSIG(status_) : 0, read_file(out_),
            read_file(err_)};
  }

private:
  /// Several may stand in one folder.
  static std::string beside(const std::filesystem::path& folder) {
    static std::atomic<int> count = 0;
    return folder.string() + "." + std::to_string(count++);
  }

  /// In the child, between fork and exec: only what is allowed there.
  [[noreturn]] void become(char* const* argv,
                           const std::filesystem::path& folder,
                           const conditions& how) const {
    constexpr auto cannot_start = 127;
    const auto redirect = [](const std::string& file, int to) {
      const auto from = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      return from >= 0 && dup2(from, to) >= 0 && close(from) == 0;
    };
    const auto nothing = open("/dev/null", O_RDONLY);
    if (nothing < 0 || dup2(nothing, STDIN_FILENO) < 0
        || !redirect(out_, STDOUT_FILENO) || !redirect(err_, STDERR_FILENO)
        || chdir(folder.c_str()) != 0)
      _exit(cannot_start);
    signal(SIGHUP, SIG_DFL); // who has started the tests may ignore it
    if (how.largest_file != RLIM_INFINITY) {
      const rlimit limit{how.largest_file, how.largest_file};
      setrlimit(RLIMIT_FSIZE, &limit);
      signal(SIGXFSZ, SIG_IGN); // the write fails instead
    }
    execv(argv[0], argv);
    _exit(cannot_start);
  }

  std::string prints_;
  std::string out_ = prints_ + ".out";
  std::string err_ = prints_ + ".err";
  pid_t pid_ = 0;
  int status_ = 0;
};

/// Runs `sofof` with arguments to its end.
inline ending run_sofof(const std::vector<std::string>& arguments,
                        const std::filesystem::path& folder,
                        const conditions& how = {}) {
  return program{arguments, folder, how}.wait();
}

} // namespace sofof::test
