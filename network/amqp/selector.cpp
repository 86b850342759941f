// A parser that descends, and a tree that is evaluated with three truth values.
#include "network/amqp/selector.hpp"

#include "network/network_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace sofof::network::amqp {

namespace {

/// A value; nothing where a property is missing or of no such type.
using selected = std::variant<std::monostate, bool, double, std::string_view>;

/// True, false or unknown.
using truth = std::optional<bool>;

enum class operation : std::uint8_t {
  literal,
  name,
  negation,
  conjunction,
  disjunction,
  equal,
  less,
  less_or_equal,
  like,
  among,
  missing,
};

} // namespace

struct selector::node {
  operation what = operation::literal;
  std::variant<bool, double, std::string> value{}; ///< Of literal or name.
  char escape = '\0';                              ///< Of LIKE; 0: none.
  std::vector<node> of{};
};

namespace {

using tree = selector::node;

selected value_of(const tree& x, const properties& of) {
  if (x.what == operation::literal) {
    if (const auto* text = std::get_if<std::string>(&x.value))
      return std::string_view{*text};
    if (const auto* number = std::get_if<double>(&x.value))
      return *number;
    return std::get<bool>(x.value);
  }
  const auto at = of.find(std::get<std::string>(x.value));
  if (at == of.end())
    return std::monostate{};
  return std::visit(
      []<class T>(const T& found) -> selected {
        if constexpr (std::is_same_v<T, bool>)
          return found;
        else if constexpr (std::is_arithmetic_v<T>)
          return static_cast<double>(found);
        else if constexpr (std::is_same_v<T, std::string>)
          return std::string_view{found};
        else
          return std::monostate{};
      },
      at->second);
}

/// @returns whether a text is like a pattern, in which % stands for any
/// characters and _ for one.
bool is_like(std::string_view text, std::string_view pattern, char escape) {
  std::size_t t = 0, p = 0;
  auto retry_p = std::string_view::npos;
  std::size_t retry_t = 0;
  while (t < text.size() || p < pattern.size()) {
    if (p < pattern.size() && pattern[p] == '%') {
      retry_p = p++;
      retry_t = t;
      continue;
    }
    const auto escaped =
        escape != '\0' && p + 1 < pattern.size() && pattern[p] == escape;
    const auto at = escaped ? p + 1 : p;
    if (t < text.size() && at < pattern.size()
        && (pattern[at] == text[t] || (!escaped && pattern[at] == '_'))) {
      ++t;
      p = at + 1;
      continue;
    }
    if (retry_p == std::string_view::npos || retry_t >= text.size())
      return false;
    p = retry_p + 1;
    t = ++retry_t;
  }
  return true;
}

truth compare(operation what, const selected& left, const selected& right) {
  if (left.index() != right.index()
      || std::holds_alternative<std::monostate>(left))
    return std::nullopt;
  if (what == operation::equal)
    return left == right;
  const auto* a = std::get_if<double>(&left);
  if (!a)
    return std::nullopt; // only numbers have an order
  const auto b = std::get<double>(right);
  return what == operation::less ? *a < b : *a <= b;
}

truth evaluate(const tree& x, const properties& of);

truth junction(const tree& x, const properties& of) {
  const auto decisive = x.what == operation::disjunction;
  truth result = !decisive;
  for (const auto& part : x.of) {
    const auto one = evaluate(part, of);
    if (one == decisive)
      return decisive;
    if (!one)
      result = std::nullopt;
  }
  return result;
}

truth evaluate(const tree& x, const properties& of) {
  switch (x.what) {
    case operation::conjunction:
    case operation::disjunction:
      return junction(x, of);
    case operation::negation: {
      const auto inner = evaluate(x.of[0], of);
      return inner ? truth{!*inner} : inner;
    }
    case operation::equal:
    case operation::less:
    case operation::less_or_equal:
      return compare(x.what, value_of(x.of[0], of), value_of(x.of[1], of));
    case operation::like: {
      const auto text = value_of(x.of[0], of);
      const auto* is = std::get_if<std::string_view>(&text);
      if (!is || is->size() > selector::longest_text)
        return std::nullopt;
      return is_like(*is, std::get<std::string>(x.value), x.escape);
    }
    case operation::among: {
      const auto sought = value_of(x.of[0], of);
      if (std::holds_alternative<std::monostate>(sought))
        return std::nullopt;
      return std::any_of(x.of.begin() + 1, x.of.end(), [&](const tree& one) {
        return value_of(one, of) == sought;
      });
    }
    case operation::missing:
      return !of.contains(std::get<std::string>(x.of[0].value));
    case operation::literal:
    case operation::name: {
      const auto value = value_of(x, of);
      const auto* is = std::get_if<bool>(&value);
      return is ? truth{*is} : std::nullopt;
    }
  }
  return std::nullopt;
}

bool is_name_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'
         || c == '$';
}

