// Prints options as a TOML file.
#include "base/options/option_printer.hpp"

#include "base/options/toml_text.hpp"
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <iterator>

namespace sofof {

namespace {

std::string text_of(point p) {
  return fmt::format("[{}, {}]", number_text(p.x_m), number_text(p.y_m));
}

/// @param print  Gives the text of one item.
template <class T, class Print>
std::string list_of(const std::vector<T>& items, Print print) {
  std::string text;
  for (const auto& item : items)
    text += (text.empty() ? "" : ", ") + print(item);
  return fmt::format("[{}]", text);
}

/// Prints one table. Its tables follow behind its own keys, as TOML has it.
class printer final : public option_visitor {
public:
  /// @param path  Dotted name of the table; empty for the whole file.
  explicit printer(std::string path) : path_{std::move(path)} {}

  std::string keys() const { return keys_; }
  std::string tables() const { return tables_; }

  void field(std::string_view key, bool& value) override {
    put(key, value ? "true" : "false");
  }
  void field(std::string_view key, double& value, range) override {
    put(key, number_text(value));
  }
  void field(std::string_view key, std::int64_t& value, range) override {
    put(key, fmt::format("{}", value));
  }
  void field(std::string_view key, std::string& value) override {
    put(key, quoted_toml(value));
  }
  void field(std::string_view key, duration& value, duration) override {
    put(key, quoted_toml(print_duration(value)));
  }
  void field(std::string_view key, std::vector<std::string>& value) override {
    put(key, list_of(value, quoted_toml));
  }
  void field(std::string_view key, point& value) override {
    put(key, text_of(value));
  }
  void field(std::string_view key, std::vector<point>& value) override {
    put(key, list_of(value, text_of));
  }

  void table(std::string_view key,
             const std::function<void(option_visitor&)>& list) override {
    printer part{path_of(key)};
    list(part);
    const auto header = part.keys_.empty() ? "" : "\n[" + part.path_ + "]\n";
    tables_ += header + part.keys_ + part.tables_;
  }

  void tables(
      std::string_view key, std::size_t size,
      const std::function<void(std::size_t, option_visitor&)>& list) override {
    for (std::size_t i = 0; i < size; ++i) {
      printer part{path_of(key)};
      list(i, part);
      tables_ += "\n[[" + part.path_ + "]]\n" + part.keys_ + part.tables_;
    }
  }

  bool word(std::string_view key, std::string_view what, bool says) override {
    if (says)
      put(key, quoted_toml(std::string{what}));
    return says;
  }

  void refuse(std::string_view, const std::string&) override {}

private:
  void put(std::string_view key, std::string_view value) {
    fmt::format_to(std::back_inserter(keys_), "{} = {}\n", key, value);
  }

  std::string path_of(std::string_view key) const {
    return fmt::format("{}{}{}", path_, path_.empty() ? "" : ".", key);
  }

  std::string path_;
  std::string keys_;
  std::string tables_;
};

} // namespace

std::string print_options(const std::function<void(option_visitor&)>& list) {
  printer all{""};
  list(all);
  return all.keys() + all.tables();
}

} // namespace sofof
