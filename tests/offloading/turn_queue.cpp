// Tests of the order in which parts handle what they are told.
#include "offloading/turn_queue.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using offloading::turn_queue;

namespace {

struct two_parts {
  turn_queue turns;
  turn_queue::part a = turn_queue::make_part(), b = turn_queue::make_part();
  std::string done;

  void post(const turn_queue::part& to, char name) {
    turns.post(to, [this, name](time_point) { done += name; });
  }
};

} // namespace

TEST_CASE_FIXTURE(two_parts, "a part handles what it is told in order, and "
                             "parts take turns") {
  post(a, '1');
  post(a, '2');
  post(b, 'x');
  post(a, '3');
  post(b, 'y');
  turns.run({});
  CHECK(done == "1x2y3");
}

TEST_CASE_FIXTURE(two_parts, "what is told in a turn is handled after it") {
  turns.post(a, [this](time_point) {
    post(a, '3');
    post(b, '2');
    done += '1';
  });
  turns.run({});
  CHECK(done == "123");
}

TEST_CASE_FIXTURE(two_parts, "a turn is told the time of the run") {
  time_point seen;
  turns.post(a, [&](time_point now) { seen = now; });
  turns.run(time_point{duration{7}});
  CHECK(seen == time_point{duration{7}});
}