/// Reads a selector from its beginning to its end.
class selector_reader {
public:
  explicit selector_reader(std::string_view text) : text_{text} { skip(); }

  tree read() {
    auto all = disjunction();
    if (at_ != text_.size())
      refuse("an end");
    return all;
  }

private:
  tree disjunction() { return chain("OR", operation::disjunction); }

  tree chain(std::string_view word, operation what) {
    const auto part = [this, what] {
      return what == operation::disjunction
                 ? chain("AND", operation::conjunction)
                 : negation();
    };
    auto first = part();
    if (!is_next_word(word))
      return first;
    tree all{.what = what};
    all.of.push_back(std::move(first));
    while (takes_word(word))
      all.of.push_back(part());
    return all;
  }

  tree negation() {
    if (!takes_word("NOT"))
      return comparison();
    const depth_guard deeper{*this};
    return inverted(negation());
  }

  static tree inverted(tree inner) {
    tree all{.what = operation::negation};
    all.of.push_back(std::move(inner));
    return all;
  }

  static tree pair(operation what, tree left, tree right) {
    tree all{.what = what};
    all.of.push_back(std::move(left));
    all.of.push_back(std::move(right));
    return all;
  }

  tree comparison() {
    if (takes("(")) {
      const depth_guard deeper{*this};
      auto inner = disjunction();
      if (!takes(")"))
        refuse("a )");
      return inner;
    }
    auto left = operand();
    if (takes("<>"))
      return inverted(pair(operation::equal, std::move(left), operand()));
    if (takes("<="))
      return pair(operation::less_or_equal, std::move(left), operand());
    if (takes(">=")) {
      auto right = operand();
      return pair(operation::less_or_equal, std::move(right), std::move(left));
    }
    if (takes("="))
      return pair(operation::equal, std::move(left), operand());
    if (takes("<"))
      return pair(operation::less, std::move(left), operand());
    if (takes(">")) {
      auto right = operand();
      return pair(operation::less, std::move(right), std::move(left));
    }
    return by_word(std::move(left));
  }

  tree by_word(tree left) {
    if (takes_word("IS")) {
      const auto no = takes_word("NOT");
      if (left.what != operation::name || !takes_word("NULL"))
        refuse("a name before IS and NULL behind it");
      tree all{.what = operation::missing};
      all.of.push_back(std::move(left));
      return no ? inverted(std::move(all)) : all;
    }
    const auto no = takes_word("NOT");
    if (takes_word("LIKE"))
      return maybe_inverted(no, pattern_of(std::move(left)));
    if (takes_word("IN"))
      return maybe_inverted(no, list_of(std::move(left)));
    if (takes_word("BETWEEN"))
      return maybe_inverted(no, range_of(std::move(left)));
    if (no)
      refuse("LIKE, IN or BETWEEN");
    return left;
  }

  static tree maybe_inverted(bool no, tree x) {
    return no ? inverted(std::move(x)) : std::move(x);
  }

  tree pattern_of(tree left) {
    tree all{.what = operation::like};
    all.value = text();
    if (takes_word("ESCAPE")) {
      const auto one = text();
      if (one.size() != 1)
        refuse("one character");
      all.escape = one[0];
    }
    all.of.push_back(std::move(left));
    return all;
  }

  tree list_of(tree left) {
    tree all{.what = operation::among};
    all.of.push_back(std::move(left));
    if (!takes("("))
      refuse("a (");
    do
      all.of.push_back(operand());
    while (takes(","));
    if (!takes(")"))
      refuse("a )");
    return all;
  }

