// A program that serves SOFOF as a function, in C++17 without any library: copy
// this file. What goes over standard input and output: docs/programs.md.
#pragma once

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <unistd.h>
#include <vector>

namespace service_program {

using octets = std::vector<std::uint8_t>;

/// What a program is configured with, by key: docs/programs.md lists them.
using configuration = std::map<std::string, std::string>;

/// One input.
struct input {
  std::int64_t time_ns = 0; ///< The run's time.
  std::uint64_t number = 0; ///< Rising, from 1.
  octets what;
};

/// What a program does; all but `run` may be left out.
struct handlers {
  /// @returns the result; nullopt if this input has none.
  std::function<std::optional<octets>(const input&)> run;
  std::function<void(const configuration&)> configure = {};
  /// @param told  With `is_active`: the `station` of the vehicle.
  std::function<void(bool is_active, const configuration& told)> activate = {};
};

namespace detail {

constexpr std::size_t header_size = 24;

inline bool read_all(std::uint8_t* to, std::size_t count) {
  while (count > 0) {
    const auto got = read(STDIN_FILENO, to, count);
    if (got == 0 || (got < 0 && errno != EINTR))
      return false;
    if (got > 0) {
      to += got;
      count -= static_cast<std::size_t>(got);
    }
  }
  return true;
}

inline bool write_all(const octets& from) {
  std::size_t done = 0;
  while (done < from.size()) {
    const auto put =
        write(STDOUT_FILENO, from.data() + done, from.size() - done);
    if (put < 0 && errno != EINTR)
      return false;
    if (put > 0)
      done += static_cast<std::size_t>(put);
  }
  return true;
}

/// Of `size` octets, little endian.
inline std::uint64_t number_at(const std::uint8_t* from, int size) {
  std::uint64_t x = 0;
  for (int k = 0; k < size; ++k)
    x |= std::uint64_t{from[k]} << (8 * k);
  return x;
}

inline void append_number(octets& to, std::uint64_t x, int size) {
  for (int k = 0; k < size; ++k)
    to.push_back(static_cast<std::uint8_t>(x >> (8 * k)));
}

inline bool send(std::uint16_t kind, const input& of, const octets& what) {
  octets frame;
  append_number(frame, what.size(), 4);
  append_number(frame, kind, 2);
  append_number(frame, 0, 2);
  append_number(frame, static_cast<std::uint64_t>(of.time_ns), 8);
  append_number(frame, of.number, 8);
  frame.insert(frame.end(), what.begin(), what.end());
  return write_all(frame);
}

inline configuration lines_of(const octets& text) {
  configuration all;
  std::string line;
  for (const auto c : text)
    if (c != '\n') {
      line += static_cast<char>(c);
    } else {
      const auto end = line.find('=');
      if (end != line.npos)
        all[line.substr(0, end)] = line.substr(end + 1);
      line.clear();
    }
  return all;
}

} // namespace detail

/// Serves until it is told to shut down, or nobody is there any more.
/// @returns what `main` returns: 0, or 1 for a frame of no known kind.
inline int serve(const handlers& does) {
  enum { configure = 1, activate, deactivate, shut_down, given };
  enum { ready = 16, result, no_result };
  std::signal(SIGPIPE, SIG_IGN); // a write fails instead
  for (;;) {
    std::uint8_t header[detail::header_size];
    if (!detail::read_all(header, sizeof header))
      return 0;
    input frame;
    frame.what.resize(detail::number_at(header, 4));
    frame.time_ns = static_cast<std::int64_t>(detail::number_at(header + 8, 8));
    frame.number = detail::number_at(header + 16, 8);
    if (!detail::read_all(frame.what.data(), frame.what.size()))
      return 0;
    bool goes_on = true;
    switch (detail::number_at(header + 4, 2)) {
      case configure:
        if (does.configure)
          does.configure(detail::lines_of(frame.what));
        goes_on = detail::send(ready, frame, {});
        break;
      case activate:
      case deactivate:
        if (does.activate)
          does.activate(detail::number_at(header + 4, 2) == activate,
                        detail::lines_of(frame.what));
        break;
      case given: {
        const auto made = does.run(frame);
        goes_on = detail::send(made ? result : no_result, frame,
                               made ? *made : octets{});
        break;
      }
      case shut_down:
        return 0;
      default:
        return 1;
    }
    if (!goes_on)
      return 0;
  }
}

} // namespace service_program
