// Memory that calls in one thread use one after the other.
#include "base/thread_room.hpp"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

using sofof::thread_room;

namespace {

/// Has room for a call only.
struct caller {
  std::vector<double> numbers;

  const double* call(std::size_t count) {
    const thread_room lent{numbers};
    numbers.assign(count, 1.0);
    return numbers.data();
  }
};

} // namespace

TEST_CASE("a second caller gets the room of the first, which keeps none") {
  caller one, two;
  const auto* const room = one.call(1000);
  CHECK(one.numbers.capacity() == 0);
  CHECK(two.call(900) == room);
  CHECK(one.call(1000) == room);
}

TEST_CASE("a call within a call has a room of its own") {
  caller one, two;
  const thread_room lent{one.numbers};
  one.numbers.assign(10, 7.0);
  CHECK(two.call(10) != one.numbers.data());
  CHECK(one.numbers == std::vector<double>(10, 7.0));
}

TEST_CASE("another thread has another room") {
  caller one;
  const auto* const room = one.call(1000);
  const double* other = nullptr;
  std::thread{[&other, room] {
    caller two;
    other = two.call(1000);
    CHECK(other != room);
  }}.join();
  CHECK(one.call(1000) == room);
}
