// Another program as a child of this process: started with limits, reached over
// a socket pair, stopped, and never left as a zombie.
#pragma once

#include "base/files/descriptor.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace sofof {

/// What the system lets a child have, if it does not let us have less; 0: no
/// limit.
struct child_limits {
  std::uint64_t memory_octets = 0; ///< Of address space: RLIMIT_AS.
  std::uint64_t cpu_s = 0;         ///< In its whole life: RLIMIT_CPU.
  int nice = 0; ///< It steps back behind others by this, 0 to 19.
  /// Folder of a control group that this process may put children into, with
  /// whatever limits it has; empty: none.
  std::filesystem::path cgroup;
};

/// What is started, and how.
struct child_setup {
  /// The program, as `find_program` finds it, and its arguments; not empty.
  std::vector<std::string> command;
  std::filesystem::path folder; ///< It stands there; empty: where we do.
  std::vector<std::string> environment; ///< "NAME=value", besides ours.
  child_limits limits;
  /// The system kills it when the thread that has started it ends, also by a
  /// signal that this process cannot handle.
  bool ends_with_thread = false;
};

/// How a child ended.
struct child_end {
  int code = -1;  ///< What it exited with; -1 when a signal ended it.
  int signal = 0; ///< That signal; 0: none did.

  /// @returns that in words: "exited with 3", "was ended by signal 9 (Killed)".
  std::string in_words() const;
};

/// A running program in a process group of its own. It has one end of a socket
/// pair as its standard input and output, and our standard error; no other file
/// of ours is open in it. No call waits that does not say for what.
class child {
public:
  using clock = std::chrono::steady_clock;

  /// Starts it.
  /// @throws input_error when the system refuses that, with its reason.
  explicit child(const child_setup& setup);

  /// Kills what still runs of its group.
  ~child();

  child(const child&) = delete;
  child& operator=(const child&) = delete;

  pid_t id() const { return pid_; }

  /// @returns our end of the socket pair, which does not block, for `poll`.
  int socket() const { return socket_.get(); }

  /// @returns how much of it the system took, perhaps 0; nullopt if the child
  /// does not read any more.
  std::optional<std::size_t> write_some(std::span<const std::byte> octets);

  /// @returns how much came, perhaps 0; nullopt if nothing will come any more.
  std::optional<std::size_t> read_some(std::span<std::byte> into);

  /// Waits until something can be read, or written, or neither ever again.
  /// @returns false if that was not until then.
  bool wait(bool to_write, clock::time_point until) const;

  /// @returns how it ended; nullopt while it runs.
  std::optional<child_end> poll_end();

  /// Waits for its end.
  /// @returns how it ended; nullopt if it still runs after this time.
  std::optional<child_end> await_end(std::chrono::milliseconds longest);

  /// Closes the socket, asks it to end (SIGTERM), and kills it if it has not
  /// ended after this time.
  child_end stop(std::chrono::milliseconds grace);

  /// Kills it and its group, without waiting for their end.
  void kill_now();

private:
  void send_signal(int number) const;
  child_end reap();

  pid_t pid_ = -1;
  descriptor socket_;
  std::optional<child_end> end_;
};

/// @returns the words of a command: separated by blanks, with quotes ' and "
/// around what has blanks, and \ before a character that stands for itself
/// (not between '). There are no other signs of a shell.
/// @throws std::invalid_argument if a quote is not closed.
std::vector<std::string> command_words(std::string_view text);

/// @param folder  From where a name with a slash is looked for.
/// @returns the file of a program, sought in PATH if its name has no slash;
/// nullopt if there is none that may be executed.
std::optional<std::filesystem::path>
find_program(std::string_view name, const std::filesystem::path& folder);

/// A file that makes what a command does.
struct command_file {
  std::string name; ///< As the command has it.
  std::filesystem::path at;
  bool is_sought = false; ///< In PATH; else it is named from the folder on.
};

/// @param words   Of the command.
/// @param folder  It runs there.
/// @returns its program, if that is there, and what its words name of files:
/// each word, and what is behind a "=" in one. Each once.
std::vector<command_file> command_files(const std::vector<std::string>& words,
                                        const std::filesystem::path& folder);

} // namespace sofof
