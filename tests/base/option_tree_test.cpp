// All options of a file as a tree.
#include "base/options/option_tree.hpp"

#include "base/options/known_words.hpp"
#include "base/options/option_helpers.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;

namespace {

struct fruit {
  explicit fruit(std::string called) : name_{std::move(called)} {}
  std::string_view name() const { return name_; }
  void visit_options(option_visitor& s) {
    if (name_ == "apple")
      s.field("pips", pips, {0, 9});
    else
      s.field("peel", peel);
  }
  std::string name_;
  std::int64_t pips = 5;
  bool peel = true;
};

std::unique_ptr<fruit> grow(std::string_view name) {
  return name == "apple" || name == "pear" || name == "plum"
             ? std::make_unique<fruit>(std::string{name})
             : nullptr;
}

struct basket {
  std::string colour = "red";
  std::string label;
  std::optional<double> weight;
  duration age = std::chrono::seconds{2};
  bool fresh = false;
  std::unique_ptr<fruit> first = grow("pear");
  std::vector<fruit> others;

  void visit_options(option_visitor& s) {
    constexpr std::string_view colours[]{"green", "red"};
    visit_word(s, "colour", colour, "colour", colours);
    if (colour == "green")
      s.field("unripe_days", others_days, {1, 30});
    s.field("label", label);
    if (s.has("weight", weight.has_value()))
      s.field("weight", weight ? *weight : weight.emplace(), {0, 7});
    else
      s.field("volume", volume);
    if (s.word("age", "forgotten", false))
      s.field("mould", fresh);
    else
      s.field("age", age, duration{1});
    s.moved("days", "content.pips");
    s.table("content", [this](option_visitor& t) {
      visit_choice(t, first, grow, "fruit", {"apple", "pear", "plum"});
    });
  }
  double others_days = 3, volume = 4;
};

const described_option& need(const option_table& all, std::string_view path) {
  const auto* found = all.find(path);
  CAPTURE(path);
  REQUIRE(found);
  return *found;
}

} // namespace

TEST_CASE("A refusal's known words are read back") {
  const std::vector<std::string_view> known{"one", "two_three", "four"};
  const std::vector<std::string> same(known.begin(), known.end());
  CHECK(known_words(unknown_word("number", "ten", known)) == same);
  CHECK(known_words(unknown_word("number", "ones", known)) == same);
  CHECK(known_words(unknown_word("number", "?", known)
                    + " It is a LODM: lodm = \"?\".")
        == same);
  CHECK(known_words("must be positive.").empty());
}

TEST_CASE("A tree has options that there are only with others") {
  basket one;
  const auto all =
      describe_options([&](option_visitor& s) { one.visit_options(s); });
  REQUIRE(all.variants.size() == 1);
  CHECK(need(all, "colour").words == std::vector<std::string>{"green", "red"});
  CHECK(need(all, "colour").standard == "\"red\"");
  CHECK(need(all, "label").words.empty());
  CHECK(need(all, "unripe_days").range.max == 30);
  CHECK(need(all, "weight").standard.empty());
  CHECK(need(all, "volume").kind == option_kind::number);
  CHECK(need(all, "age").instead == "forgotten");
  CHECK(need(all, "age").least == duration{1});
  CHECK(need(all, "age").standard == "\"2s\"");
  CHECK(need(all, "mould").kind == option_kind::flag);
  CHECK(need(all, "days").now == "content.pips");
}

TEST_CASE("A table whose options hang on its name has variants") {
  basket one;
  const auto all =
      describe_options([&](option_visitor& s) { one.visit_options(s); });
  const auto& content = *need(all, "content").table;
  REQUIRE(content.variants.size() == 2);
  CHECK(content.variants[0].names == std::vector<std::string>{"apple"});
  CHECK(content.variants[1].names == std::vector<std::string>{"pear", "plum"});
  CHECK(content.variants[0].options.size() == 2);
  CHECK(content.variants[0].options[0].standard == "\"pear\"");
  CHECK(content.variants[0].options[1].key == "pips");
  CHECK(content.variants[1].options[1].key == "peel");
}

TEST_CASE("What was described is as it was afterwards") {
  basket one;
  describe_options([&](option_visitor& s) { one.visit_options(s); });
  CHECK(one.colour == "red");
  CHECK(one.label.empty());
  CHECK(one.first->name() == "pear");
}
