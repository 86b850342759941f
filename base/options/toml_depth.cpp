// A walk through keys, headers and brackets; strings and comments are skipped.
#include "base/options/toml_depth.hpp"

#include "base/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace sofof {

namespace {

/// As a parser stops at the first mistake, it is enough to see a text as it
/// does up to there.
class depth_checker {
public:
  depth_checker(std::string_view text, std::string_view file)
      : text_{text}, file_{file} {}

  void run() {
    if (text_.starts_with(byte_order_mark))
      at_ = byte_order_mark.size();
    for (; at_ < text_.size(); ++at_)
      look_at(text_[at_]);
  }

private:
  static constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

  enum class part { line_start, header, key, value };

  struct bracket {
    std::size_t depth; ///< Of what stands in it.
    part begins_with;  ///< A key in an inline table, a value in a list.
  };

  void look_at(char c) {
    if (c == ' ' || c == '\t' || c == '\r')
      return;
    if (part_ == part::line_start && c != '\n' && c != '#') {
      part_ = c == '[' ? part::header : part::key;
      set_depth(c == '[' ? 1 : table_depth_ + 1);
      if (c == '[')
        return;
    }
    switch (c) {
      case '#':
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
        return;
      case '"':
      case '\'':
        skip_string(c);
        return;
      case '\n':
        if (open_.empty())
          part_ = part::line_start;
        return;
      case '.':
        if (part_ != part::value)
          set_depth(depth_ + 1);
        return;
      case '=':
        part_ = part::value;
        return;
      case '[':
      case '{':
        set_depth(depth_ + 1);
        if (part_ != part::header) // else it is a [[header]]
          begin(c == '{' ? part::key : part::value);
        return;
      case ',':
        if (!open_.empty()) {
          depth_ = open_.back().depth;
          part_ = open_.back().begins_with;
        }
        return;
      case ']':
      case '}':
        end();
        return;
      default:
        return;
    }
  }

  void begin(part first) {
    open_.push_back({depth_, first});
    part_ = first;
  }

  void end() {
    if (part_ == part::header) {
      table_depth_ = depth_;
    } else if (!open_.empty()) {
      depth_ = open_.back().depth - 1;
      open_.pop_back();
    }
    part_ = part::value;
  }

  void set_depth(std::size_t depth) {
    depth_ = depth;
    if (depth > most_toml_depth)
      refuse();
  }

  /// Goes on to the last character of a string.
  void skip_string(char quote) {
    const std::string_view three = quote == '"' ? R"(""")" : "'''";
    const auto is_long = text_.substr(at_).starts_with(three);
    for (at_ += is_long ? 3 : 1; at_ < text_.size(); ++at_) {
      if (quote == '"' && text_[at_] == '\\') {
        ++at_;
      } else if (is_long && text_.substr(at_).starts_with(three)) {
        at_ += 2;
        // Up to two more quotes belong to the string.
        for (int k = 0; k < 2 && text_.substr(at_ + 1).starts_with(quote); ++k)
          ++at_;
        return;
      } else if (!is_long && text_[at_] == quote) {
        return;
      } else if (!is_long && text_[at_] == '\n') {
        --at_; // a mistake
        return;
      }
    }
  }

  [[noreturn]] void refuse() const {
    const auto before = text_.substr(0, at_);
    const auto line = std::ranges::count(before, '\n') + 1;
    const auto start = before.rfind('\n') + 1; // npos + 1 is 0
    const auto is_first_octet = [](char c) { return (c & 0xc0) != 0x80; };
    const auto column =
        std::ranges::count_if(before.substr(start), is_first_octet) + 1;
    throw input_error{
        fmt::format("{}:{}:{}: this is nested deeper than {} tables and lists.",
                    file_, line, column, most_toml_depth)};
  }

  std::string_view text_;
  std::string_view file_;
  std::size_t at_ = 0;
  part part_ = part::line_start;
  std::size_t depth_ = 0;       // of what is read
  std::size_t table_depth_ = 0; // of the last header
  std::vector<bracket> open_;
};

} // namespace

void check_toml_depth(std::string_view text, std::string_view file) {
  depth_checker{text, file}.run();
}

} // namespace sofof
