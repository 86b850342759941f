// Orders of strangers, each in a process of its own.
#include "scenario/sweep/child_run.hpp"

#include "scenario/sweep/order_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <optional>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace sofof {

namespace fs = std::filesystem;

namespace {

constexpr auto for_its_owner = 0600;
constexpr auto cannot_start = 127;
/// This process answers in time even while all cores are busy with runs.
constexpr auto patience = 5;
constexpr auto glance_ms = 20;

/// In the child, between fork and exec: only what is allowed there.
[[noreturn]] void become(char* const* words, const char* said,
                         const child_limits& limits, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
    _exit(cannot_start);
  setpgid(0, 0); // Ctrl-C is for this process
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  nice(patience);
  const rlimit files{limits.largest_file, limits.largest_file};
  constexpr rlimit dumps{0, 0};
  const auto nothing = open("/dev/null", O_RDWR);
  const auto words_to = open(said, O_WRONLY | O_CREAT | O_TRUNC, for_its_owner);
  const auto first = std::signal(SIGXFSZ, SIG_IGN) != SIG_ERR
                     && setrlimit(RLIMIT_FSIZE, &files) == 0
                     && setrlimit(RLIMIT_CORE, &dumps) == 0;
  if (!first || dup2(nothing, STDIN_FILENO) < 0
      || dup2(nothing, STDOUT_FILENO) < 0 || dup2(words_to, STDERR_FILENO) < 0)
    _exit(cannot_start);
  close_range(STDERR_FILENO + 1, ~0U, 0);
  execv(words[0], words);
  _exit(cannot_start);
}

/// @returns no more than this process may do itself.
child_limits possible(child_limits wanted) {
  rlimit own{};
  if (getrlimit(RLIMIT_FSIZE, &own) == 0)
    wanted.largest_file =
        std::min<std::uint64_t>(wanted.largest_file, own.rlim_max);
  return wanted;
}

/// A process that does not outlive this object.
class child {
public:
  child(const fs::path& program, const run_order& order,
        const child_limits& limits)
      : said_{order.results().string() + ".said"} {
    std::string words[] = {program.string(),
                           "run",
                           (order.given() / files_of_an_order[0]).string(),
                           "--out",
                           order.results().string(),
                           "--quiet"};
    std::array<char*, std::size(words) + 1> argv{};
    for (std::size_t i = 0; i < std::size(words); ++i)
      argv[i] = words[i].data();
    const auto possible_limits = possible(limits);
    const auto self = getpid();
    pid_ = fork();
    if (pid_ < 0)
      throw std::system_error{errno, std::generic_category(),
                              "no process for it"};
    if (pid_ == 0)
      become(argv.data(), said_.c_str(), possible_limits, self);
    setpgid(pid_, pid_); // whoever is faster
    file_ = static_cast<int>(syscall(SYS_pidfd_open, pid_, 0));
  }
  ~child() {
    if (pid_ > 0) {
      kill(-pid_, SIGKILL); // its group
      waitpid(pid_, nullptr, 0);
    }
    close(file_);
  }
  child(const child&) = delete;
  child& operator=(const child&) = delete;

  /// Waits a little.
  /// @returns how it ended, as waitpid says; nullopt while it runs.
  std::optional<int> glance() {
    pollfd ended{file_, POLLIN, 0};
    poll(&ended, 1, glance_ms);
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) != pid_)
      return std::nullopt;
    pid_ = 0;
    return status;
  }

  /// @returns how much memory it has, octets.
  std::uint64_t memory() const {
    std::ifstream file{fmt::format("/proc/{}/statm", pid_)};
    std::uint64_t all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  }

  /// @returns the sentence that it ended with.
  std::string last_words() const {
    std::ifstream file{said_};
    std::string line;
    std::getline(file, line);
    constexpr std::string_view name = "sofof: ";
    constexpr std::size_t longest = 2000;
    if (line.starts_with(name))
      line.erase(0, name.size());
    return line.substr(0, longest);
  }

private:
  std::string said_;
  pid_t pid_ = -1;
  int file_ = -1;
};

std::string why(int status, const child& ended) {
  if (WIFSIGNALED(status))
    return fmt::format("its process was ended by signal {} ({})",
                       WTERMSIG(status), strsignal(WTERMSIG(status)));
  const auto said = ended.last_words();
  return said.empty() ? "its process ended without a result" : said;
}

} // namespace

child_limits shared_limits(std::size_t runs) {
  const auto pages = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES));
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  return {pages * page / runs, largest_results / 2};
}

void run_as_child(const fs::path& program, const run_order& order,
                  const child_limits& limits) {
  child process{program, order, limits};
  for (;;) {
    if (const auto status = process.glance()) {
      if (!fs::exists(order.results() / "summary.json"))
        throw std::runtime_error{why(*status, process)};
      return;
    }
    if (order.interrupted)
      throw std::runtime_error{"it was interrupted"};
    if (process.memory() > limits.memory)
      throw std::runtime_error{fmt::format(
          "it needs more than {} MiB, which is all that the worker has for one "
          "run; start the worker with a smaller -j",
          limits.memory >> 20)};
  }
}

} // namespace sofof
