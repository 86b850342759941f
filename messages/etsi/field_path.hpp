// The way to a field of a message: "cam.camParameters.pathHistory[3]".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages::etsi {

class field_path {
public:
  void enter(std::string_view name) {
    ends_.push_back(text_.size());
    if (!text_.empty())
      text_ += '.';
    text_ += name;
  }
  void enter(std::size_t index) {
    ends_.push_back(text_.size());
    text_ += '[' + std::to_string(index) + ']';
  }
  void leave() {
    text_.resize(ends_.back());
    ends_.pop_back();
  }
  /// @returns what is seen from the outside: "the message" at its top.
  std::string text() const { return text_.empty() ? "the message" : text_; }

private:
  std::string text_;
  std::vector<std::size_t> ends_; // of the text, one level up each
};

} // namespace sofof::messages::etsi
