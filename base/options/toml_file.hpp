// A TOML file in memory, with the place of everything in it.
#pragma once

#include "base/options/option_note.hpp"
#include "base/options/option_visitor.hpp"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Files that people write, such as scenarios, maps and traces, are no longer;
/// bytes.
inline constexpr std::size_t longest_input = std::size_t{16} << 20;

/// Files that a run has written are no longer; bytes.
inline constexpr std::size_t longest_results = std::size_t{4} << 30;

/// @returns the whole content of a file; nullopt when it cannot be read, is no
/// regular file, or is longer than `most`.
std::optional<std::string> read_text(const std::filesystem::path& file,
                                     std::size_t most = longest_input);

/// The same for a file that has to be there.
/// @throws input_error, which says what is wrong with it.
std::string require_text(const std::filesystem::path& file,
                         std::size_t most = longest_input);

/// Options as a file says them. Keys are dotted paths; elements of lists go by
/// number or by their `name`: `provider.0.area_radius_m`, `provider.mec.name`.
/// All that is wrong is thrown as `input_error`, with the place in front.
class toml_file {
public:
  /// @param text  The content, UTF-8.
  /// @param file  What to call it in errors.
  toml_file(std::string_view text, const std::string& file);
  ~toml_file();

  /// Changes one option, as `--set` does. Tables that are missing on the way
  /// to it are made, list elements are not.
  /// @param assignment  "KEY=VALUE": a TOML value, or else text. "--KEY=VALUE"
  ///                    is the same, called `--KEY VALUE` in errors.
  void set(std::string_view assignment);

  /// @returns a key with the elements of lists by number, however it names
  /// them: "provider.mec.name" is "provider.0.name".
  std::string numbered(std::string_view key) const;

  /// Loads: walks the options that `list` lists, and refuses what stands in
  /// the file and nobody asked for. What stands at the former place of an
  /// option is moved, and a note made of it.
  void read(const std::function<void(option_visitor&)>& list);

  /// @returns what is to be told of the file, as far as it was read.
  const std::vector<option_note>& notes() const;

  /// Refuses what stands at `key`; if nothing does, the place named is that of
  /// the nearest table around it.
  /// @param why  The sentence.
  [[noreturn]] void refuse(std::string_view key, std::string_view why) const;

private:
  struct content;
  std::unique_ptr<content> content_;
};

} // namespace sofof
