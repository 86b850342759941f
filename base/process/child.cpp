// Between fork and exec only what is allowed there: no memory is allocated.
#include "base/process/child.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace sofof {

namespace fs = std::filesystem;

namespace {

/// Why a child did not become the program, as it tells its parent.
struct start_failure {
  enum : int { none, its_folder, its_limits, its_cgroup, its_file } what = none;
  int error = 0;

  std::string_view thing() const {
    constexpr std::string_view names[] = {"", "its folder", "its limits",
                                          "its cgroup", "its file"};
    return names[what];
  }
};

/// All that a child needs, made before it is forked.
struct prepared_child {
  std::vector<char*> arguments;
  std::vector<char*> environment;
  std::string file;
  std::string folder;
  std::string cgroup; // the file that takes processes in
  child_limits limits;
  pid_t parent = 0; // it kills the child when its thread ends; 0: it does not
};

/// Open in a child beside its standard files.
constexpr int first_other_file = STDERR_FILENO + 1;

void set_limit(int resource, std::uint64_t most, start_failure& failed) {
  if (most == 0)
    return;
  const auto which = static_cast<__rlimit_resource>(resource);
  rlimit both{};
  if (getrlimit(which, &both) == 0) // which nobody may raise
    both.rlim_max = std::min<rlim_t>(both.rlim_max, most);
  both.rlim_cur = both.rlim_max;
  if (setrlimit(which, &both) != 0)
    failed = {start_failure::its_limits, errno};
}

void enter_cgroup(const char* cgroup, start_failure& failed) {
  const auto fd = open(cgroup, O_WRONLY | O_CLOEXEC);
  if (fd < 0 || write(fd, "0", 1) != 1)
    failed = {start_failure::its_cgroup, errno};
}

/// Signals are as a program expects them that a shell starts.
void reset_signals() {
  for (const auto number :
       {SIGPIPE, SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGCHLD, SIGXFSZ})
    signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// In the child.
[[noreturn]] void become_program(const prepared_child& what, int socket,
                                 int report) {
  constexpr auto cannot_start = 127;
  start_failure failed;
  setpgid(0, 0);
  reset_signals();
  if (what.parent != 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != what.parent)
      _exit(cannot_start);
  }
  dup2(socket, STDIN_FILENO);
  dup2(socket, STDOUT_FILENO);
  close_range(first_other_file, ~0U, CLOSE_RANGE_CLOEXEC);
  if (!what.cgroup.empty())
    enter_cgroup(what.cgroup.c_str(), failed);
  if (!what.folder.empty() && chdir(what.folder.c_str()) != 0)
    failed = {start_failure::its_folder, errno};
  set_limit(RLIMIT_AS, what.limits.memory_octets, failed);
  set_limit(RLIMIT_CPU, what.limits.cpu_s, failed);
  if (failed.what == start_failure::none) {
    execve(what.file.c_str(), what.arguments.data(), what.environment.data());
    failed = {start_failure::its_file, errno};
  }
  [[maybe_unused]] const auto told = write(report, &failed, sizeof failed);
  _exit(cannot_start);
}

[[noreturn]] void refuse_to_start(std::string_view name, std::string_view what,
                                  int error) {
  throw input_error{fmt::format("the program \"{}\" cannot be started: {}: {}.",
                                name, what, std::strerror(error))};
}

/// A pair of ends, of what the system makes two of.
struct both_ends {
  descriptor ours;
  descriptor its;
};

/// Waits until the child is the program, or has said why not.
start_failure start_outcome(int report) {
  start_failure failed;
  ssize_t count = 0;
  do
    count = read(report, &failed, sizeof failed);
  while (count < 0 && errno == EINTR);
  return count == sizeof failed ? failed : start_failure{};
}

/// @returns the name of a variable in "NAME=value".
std::string_view variable_of(std::string_view assignment) {
  return assignment.substr(0, assignment.find('='));
}

/// The strings outlive what is made of them.
prepared_child prepare_child(const child_setup& setup,
                             std::vector<std::string>& words,
                             std::vector<std::string>& variables) {
  const auto file = find_program(setup.command.front(), setup.folder);
  if (!file)
    throw input_error{
        fmt::format("there is no program \"{}\".", setup.command.front())};
  std::error_code failed;
  const auto whole = fs::absolute(*file, failed);
  if (failed)
    refuse_to_start(words.front(), "our own folder", failed.value());
  for (auto** one = environ; *one; ++one) {
    bool is_replaced = false;
    for (const auto& other : setup.environment)
      is_replaced |= variable_of(other) == variable_of(*one);
    if (!is_replaced)
      variables.emplace_back(*one);
  }
  variables.insert(variables.end(), setup.environment.begin(),
                   setup.environment.end());
  prepared_child made{.arguments = {},
                      .environment = {},
                      .file = whole.string(),
                      .folder = setup.folder.string(),
                      .cgroup = {},
                      .limits = setup.limits,
                      .parent = setup.ends_with_thread ? getpid() : 0};
  if (!setup.limits.cgroup.empty())
    made.cgroup = (setup.limits.cgroup / "cgroup.procs").string();
  for (auto& word : words)
    made.arguments.push_back(word.data());
  made.arguments.push_back(nullptr);
  for (auto& one : variables)
    made.environment.push_back(one.data());
  made.environment.push_back(nullptr);
  return made;
}

/// @returns the same file under a number that is none of the standard files',
/// which may be closed here; what the child has of those replaces it there.
descriptor beside_standard_files(int fd) {
  descriptor given{fd};
  if (fd >= first_other_file)
    return given;
  return descriptor{fcntl(fd, F_DUPFD_CLOEXEC, first_other_file)};
}

/// @returns whether a call may be made again that has failed.
bool would_wait(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

} // namespace

std::string child_end::in_words() const {
  return signal == 0 ? fmt::format("exited with {}", code)
                     : fmt::format("was ended by signal {} ({})", signal,
                                   strsignal(signal));
}

child::child(const child_setup& setup) {
  assert(!setup.command.empty());
  auto words = setup.command;
  std::vector<std::string> variables;
  const auto prepared = prepare_child(setup, words, variables);
  std::array<int, 2> fds{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds.data()) != 0)
    refuse_to_start(words.front(), "a socket", errno);
  both_ends talk{beside_standard_files(fds[0]), beside_standard_files(fds[1])};
  if (pipe2(fds.data(), O_CLOEXEC) != 0)
    refuse_to_start(words.front(), "a pipe", errno);
  both_ends report{beside_standard_files(fds[0]),
                   beside_standard_files(fds[1])};
  if (!talk.ours || !talk.its || !report.ours || !report.its)
    refuse_to_start(words.front(), "a file", errno);
  fcntl(talk.ours.get(), F_SETFL, O_NONBLOCK);
  pid_ = fork();
  if (pid_ < 0)
    refuse_to_start(words.front(), "a process", errno);
  if (pid_ == 0)
    become_program(prepared, talk.its.get(), report.its.get());
  setpgid(pid_, pid_); // whoever of the two comes first
  report.its = {};
  socket_ = std::move(talk.ours);
  if (const auto failed = start_outcome(report.ours.get());
      failed.what != start_failure::none) {
    reap();
    refuse_to_start(words.front(), failed.thing(), failed.error);
  }
  // Only now: this thread has waited for it to become the program.
  if (setup.limits.nice > 0)
    setpriority(PRIO_PROCESS, static_cast<id_t>(pid_),
                getpriority(PRIO_PROCESS, 0) + setup.limits.nice);
}

