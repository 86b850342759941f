// All options that a file can have, as a tree.
#include "base/options/option_tree.hpp"

#include "base/options/known_words.hpp"
#include "base/options/option_printer.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <optional>
#include <utility>

namespace sofof {

namespace {

using option_list = std::function<void(option_visitor&)>;
using text_values = std::map<std::string, std::string, std::less<>>;

constexpr std::string_view name_key = "name";
constexpr std::string_view no_word = "?";       ///< That nothing is called.
constexpr std::string_view any_word = "my_own"; ///< What something may be.

/// What a walk answers when it is asked whether an option is there.
struct presence {
  enum class rule { as_it_is, none, all, one } is = rule::as_it_is;
  std::string key{}; ///< The only one that is, or that says its word instead.
};

described_option* find_option(std::vector<described_option>& all,
                              std::string_view key) {
  const auto i = std::ranges::find(all, key, &described_option::key);
  return i == all.end() ? nullptr : &*i;
}

/// All that walks of one list of options have found.
struct findings {
  std::vector<described_option> options;
  std::vector<std::string> optional; ///< Keys that may be left out.
  std::vector<std::string> wordy;    ///< Keys that may say a word instead.
  std::vector<std::pair<std::string, std::string>> moved; ///< From, to.
  text_values defaults;                                   ///< Of texts.
};

void note_once(std::vector<std::string>& all, std::string_view key) {
  if (std::ranges::find(all, key) == all.end())
    all.emplace_back(key);
}

/// Walks a list of options once, and adds what it sees to the findings.
class walk final : public option_visitor {
public:
  walk(findings& found, presence there, const text_values& texts)
      : found_{found}, there_{std::move(there)}, texts_{texts} {}

  using option_visitor::field;
  void field(std::string_view key, bool& value) override {
    add(key, option_kind::flag, value);
  }
  void field(std::string_view key, double& value, range r) override {
    if (auto* made = add(key, option_kind::number, value, r))
      made->range = r;
  }
  void field(std::string_view key, std::int64_t& value, range r) override {
    if (auto* made = add(key, option_kind::whole_number, value, r))
      made->range = r;
  }
  void field(std::string_view key, std::string& value) override {
    if (add(key, option_kind::text, value))
      found_.defaults.emplace(key, value);
    if (const auto i = texts_.find(key); i != texts_.end())
      value = i->second;
  }
  void field(std::string_view key, duration& value, duration min) override {
    if (auto* made = add(key, option_kind::time, value, min))
      made->least = min;
  }
  void field(std::string_view key, std::vector<std::string>& value) override {
    add(key, option_kind::texts, value);
  }
  void field(std::string_view key, point& value) override {
    add(key, option_kind::point, value);
  }
  void field(std::string_view key, std::vector<point>& value) override {
    add(key, option_kind::points, value);
  }
  void table(std::string_view key, const option_list& list) override {
    add_table(key, option_kind::table, list);
  }
  void tables(
      std::string_view key, std::size_t size,
      const std::function<void(std::size_t, option_visitor&)>& list) override {
    add_table(key, option_kind::tables,
              [&](option_visitor& s) { list(size, s); });
  }

  bool has(std::string_view key, bool set) override {
    note_once(found_.optional, key);
    switch (there_.is) {
      case presence::rule::as_it_is:
        return set;
      case presence::rule::one:
        return key == there_.key;
      default:
        return there_.is == presence::rule::all;
    }
  }
  bool word(std::string_view key, std::string_view what, bool says) override {
    note_once(found_.wordy, key);
    instead_[std::string{key}] = what;
    if (auto* known = find_option(found_.options, key))
      known->instead = what;
    return there_.is == presence::rule::as_it_is ? says : key == there_.key;
  }
  bool moved(std::string_view from, std::string_view to) override {
    const std::pair<std::string, std::string> move{from, to};
    if (std::ranges::find(found_.moved, move) == found_.moved.end())
      found_.moved.push_back(move);
    return false;
  }
  /// Only of texts: what else is wrong with a value is not to be known here.
  void refuse(std::string_view key, const std::string& why) override {
    refuses_name_ |= key == name_key;
    auto* option = find_option(found_.options, key);
    if (option && option->words.empty() && texts_.contains(key))
      option->words = known_words(why);
  }

  bool refuses_name() const { return refuses_name_; }

private:
  /// @returns a new option; null for one that was seen before.
  template <class... Value>
  described_option* add(std::string_view key, option_kind kind,
                        Value&... value) {
    if (find_option(found_.options, key))
      return nullptr;
    auto& made = found_.options.emplace_back();
    made.key = key;
    made.kind = kind;
    made.standard =
        print_options([&](option_visitor& s) { s.field(key, value...); });
    made.standard.erase(0, key.size() + std::string_view{" = "}.size());
    made.standard.pop_back(); // the end of the line
    if (const auto i = instead_.find(key); i != instead_.end())
      made.instead = i->second;
    return &made;
  }

  void add_table(std::string_view key, option_kind kind,
                 const option_list& list) {
    if (find_option(found_.options, key))
      return;
    auto inside = std::make_shared<option_table>(describe_options(list));
    auto& made = found_.options.emplace_back();
    made.key = key;
    made.kind = kind;
    made.table = std::move(inside);
  }

