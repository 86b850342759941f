// What a report says: sections of text, tables, figures and drives, before
// anybody decides how they look.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace sofof::experiments::report {

/// A few sentences. `code` is the only mark-up.
struct paragraph {
  std::string text;
};

struct table {
  std::string title;
  std::vector<std::string> columns;
  /// As many cells as columns; what looks like a number sorts as one.
  std::vector<std::vector<std::string>> rows;
  std::string note; ///< Below it; may be empty.
};

/// Points of one curve, x ascending. `low` and `high` are a band round `y`, or
/// empty; NaN is a gap.
struct curve {
  enum class style { line, points, steps };

  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> low;
  std::vector<double> high;
  style drawn = style::line;
  bool dashed = false; ///< Somebody else's: the paper's, say.
};

struct figure {
  std::string title;
  std::string x_label; ///< With its unit.
  std::string y_label;
  std::vector<curve> curves;
  /// Vertical lines with their names: limits, say.
  std::vector<std::pair<double, std::string>> marks;
  std::string caption;
};

/// Named points of a plane, of which more than one quantity counts.
struct scatter {
  struct dot {
    std::string name;
    double x = 0;
    double y = 0;
    bool hollow = false; ///< Out of competition.
  };

  std::string title;
  std::string x_label; ///< With its unit.
  std::string y_label;
  std::vector<dot> dots;
  std::vector<std::size_t> joined; ///< Numbers of dots, by a line of steps.
  std::string caption;
};

/// The vehicles of one results folder, moving on their streets, and what
/// became of their offloadings.
struct drive {
  std::filesystem::path folder;
};

/// A text as it stands in a file, folded away at first.
struct listing {
  std::string title;
  std::string text;
};

using block = std::variant<paragraph, table, figure, scatter, drive, listing>;

/// Drives that follow each other stand side by side and share a clock.
struct section {
  std::string title;
  std::vector<block> blocks;
};

struct document {
  std::string title;
  std::string subtitle; ///< Version, seed, what was run.
  std::vector<section> sections;
};

} // namespace sofof::experiments::report
