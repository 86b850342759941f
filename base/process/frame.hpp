// The frames of a program that serves as a function: docs/programs.md has them
// byte by byte.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// What a frame says.
enum class frame_kind : std::uint16_t {
  // to the program:
  configure = 1,  ///< Lines KEY=VALUE; it answers with `ready`.
  activate = 2,   ///< Inputs will come.
  deactivate = 3, ///< No inputs will come until the next `activate`.
  shut_down = 4,  ///< It ends itself.
  input = 5,      ///< It answers with `result` or `no_result`.
  // from the program:
  ready = 16,     ///< It is configured.
  result = 17,    ///< Of the input with the same number.
  no_result = 18, ///< That input has none.
};

/// One frame.
struct program_frame {
  frame_kind kind{};
  std::int64_t time_ns = 0; ///< The run's time; of a result: its input's.
  std::uint64_t number = 0; ///< Of an input, rising; its result repeats it.
  std::vector<std::byte> octets{};
};

/// Octets before those of a frame's content.
inline constexpr std::size_t frame_header_size = 24;

/// Appends a frame as it is sent. Precondition: the content is shorter than
/// 4 GiB.
void append_frame(std::vector<std::byte>& to, frame_kind kind,
                  std::int64_t time_ns, std::uint64_t number,
                  std::span<const std::byte> octets);

/// Makes frames of a stream of octets that a program sends.
class frame_parser {
public:
  /// @param most_octets  A frame with more content is refused.
  explicit frame_parser(std::size_t most_octets) : most_octets_{most_octets} {}

  /// @returns why nothing can be read any more; empty: all is well.
  const std::string& objection() const { return objection_; }

  /// The next octets of the stream. It keeps no more than one frame and what
  /// came with its end.
  void add(std::span<const std::byte> octets);

  /// @returns the next frame, of those that a program sends; nullopt if it is
  /// not complete yet, or there is an objection.
  std::optional<program_frame> next();

private:
  std::size_t most_octets_;
  std::vector<std::byte> left_;
  std::size_t read_ = 0; // of what is left
  std::string objection_;
};

} // namespace sofof