child::~child() {
  socket_ = {};
  if (pid_ > 0 && !poll_end()) {
    kill_now();
    reap();
  }
}

std::optional<std::size_t>
child::write_some(std::span<const std::byte> octets) {
  const auto count =
      send(socket_.get(), octets.data(), octets.size(), MSG_NOSIGNAL);
  if (count >= 0)
    return static_cast<std::size_t>(count);
  return would_wait(errno) ? std::optional<std::size_t>{0} : std::nullopt;
}

std::optional<std::size_t> child::read_some(std::span<std::byte> into) {
  assert(!into.empty());
  const auto count = recv(socket_.get(), into.data(), into.size(), 0);
  if (count > 0)
    return static_cast<std::size_t>(count);
  return count < 0 && would_wait(errno) ? std::optional<std::size_t>{0}
                                        : std::nullopt;
}

bool child::wait(bool to_write, clock::time_point until) const {
  constexpr std::chrono::hours longest_poll{1}; // it counts ms in an int
  for (;;) {
    const auto left = std::min<std::chrono::milliseconds>(
        std::chrono::ceil<std::chrono::milliseconds>(until - clock::now()),
        longest_poll);
    pollfd one{socket_.get(),
               static_cast<short>(to_write ? POLLIN | POLLOUT : POLLIN), 0};
    const auto ready =
        poll(&one, 1, static_cast<int>(std::max<long>(left.count(), 0)));
    const auto again =
        ready == 0 ? clock::now() < until : ready == -1 && errno == EINTR;
    if (!again)
      return ready != 0;
  }
}

