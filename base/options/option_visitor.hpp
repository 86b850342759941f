// One way to list the options of anything: loading, checking and printing a
// scenario all walk the same list.
#pragma once

#include "base/geometry.hpp"
#include "base/time.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

/// Visits options by name. A loader writes into the references what a file
/// says and leaves absent ones at their defaults; a printer reads them.
/// Every option struct has one `void visit_options(option_visitor&)` that lists
/// its members once, with the ranges they must keep.
class option_visitor {
public:
  /// What a number must keep; both ends are allowed values.
  struct range {
    double min = -1e300;
    double max = 1e300;
  };

  virtual ~option_visitor() = default;

  virtual void field(std::string_view key, bool& value) = 0;
  virtual void field(std::string_view key, double& value, range r) = 0;
  virtual void field(std::string_view key, std::int64_t& value, range r) = 0;
  virtual void field(std::string_view key, std::string& value) = 0;
  /// In files a string with a unit: "50ms", "1.5s", "30min", "2h".
  virtual void field(std::string_view key, duration& value, duration min) = 0;
  virtual void field(std::string_view key, std::vector<std::string>& value) = 0;
  /// In files `[x, y]`, m.
  virtual void field(std::string_view key, point& value) = 0;
  virtual void field(std::string_view key, std::vector<point>& value) = 0;
  /// A nested table; `list` lists its fields, also when a file does not have
  /// it (then all of them are absent). A string in its place stands for
  /// `{ name = "…" }`.
  virtual void table(std::string_view key,
                     const std::function<void(option_visitor&)>& list) = 0;
  /// A list of tables: when printing, `list(i, s)` is called for each i below
  /// `size`; when loading, for each element i of the file, in order, and must
  /// make room for it.
  virtual void
  tables(std::string_view key, std::size_t size,
         const std::function<void(std::size_t, option_visitor&)>& list) = 0;
  /// Whether an option is there at all, for those without a default.
  /// @param set  Whether it is set now; a printer returns it. A loader
  ///             returns whether its file has the key.
  virtual bool has(std::string_view, bool set) { return set; }
  /// Lists the former place of an option of this table, before the new one: a
  /// loader still reads there, with a note, and refuses to read both.
  /// @param from  Its path in this table as it was: "network.workers".
  /// @param to    As it is. A table's options move one by one.
  /// @returns whether a loader has found it there and takes it: `--set` of the
  /// new place counts for more.
  virtual bool moved([[maybe_unused]] std::string_view from,
                     [[maybe_unused]] std::string_view to) {
    return false;
  }
  /// Says of the value just read under `key` what should be written instead; a
  /// loader adds file, line and column. Printers ignore it.
  virtual void note([[maybe_unused]] std::string_view key,
                    [[maybe_unused]] const std::string& what) {}
  /// Refuses the value just read under `key`; a loader adds file, line and
  /// column. Printers ignore it.
  /// @param why  What would be right: "must not be less than …".
  virtual void refuse(std::string_view key, const std::string& why) = 0;
  /// Whether an option says this word in place of a value of its own kind.
  /// @param says  Whether it does now; a printer writes the word then.
  /// @returns the same; a loader returns whether its file says so, and what is
  /// set now where it does not have the key.
  virtual bool word([[maybe_unused]] std::string_view key,
                    [[maybe_unused]] std::string_view what, bool says) {
    return says;
  }

  void field(std::string_view key, double& value) { field(key, value, {}); }
};

} // namespace sofof
