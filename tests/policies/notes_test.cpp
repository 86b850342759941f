// Tests of what users are told of policies, filters and governors.
#include "policies/registry.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <set>
#include <string>

using namespace sofof;
using namespace sofof::policies;

namespace {

using words = std::set<std::string, std::less<>>;

words described(const policy_info& notes) {
  words names;
  for (const auto& one : notes.parameters) {
    CAPTURE(one.name);
    CHECK(!one.unit.empty());
    CHECK(!one.meaning.empty());
    CHECK(names.emplace(one.name).second);
  }
  return names;
}

/// @param make  From a name to what has options.
template <class Make>
void check(const std::vector<policy_info>& all, Make make) {
  CHECK(!all.empty());
  words names;
  for (const auto& notes : all) {
    CAPTURE(notes.name);
    CHECK(names.emplace(notes.name).second);
    for (const auto text :
         {notes.summary, notes.rule, notes.sees, notes.source})
      CHECK(!text.empty());
    CHECK(notes.summary.ends_with('.'));
    test::option_list options;
    const auto made = make(notes.name);
    REQUIRE(made);
    CHECK(made->name() == notes.name);
    made->visit_options(options);
    std::erase_if(options.names, [](const std::string& name) {
      return name.starts_with("filter.") || name == "govern";
    });
    CHECK(described(notes) == options.names);
  }
}

} // namespace

TEST_CASE("every option of every policy, filter and governor is described, and "
          "nothing else") {
  check(lodm_notes(), make_lodm);
  check(codm_notes(), make_codm);
  check(local_filter_notes(), make_local_filter);
  check(central_filter_notes(), make_central_filter);
  check(governor_notes(), make_governor);
}

TEST_CASE("the names of governors are those that are described") {
  std::vector<std::string_view> names;
  for (const auto& notes : governor_notes())
    names.push_back(notes.name);
  CHECK(names == governor_names());
  CHECK(!make_governor("hysterisis"));
}
