// What a report says: sections of text, tables, figures and drives, before
// anybody decides how they look.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
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
  /// What a comparison makes of a row.
  enum class verdict { different, same, better, worse };

  std::string title;
  std::vector<std::string> columns;
  /// As many cells as columns; what looks like a number sorts as one.
  std::vector<std::vector<std::string>> rows;
  std::string note{}; ///< Below it; may be empty.
  /// What a column, or a row's first cell, means: none, or one for each.
  std::vector<std::string> column_meanings{};
  std::vector<std::string> row_meanings{};
  std::vector<verdict> verdicts{}; ///< Of rows: none, or one for each.
};

/// Points of one curve, x ascending. `low` and `high` are a band round `y`, or
/// empty; NaN is a gap.
struct curve {
  /// Of `tail` each y is the share of values that are x or more.
  enum class style { line, points, steps, tail };
  /// What is shown in the same colour wherever it is.
  enum class meaning { any, measured, allowed, admitted };

  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> low;
  std::vector<double> high;
  style drawn = style::line;
  bool dashed = false; ///< Somebody else's: the paper's, say.
  /// Whose colour it has: a provider's, by its place in the configuration.
  std::optional<std::size_t> provider{};
  /// Whose each point is: none, or one for each.
  std::vector<double> stations{};
  meaning means = meaning::any;
};

/// Where something of each vehicle was, over the x of a figure's curves.
struct strip {
  struct stay {
    double station = 0;
    double from = 0, until = 0;
    std::size_t place = 0; ///< Of `figure::places`.
  };
  struct mark {
    double station = 0;
    double x = 0;
  };
  std::string name;
  std::vector<stay> stays;
  std::vector<mark> fallbacks; ///< It had to come home.
};

struct figure {
  std::string title;
  std::string x_label; ///< With its unit.
  std::string y_label;
  std::vector<curve> curves;
  /// Vertical lines with their names: limits, say.
  std::vector<std::pair<double, std::string>> marks{};
  std::string caption{};
  /// Horizontal lines with their names.
  std::vector<std::pair<double, std::string>> levels{};
  bool by_clock = false; ///< x is the time of the drives.
  bool log_y = false;    ///< y has a logarithmic axis; what is 0 is at its end.
  /// Bars above the curves, the first one highest; with them the figure shows
  /// one vehicle at a time.
  std::vector<strip> strips{};
  /// Of the strips: their names, and whose colours they have, a provider's by
  /// its place in the configuration; the vehicle itself has none.
  std::vector<std::pair<std::string, std::optional<std::size_t>>> places{};
};

/// Named points of a plane, of which more than one quantity counts.
struct scatter {
  struct dot {
    std::string name;
    double x = 0;
    double y = 0;
    bool hollow = false; ///< Out of competition.
    /// Low and high ends, where x and y are known with an interval.
    std::optional<std::pair<double, double>> x_interval{}, y_interval{};
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
