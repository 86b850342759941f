// Admission by deadlines: every result of every service is to be in time.
#include "policies/deadline_admission.hpp"

#include "world/spelling.hpp"

#include <algorithm>
#include <array>

namespace sofof {

namespace {

constexpr std::array<std::string_view, 3> tests{"utilisation", "demand",
                                                "phases"};

admission_test test_of(std::string_view name) {
  const auto found = std::ranges::find(tests, name);
  return static_cast<admission_test>(found - tests.begin());
}

} // namespace

periodic_task deadline_admission::to_schedule(const periodic_task& told) const {
  auto task = told;
  task.wcet = from_seconds(to_seconds(told.wcet) * (1 + margin_));
  task.deadline -= network_;
  return task;
}

std::vector<central_decision>
deadline_admission::decide(const central_context& context) {
  std::vector<std::vector<periodic_task>> workers(context.workers);
  for (const auto& session : context.sessions)
    workers[std::min(session.worker, context.workers - 1)].push_back(
        to_schedule(session.task));
  std::vector<central_decision> all;
  for (const auto& request : context.requests) {
    auto task = to_schedule(request.task);
    const auto place = worst_fit(workers, task, test_of(test_));
    if (!place) {
      all.push_back({false, "a deadline would be missed"});
      continue;
    }
    task.offset = place->offset;
    workers[place->core].push_back(task);
    all.push_back({true, "all deadlines are kept", *place});
  }
  return all;
}

void deadline_admission::fields(settings& s) {
  s.field("test", test_);
  if (std::ranges::find(tests, test_) == tests.end())
    s.refuse("test", unknown_word("test", test_, tests));
  s.field("network", network_, duration{0});
  s.field("margin", margin_, {0, 10});
}

std::unique_ptr<central_policy> deadline_admission::clone() const {
  return std::make_unique<deadline_admission>(*this);
}

} // namespace sofof