std::optional<child_end> child::poll_end() {
  if (end_)
    return end_;
  siginfo_t found{};
  const auto result = waitid(P_PID, static_cast<id_t>(pid_), &found,
                             WEXITED | WNOHANG | WNOWAIT);
  if (result == 0 && found.si_pid == 0)
    return std::nullopt;
  return reap();
}

std::optional<child_end> child::await_end(std::chrono::milliseconds longest) {
  constexpr std::chrono::milliseconds between_looks{1};
  const auto last = clock::now() + longest;
  while (!poll_end() && clock::now() < last)
    std::this_thread::sleep_for(between_looks);
  return end_;
}

child_end child::stop(std::chrono::milliseconds grace) {
  socket_ = {};
  if (poll_end())
    return *end_;
  send_signal(SIGTERM);
  if (!await_end(grace)) {
    kill_now();
    reap();
  }
  return *end_;
}

void child::kill_now() {
  if (!end_)
    send_signal(SIGKILL);
}

/// A child may have left its group for another one.
void child::send_signal(int number) const {
  assert(pid_ > 0 && !end_);
  kill(-pid_, number);
  kill(pid_, number);
}

/// Its number is its own until it is reaped, and so is that of its group: what
/// it has started ends before.
child_end child::reap() {
  assert(pid_ > 0 && !end_);
  siginfo_t found{};
  int looked = 0;
  do
    looked = waitid(P_PID, static_cast<id_t>(pid_), &found, WEXITED | WNOWAIT);
  while (looked != 0 && errno == EINTR);
  end_.emplace();
  if (looked != 0) // somebody else has reaped it: the number may be another's
    return *end_;
  kill(-pid_, SIGKILL);
  int status = 0;
  pid_t reaped = 0;
  do
    reaped = waitpid(pid_, &status, 0);
  while (reaped < 0 && errno == EINTR);
  if (reaped == pid_ && WIFEXITED(status))
    end_->code = WEXITSTATUS(status);
  if (reaped == pid_ && WIFSIGNALED(status))
    end_->signal = WTERMSIG(status);
  return *end_;
}

std::vector<std::string> command_words(std::string_view text) {
  std::vector<std::string> words;
  bool in_word = false;
  char quote = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    auto c = text[k];
    const auto is_blank = c == ' ' || c == '\t' || c == '\n';
    if (quote == 0 && is_blank) {
      in_word = false;
      continue;
    }
    if (!std::exchange(in_word, true))
      words.emplace_back();
    if (c == quote) {
      quote = 0;
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else {
      if (c == '\\' && quote != '\'' && k + 1 < text.size())
        c = text[++k];
      words.back() += c;
    }
  }
  if (quote != 0)
    throw std::invalid_argument{
        fmt::format("the quote {} is not closed", quote)};
  return words;
}

std::optional<fs::path> find_program(std::string_view name,
                                     const fs::path& folder) {
  const auto usable = [](const fs::path& file) {
    std::error_code ignored;
    return fs::is_regular_file(file, ignored)
           && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != name.npos) {
    const auto file = folder / name;
    return usable(file) ? std::optional{file} : std::nullopt;
  }
  const auto* given = std::getenv("PATH");
  std::string_view left = given ? given : "/usr/bin:/bin";
  while (!name.empty()) {
    const auto end = left.find(':');
    const auto file = fs::path{left.substr(0, end)} / name;
    if (usable(file))
      return file;
    if (end == left.npos)
      break;
    left.remove_prefix(end + 1);
  }
  return std::nullopt;
}

std::vector<command_file> command_files(const std::vector<std::string>& words,
                                        const fs::path& folder) {
  std::vector<command_file> all;
  const auto add = [&](const std::string& name) {
    std::error_code ignored;
    const auto is_known = std::ranges::any_of(
        all, [&](const auto& x) { return !x.is_sought && x.name == name; });
    if (!name.empty() && !is_known
        && fs::is_regular_file(folder / name, ignored))
      all.push_back({name, folder / name});
  };
  if (!words.empty() && words.front().find('/') == std::string::npos)
    if (const auto program = find_program(words.front(), folder))
      all.push_back({words.front(), *program, true});
  for (const auto& word : words) {
    add(word);
    if (const auto equals = word.find('='); equals != word.npos)
      add(word.substr(equals + 1));
  }
  return all;
}

} // namespace sofof
