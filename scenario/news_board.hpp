// What a process that talks to others says to people.
#pragma once

#include "base/text/printable.hpp"
#include "scenario/run.hpp"

#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sofof::scenario {

/// What actors say to people; the console's thread asks for it.
class news_board {
public:
  void log(std::string line) {
    const std::lock_guard lock{mutex_};
    lines_.push_back(printable(std::move(line)));
  }
  void refuse(const std::string& why) {
    const std::lock_guard lock{mutex_};
    if (is_connected_) // to another provider: whoever drives goes on
      lines_.push_back(printable(why));
    else
      refusal_ = printable(why);
  }
  void connected() {
    const std::lock_guard lock{mutex_};
    is_connected_ = true;
  }

  /// @throws start_refused once we have been refused.
  std::vector<std::string> take() {
    const std::lock_guard lock{mutex_};
    if (refusal_)
      throw start_refused(*refusal_);
    return std::exchange(lines_, {});
  }

private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
  std::optional<std::string> refusal_;
  bool is_connected_ = false;
};

} // namespace sofof::scenario
