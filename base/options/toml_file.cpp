// A TOML file in memory, with the place of everything in it.
#include "base/options/toml_file.hpp"

#include "base/files/regular_file.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "base/options/toml_depth.hpp"
#include "base/options/toml_nodes.hpp"
#include "base/options/toml_options.hpp"
#include "base/options/toml_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>
#include <utility>
#include <vector>

namespace sofof {

namespace {

/// Cuts the first segment off a dotted key.
std::string_view take_segment(std::string_view& key) {
  const auto dot = key.find('.');
  const auto segment = key.substr(0, dot);
  key.remove_prefix(dot == key.npos ? key.size() : dot + 1);
  return segment;
}

/// @returns the index of the element that has this number or name; beyond the
/// end of the list if there is none.
std::size_t find_index(const toml::array& list, std::string_view segment) {
  std::size_t i = 0;
  const auto last = segment.data() + segment.size();
  const auto [end, error] = std::from_chars(segment.data(), last, i);
  if (error == std::errc{} && end == last)
    return i;
  for (i = 0; i < list.size(); ++i)
    if (const auto* table = list[i].as_table())
      if ((*table)["name"].value<std::string_view>() == segment)
        break;
  return i;
}

/// @returns what `segment` names in `parent`; null if nothing.
toml::node* find_child(toml::node& parent, std::string_view segment) {
  if (auto* table = parent.as_table())
    return table->get(segment);
  if (auto* list = parent.as_array())
    return list->get(find_index(*list, segment));
  return nullptr;
}

/// @returns what to say of a list's element that there is none of.
std::string no_such_element(const toml::node& list, std::string_view segment) {
  std::vector<std::string_view> names;
  if (const auto* all = list.as_array())
    for (const auto& element : *all)
      if (const auto* table = element.as_table())
        if (const auto name = (*table)["name"].value<std::string_view>())
          names.push_back(*name);
  if (names.empty())
    return fmt::format("there is no \"{}\".", segment);
  const auto meant = nearest_word(segment, names);
  return fmt::format(
      "there is no \"{}\"{} Known: {}.", segment,
      meant.empty() ? "." : fmt::format(", did you mean \"{}\"?", meant),
      fmt::join(names, ", "));
}

/// Puts `what` under `segment` into a table, or into an element that a list
/// has already.
void put_child(toml::node& parent, std::string_view segment,
               toml::node&& what) {
  what.visit([&](auto& child) {
    if (auto* table = parent.as_table()) {
      table->insert_or_assign(segment, std::move(child));
    } else if (auto* list = parent.as_array()) {
      const auto i = static_cast<std::ptrdiff_t>(find_index(*list, segment));
      list->replace(list->begin() + i, std::move(child));
    }
  });
}

/// One `--set`, or an option of its own. The nodes that it makes know that they
/// come from there.
class assignment {
public:
  explicit assignment(std::string_view text) {
    const auto is_option = text.starts_with(command_line_prefix);
    if (is_option)
      text.remove_prefix(command_line_prefix.size());
    key_ = text.substr(0, text.find('='));
    place_ = fmt::format("{}{}", is_option ? "--" : "--set ", text);
    if (is_option && key_.size() < text.size())
      place_[command_line_prefix.size() + key_.size()] = ' ';
    if (key_.size() == text.size())
      refuse("there is no value, write KEY=VALUE.");
    if (std::ranges::count(key_, '.') >= most_dots)
      refuse(fmt::format("the key has more than {} parts.", most_toml_depth));
    value_ = text.substr(key_.size() + 1);
  }

  [[noreturn]] void refuse(std::string_view why) const {
    throw input_error{fmt::format("{}: {}", place_, why)};
  }

  void apply(toml::node& root) const {
    auto* at = &root;
    auto key = key_;
    for (auto segment = take_segment(key);; segment = take_segment(key)) {
      if (segment.empty())
        refuse("a part of the key is empty.");
      auto* next = find_child(*at, segment);
      if (!next && !at->is_table())
        refuse(no_such_element(*at, segment));
      if (key.empty())
        return put_child(*at, segment, std::move(*value().get("value")));
      if (!next || next->is_string())
        next = &make_table(*at, segment, next);
      at = next;
    }
  }

private:
  /// Makes a table; a string in its place becomes its `name`.
  toml::node& make_table(toml::node& parent, std::string_view segment,
                         toml::node* name) const {
    auto made = parse_toml("", place_);
    if (name)
      put_child(made, "name", std::move(*name));
    put_child(parent, segment, std::move(made));
    return *find_child(parent, segment);
  }

  toml::table value() const {
    const auto text = fmt::format("value = {}", value_);
    check_toml_depth(text, place_);
    try {
      auto parsed = toml::parse(text, place_);
      if (parsed.size() == 1)
        return parsed;
    } catch (const toml::parse_error&) {
      // Then it is text without quotes.
    }
    return parse_toml(fmt::format("value = {}", quoted_toml(value_)), place_);
  }

  static constexpr std::ptrdiff_t most_dots = most_toml_depth;

  std::string place_;
  std::string_view key_;
  std::string_view value_;
};

} // namespace

struct toml_file::content {
  std::string file;
  toml::table root;
  std::vector<option_note> notes;
};

std::optional<std::string> read_text(const std::filesystem::path& file,
                                     std::size_t most) {
  auto content = read_regular_file(file, most);
  if (!content.refusal.empty())
    return std::nullopt;
  return std::move(content.text);
}

std::string require_text(const std::filesystem::path& file, std::size_t most) {
  auto content = read_regular_file(file, most);
  if (content.refusal.empty())
    return std::move(content.text);
  throw input_error{fmt::format("{}: this file cannot be read: {}.",
                                file.string(), content.refusal)};
}

toml_file::toml_file(std::string_view text, const std::string& file)
    : content_{new content{file, parse_toml(text, file), {}}} {}

toml_file::~toml_file() = default;

void toml_file::set(std::string_view text) {
  assignment{text}.apply(content_->root);
}

std::string toml_file::numbered(std::string_view key) const {
  std::string path;
  toml::node* at = &content_->root;
  while (!key.empty()) {
    const auto segment = take_segment(key);
    const auto* list = at ? at->as_array() : nullptr;
    path += path.empty() ? "" : ".";
    path += list ? std::to_string(find_index(*list, segment))
                 : std::string{segment};
    at = at ? find_child(*at, segment) : nullptr;
  }
  return path;
}

void toml_file::read(const std::function<void(option_visitor&)>& list) {
  toml_options reader{content_->root, content_->file, content_->notes};
  list(reader);
  reader.finish();
}

const std::vector<option_note>& toml_file::notes() const {
  return content_->notes;
}

void toml_file::refuse(std::string_view key, std::string_view why) const {
  toml::node* at = &content_->root;
  while (!key.empty()) {
    auto* child = find_child(*at, take_segment(key));
    if (!child)
      break;
    at = child;
  }
  const auto place = at == &content_->root
                         ? content_->file
                         : place_of(at->source(), content_->file);
  throw input_error{fmt::format("{}: {}", place, why)};
}

} // namespace sofof
