// Virtual time: a deterministic discrete-event scheduler for CAF 0.18.
#include "actors/simulation/des_scheduler.hpp"

#include <caf/actor_system.hpp>
#include <caf/actor_system_config.hpp>
#include <caf/message_handler.hpp>
#include <caf/monitorable_actor.hpp>

#include <algorithm>
#include <cassert>
#include <iostream>

namespace sofof::actors {

namespace {

// Takes what actors print through CAF; every scheduler has to bring one.
class console final : public caf::monitorable_actor {
public:
  explicit console(caf::actor_config& cfg) : monitorable_actor(cfg) {}

  bool enqueue(caf::mailbox_element_ptr letter, caf::execution_unit*) override {
    caf::message_handler print{
        [](caf::add_atom, caf::actor_id, const std::string& text) {
          std::cout << text;
        }};
    print(letter->content());
    return true;
  }

  void setup_metrics() {}
};

} // namespace

bool des_clock::later(const entry& a, const entry& b) {
  return a.at != b.at ? a.at > b.at : a.number > b.number;
}

caf::disposable des_clock::schedule_periodically(time_point first,
                                                 caf::action what,
                                                 duration_type period) {
  heap_.push_back({first, ++made_, what, period});
  std::push_heap(heap_.begin(), heap_.end(), later);
  return std::move(what).as_disposable();
}

void des_clock::fire_next() {
  assert(!empty());
  std::pop_heap(heap_.begin(), heap_.end(), later);
  auto next = std::move(heap_.back());
  heap_.pop_back();
  if (next.what.disposed())
    return;
  advance_to(next.at);
  using caf::action;
  const auto again = next.what.run() == action::transition::success
                     && next.period.count() > 0
                     && next.what.reschedule() == action::transition::success;
  if (again)
    schedule_periodically(next.at + next.period, std::move(next.what),
                          next.period);
}

void des_clock::advance_to(time_point t) {
  now_ = std::max(now_, t);
}

des_scheduler::worker::worker(des_scheduler* parent)
    : execution_unit(&parent->system()), parent_(parent) {}

void des_scheduler::worker::exec_later(caf::resumable* job) {
  parent_->jobs_.push_back(job);
}

des_scheduler::des_scheduler(caf::actor_system& sys)
    : abstract_coordinator(sys), worker_(this) {}

caf::actor_system::module* des_scheduler::make(caf::actor_system& sys,
                                               caf::detail::type_list<>) {
  return new des_scheduler(sys);
}

void des_scheduler::run_ready() {
  while (!jobs_.empty()) {
    auto* job = jobs_.front();
    jobs_.pop_front();
    switch (job->resume(&worker_, 1)) {
      case caf::resumable::resume_later:
        jobs_.push_back(job);
        break;
      case caf::resumable::done:
      case caf::resumable::awaiting_message:
        caf::intrusive_ptr_release(job);
        break;
      case caf::resumable::shutdown_execution_unit:
        break;
    }
  }
}

void des_scheduler::run_until(sofof::time_point end) {
  const caf::actor_clock::time_point limit{end.time_since_epoch()};
  for (;;) {
    run_ready();
    if (clock_.empty() || clock_.next() > limit)
      break;
    clock_.fire_next();
  }
  clock_.advance_to(limit);
}

void des_scheduler::start() {
  caf::actor_config cfg{&worker_};
  utility_actors_[printer_id] = caf::make_actor<console, caf::actor>(
      system().next_actor_id(), system().node(), &system(), cfg);
}

// Pending timers die with the clock, so periodic actors cannot keep us here.
void des_scheduler::stop() {
  clock_.clear();
  run_ready();
}

} // namespace sofof::actors