  tree range_of(tree left) {
    auto same = left;
    auto low = operand();
    if (!takes_word("AND"))
      refuse("AND");
    auto all =
        pair(operation::conjunction,
             pair(operation::less_or_equal, std::move(low), std::move(left)),
             tree{});
    all.of[1] = pair(operation::less_or_equal, std::move(same), operand());
    return all;
  }

  tree operand() {
    if (++operands_ > selector::most_operands)
      throw network_error{fmt::format("the selector has more than {} operands",
                                      selector::most_operands)};
    if (at_ < text_.size() && text_[at_] == '\'')
      return {.what = operation::literal, .value = text()};
    if (takes_word("TRUE"))
      return {.what = operation::literal, .value = true};
    if (takes_word("FALSE"))
      return {.what = operation::literal, .value = false};
    if (const auto number = this->number())
      return {.what = operation::literal, .value = *number};
    const auto word = next_word();
    if (word.empty())
      refuse("a name, a number or a text in single quotes");
    at_ += word.size();
    skip();
    return {.what = operation::name, .value = std::string{word}};
  }

  std::optional<double> number() {
    double value = 0;
    const auto* first = text_.data() + at_;
    const auto c = at_ < text_.size() ? text_[at_] : '\0';
    const auto digit = c == '-' && at_ + 1 < text_.size() ? text_[at_ + 1] : c;
    if (digit != '.' && std::isdigit(static_cast<unsigned char>(digit)) == 0)
      return std::nullopt;
    const auto [end, error] =
        std::from_chars(first, text_.data() + text_.size(), value);
    if (error != std::errc{})
      return std::nullopt;
    at_ += static_cast<std::size_t>(end - first);
    skip();
    return value;
  }

  /// In single quotes, which stand twice within it.
  std::string text() {
    if (at_ == text_.size() || text_[at_] != '\'')
      refuse("a text in single quotes");
    std::string all;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\'') {
        if (at_ + 1 == text_.size() || text_[at_ + 1] != '\'') {
          ++at_;
          skip();
          return all;
        }
        ++at_;
      }
      all += text_[at_];
    }
    refuse("a single quote");
  }

  std::string_view next_word() const {
    auto end = at_;
    while (end < text_.size() && is_name_character(text_[end]))
      ++end;
    return text_.substr(at_, end - at_);
  }

  /// @param word  In capitals; selectors may have it in any.
  bool is_next_word(std::string_view word) const {
    return std::ranges::equal(next_word(), word, [](char a, char b) {
      return std::toupper(static_cast<unsigned char>(a)) == b;
    });
  }

  bool takes_word(std::string_view word) {
    return is_next_word(word) && takes(text_.substr(at_, word.size()));
  }

  bool takes(std::string_view sign) {
    if (!text_.substr(at_).starts_with(sign))
      return false;
    at_ += sign.size();
    skip();
    return true;
  }

  void skip() {
    while (at_ < text_.size()
           && std::isspace(static_cast<unsigned char>(text_[at_])) != 0)
      ++at_;
  }

  [[noreturn]] void refuse(std::string_view wanted) const {
    throw network_error{
        fmt::format("the selector needs {} at character {}", wanted, at_ + 1)};
  }

  /// One level of brackets or NOT.
  class depth_guard {
  public:
    explicit depth_guard(selector_reader& of) : of_{of} {
      if (++of_.depth_ > selector::deepest)
        throw network_error{fmt::format("the selector is deeper than {} levels",
                                        selector::deepest)};
    }
    ~depth_guard() { --of_.depth_; }
    depth_guard(const depth_guard&) = delete;
    depth_guard& operator=(const depth_guard&) = delete;

  private:
    selector_reader& of_;
  };

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  int operands_ = 0;
};

} // namespace

selector::selector() = default;
selector::~selector() = default;
selector::selector(selector&&) noexcept = default;
selector& selector::operator=(selector&&) noexcept = default;

selector::selector(std::string_view text) {
  if (text.find_first_not_of(" \t\r\n") == text.npos)
    return; // everything
  if (text.size() > longest)
    throw network_error{
        fmt::format("the selector is longer than {} characters", longest)};
  root_ = std::make_unique<const node>(selector_reader{text}.read());
}

bool selector::matches(const properties& of) const {
  return !root_ || evaluate(*root_, of) == true;
}

} // namespace sofof::network::amqp
