// Memory that calls in one thread use one after the other.
#pragma once

#include <tuple>

namespace sofof {

/// Lends containers the memory that the last ones of these types in this thread
/// have left, for the time of a call. For many objects that need much room for
/// a short time, and remember nothing in it. What they contain at first is
/// anything.
template <class... Ts>
class thread_room {
public:
  explicit thread_room(Ts&... to) : to_{to...} { swap(); }
  ~thread_room() { swap(); }
  thread_room(const thread_room&) = delete;
  thread_room& operator=(const thread_room&) = delete;

private:
  void swap() {
    static thread_local std::tuple<Ts...> kept;
    std::apply([](Ts&... own) { return std::tie(own...); }, kept).swap(to_);
  }

  std::tuple<Ts&...> to_;
};

} // namespace sofof