  findings& found_;
  presence there_;
  const text_values& texts_;
  text_values instead_;
  bool refuses_name_ = false;
};

/// Walks with every presence of options that there is until now.
void walk_all(const option_list& list, findings& found,
              const text_values& texts) {
  using rule = presence::rule;
  const auto once = [&](presence there) {
    walk one{found, std::move(there), texts};
    list(one);
  };
  for (const auto is : {rule::as_it_is, rule::none, rule::all})
    once({is, {}});
  for (std::size_t i = 0; i < found.optional.size(); ++i)
    once({rule::one, found.optional[i]});
  for (std::size_t i = 0; i < found.wordy.size(); ++i)
    once({rule::one, found.wordy[i]});
}

/// Finds all options that there are while some texts are what they are.
findings explore(const option_list& list, const text_values& fixed) {
  findings found;
  walk_all(list, found, fixed);
  for (std::size_t i = 0; i < found.options.size(); ++i) {
    const auto key = found.options[i].key;
    if (found.options[i].kind != option_kind::text || fixed.contains(key))
      continue;
    auto as_before = fixed;
    as_before.insert(found.defaults.begin(), found.defaults.end());
    auto texts = fixed;
    texts[key] = no_word;
    walk_all(list, found, texts);
    const auto words = found.options[i].words; // the list may grow
    if (key != name_key)
      for (const auto& word : words) {
        texts[key] = word;
        walk_all(list, found, texts);
      }
    walk_all(list, found, as_before);
  }
  for (const auto& key : found.optional)
    if (auto* option = find_option(found.options, key))
      option->standard.clear();
  return found;
}

const described_option* find_path(const std::vector<described_option>& all,
                                  std::string_view path) {
  const auto dot = path.find('.');
  const auto i =
      std::ranges::find(all, path.substr(0, dot), &described_option::key);
  if (i == all.end() || dot == path.npos)
    return i == all.end() ? nullptr : &*i;
  if (i->table)
    for (const auto& variant : i->table->variants)
      if (const auto* inside = find_path(variant.options, path.substr(dot + 1)))
        return inside;
  return nullptr;
}

/// Puts an option at its former place, too.
void put_former(std::vector<described_option>& all, std::string_view path,
                const described_option& option) {
  const auto dot = path.find('.');
  auto* there = find_option(all, path.substr(0, dot));
  if (dot == path.npos) {
    if (there)
      return;
    all.push_back(option);
    all.back().key = path;
  } else if (there && there->table) {
    // Others may share the table.
    there->table = std::make_shared<option_table>(*there->table);
    for (auto& variant : there->table->variants)
      put_former(variant.options, path.substr(dot + 1), option);
  }
}

std::vector<described_option> with_former_places(const findings& found) {
  auto all = found.options;
  for (const auto& [from, to] : found.moved)
    if (const auto* now = find_path(found.options, to)) {
      auto former = *now;
      former.now = to;
      former.standard.clear();
      put_former(all, from, former);
    }
  return all;
}

bool same_options(const std::vector<described_option>& a,
                  const std::vector<described_option>& b);

bool same_options(const option_table& a, const option_table& b) {
  return std::ranges::equal(
      a.variants, b.variants, [](const auto& x, const auto& y) {
        return x.names == y.names && same_options(x.options, y.options);
      });
}

bool same_options(const std::vector<described_option>& a,
                  const std::vector<described_option>& b) {
  return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
    return x.key == y.key && x.kind == y.kind && x.words == y.words
           && x.standard == y.standard
           && (!x.table || same_options(*x.table, *y.table));
  });
}

/// @returns the options of what may be called anything while an option is
/// there; nothing if names are known even so.
std::optional<findings> with_any_name(const option_list& list,
                                      const std::string& key) {
  const text_values free{{std::string{name_key}, std::string{any_word}}};
  findings found;
  walk one{found, {presence::rule::one, key}, free};
  list(one);
  if (one.refuses_name() || !find_option(found.options, key))
    return std::nullopt;
  found = explore(list, free);
  for (auto& option : found.options)
    if (option.key == name_key)
      option.words.clear();
  return found;
}

} // namespace

const described_option* option_table::find(std::string_view key) const {
  for (const auto& variant : variants)
    if (const auto* option = find_path(variant.options, key))
      return option;
  return nullptr;
}

option_table describe_options(const option_list& list) {
  auto whole = explore(list, {});
  const auto name =
      std::ranges::find(whole.options, name_key, &described_option::key);
  option_table all;
  if (name == whole.options.end() || name->words.empty()) {
    all.variants.push_back({{}, {}, with_former_places(whole)});
    return all;
  }
  for (const auto& word : name->words) {
    auto found = explore(list, {{std::string{name_key}, word}});
    if (auto* its_own = find_option(found.options, name_key))
      *its_own = *name;
    auto options = with_former_places(found);
    const auto alike =
        std::ranges::find_if(all.variants, [&](const auto& variant) {
          return same_options(variant.options, options);
        });
    if (alike == all.variants.end())
      all.variants.push_back({{word}, {}, std::move(options)});
    else
      alike->names.push_back(word);
  }
  for (const auto& key : whole.optional)
    if (auto found = with_any_name(list, key))
      all.variants.push_back({{}, key, with_former_places(*found)});
  const auto defaults = whole.defaults;
  walk as_it_was{whole, {}, defaults};
  list(as_it_was);
  return all;
}

} // namespace sofof
