// Walks a list of options: notes their names, checks that defaults are within
// their ranges, and can set some of them.
#pragma once

#include "base/options/option_visitor.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sofof::test {

/// What to set, by key; nested ones "a.b".
struct option_values {
  std::map<std::string, double, std::less<>> numbers{};
  std::map<std::string, duration, std::less<>> times{};
  std::map<std::string, std::string, std::less<>> texts{};
  std::map<std::string, bool, std::less<>> flags{};
  std::map<std::string, std::vector<std::string>, std::less<>> lists{};
  /// Of lists of tables; the k-th table of "a" is "a.k".
  std::map<std::string, std::size_t, std::less<>> lengths{};
};

class option_list final : public option_visitor, public option_values {
public:
  option_list() = default;
  explicit option_list(option_values values)
      : option_values{std::move(values)} {}

  std::set<std::string, std::less<>> names;   ///< Found; nested ones "a.b".
  std::set<std::string, std::less<>> refused; ///< Keys of refused values.

  void field(std::string_view key, bool& value) override {
    found(key);
    set(flags, key, value);
  }
  void field(std::string_view key, double& value, range r) override {
    found(key);
    set(numbers, key, value);
    CAPTURE(key);
    CHECK(value >= r.min);
    CHECK(value <= r.max);
  }
  void field(std::string_view key, std::int64_t& value, range r) override {
    found(key);
    CHECK(static_cast<double>(value) >= r.min);
    CHECK(static_cast<double>(value) <= r.max);
  }
  void field(std::string_view key, std::string& value) override {
    found(key);
    set(texts, key, value);
  }
  void field(std::string_view key, duration& value, duration min) override {
    found(key);
    set(times, key, value);
    CAPTURE(key);
    CHECK(value >= min);
  }
  void field(std::string_view key, std::vector<std::string>& value) override {
    found(key);
    set(lists, key, value);
  }
  void field(std::string_view key, point&) override { found(key); }
  void field(std::string_view key, std::vector<point>&) override { found(key); }
  void table(std::string_view key,
             const std::function<void(option_visitor&)>& list) override {
    const auto outer = prefix_;
    prefix_ += std::string{key} + ".";
    list(*this);
    prefix_ = outer;
  }
  void tables(
      std::string_view key, std::size_t,
      const std::function<void(std::size_t, option_visitor&)>& list) override {
    found(key);
    std::size_t length = 0;
    set(lengths, key, length);
    for (std::size_t k = 0; k < length; ++k)
      table(std::string{key} + '.' + std::to_string(k),
            [&](option_visitor& s) { list(k, s); });
  }
  void refuse(std::string_view key, const std::string& why) override {
    CHECK(!why.empty());
    refused.insert(prefix_ + std::string{key});
  }

private:
  void found(std::string_view key) {
    const auto name = prefix_ + std::string{key};
    CAPTURE(name);
    CHECK(names.insert(name).second); // listed once
  }
  template <class Values, class T>
  void set(const Values& values, std::string_view key, T& value) {
    if (auto i = values.find(prefix_ + std::string{key}); i != values.end())
      value = i->second;
  }

  std::string prefix_;
};

} // namespace sofof::test
