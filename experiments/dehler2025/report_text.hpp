// The words of the paper's evaluation, with figures filled in by name.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::experiments::study {

/// Figures as they are to be read, by the names that a text has for them.
using named_figures = std::map<std::string_view, std::string>;

/// The parts of a template: paragraphs, captions and notes. A line `## NAME`
/// begins a part, whose lines are joined by spaces; `{figure}` in it stands for
/// a figure.
class report_text {
public:
  /// @param name      Of the template, for what errors say.
  /// @param template_text  As the file has it.
  /// @throws std::logic_error when it has words outside a part, an empty part,
  ///         or two of one name.
  report_text(std::string name, std::string_view template_text);

  /// @returns config/paper/text/NAME.md as the program was built with.
  /// @throws std::logic_error as above, and when there is no such file.
  static report_text of(std::string_view name);

  /// @returns the part with all its figures in their places.
  /// @throws std::logic_error when there is no such part, a placeholder has no
  ///         figure, or a figure no placeholder.
  std::string fill(const std::string& part,
                   const named_figures& figures = {}) const;

  /// @returns the names of all parts.
  std::vector<std::string> parts() const;

private:
  std::string name_;
  std::map<std::string, std::string> parts_;
};

/// @returns a number, up to twelve in words; 0 is "no".
std::string in_words(std::uint64_t count);

/// @returns how many there are of something: "one run", "ten runs", "20 seeds".
/// @param noun  In the singular; the plural has an s.
std::string counted(std::uint64_t count, std::string_view noun);

/// @returns "3, 17", or "none"; of more than 20 numbers the first ones, and how
/// many there are.
std::string in_a_list(std::span<const std::int64_t> numbers);

/// @returns the text of config/paper/text/NAME.md; an empty one if there is no
/// such file.
std::string_view template_of(std::string_view name);

} // namespace sofof::experiments::study
