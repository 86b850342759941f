// What can stand behind --set.
#include "experiments/schema/set_keys.hpp"

#include <algorithm>
#include <utility>

namespace sofof::experiments::schema {

namespace {

std::vector<std::string> all_names(const option_table& table) {
  std::vector<std::string> names;
  for (const auto& variant : table.variants)
    names.insert(names.end(), variant.names.begin(), variant.names.end());
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> values_of(const described_option& option) {
  if (option.kind == option_kind::flag)
    return {"false", "true"};
  auto words = option.words;
  if (!option.instead.empty())
    words.push_back(option.instead);
  return words;
}

/// Collects keys, each once.
class key_list {
public:
  std::vector<set_key> all;

  void add_table(const std::string& prefix, const option_table& table) {
    for (const auto& variant : table.variants)
      add_options(prefix, variant.options);
  }

private:
  void add(std::string key, std::vector<std::string> values) {
    if (std::ranges::find(all, key, &set_key::key) == all.end())
      all.push_back({std::move(key), std::move(values)});
  }

  void add_options(const std::string& prefix,
                   const std::vector<described_option>& options) {
    for (const auto& option : options) {
      const auto key = prefix + option.key;
      if (!option.now.empty())
        continue;
      if (option.kind == option_kind::tables)
        add_list(key + '.', *option.table);
      else if (option.kind != option_kind::table)
        add(key, values_of(option));
      else
        add_inner(key, *option.table);
    }
  }

  void add_inner(const std::string& key, const option_table& table) {
    if (auto names = all_names(table); !names.empty())
      add(key, std::move(names));
    add_table(key + '.', table);
  }

  void add_list(const std::string& prefix, const option_table& table) {
    for (const auto& variant : table.variants) {
      for (const auto& name : variant.names)
        add_options(prefix + name + '.', variant.options);
      if (variant.names.empty())
        add_options(prefix + "0.", variant.options);
    }
  }
};

} // namespace

std::vector<set_key> set_keys(const option_table& all) {
  key_list keys;
  keys.add_table("", all);
  return std::move(keys.all);
}

} // namespace sofof::experiments::schema
