// A virtual world for tests of single actors: time that obeys, and probes
// that stand in for everybody else and remember what they were told.
#pragma once

#include "actors/runtime/time.hpp"
#include "actors/simulation/des_scheduler.hpp"
#include "messages/type_ids.hpp"

#include <caf/actor_system.hpp>
#include <caf/actor_system_config.hpp>
#include <caf/exit_reason.hpp>
#include <caf/send.hpp>
#include <caf/typed_event_based_actor.hpp>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace sofof::test {

using namespace std::chrono_literals;

/// What a probe was told, and when.
class told {
public:
  struct entry {
    time_point at;
    caf::message what;
    caf::strong_actor_ptr from; ///< Null for nobody.
  };

  void add(time_point at, caf::message what, caf::strong_actor_ptr from) {
    entries_.push_back({at, std::move(what), std::move(from)});
  }

  /// @returns the first elements of all messages that begin with a T, or with a
  /// record that is one.
  template <class T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& e : entries_)
      if (const auto* first = begin_of<T>(e))
        found.push_back(*first);
    return found;
  }

  /// @returns when messages that begin with a T came.
  template <class T>
  std::vector<time_point> times() const {
    std::vector<time_point> found;
    for (const auto& e : entries_)
      if (begin_of<T>(e))
        found.push_back(e.at);
    return found;
  }

  template <class T>
  std::size_t count() const {
    return all<T>().size();
  }

  /// @returns the second elements of all messages whose second is a T.
  template <class T>
  std::vector<T> seconds() const {
    std::vector<T> found;
    for (const auto& e : entries_)
      if (e.what.size() > 1 && e.what.type_at(1) == caf::type_id_v<T>)
        found.push_back(e.what.get_as<T>(1));
    return found;
  }

  const std::vector<entry>& entries() const { return entries_; }
  void clear() { entries_.clear(); }

private:
  template <class T>
  static const T* begin_of(const entry& e) {
    if constexpr (!caf::has_type_id_v<T>) {
      const auto* what = begin_of<messages::record>(e);
      return what ? std::get_if<T>(what) : nullptr;
    } else {
      if (e.what.size() == 0 || e.what.type_at(0) != caf::type_id_v<T>)
        return nullptr;
      return &e.what.get_as<T>(0);
    }
  }

  std::vector<entry> entries_;
};

template <class Signature>
struct listener;

template <class... Ts>
struct listener<caf::result<void>(Ts...)> {
  template <class Self>
  static auto make(Self* self, std::shared_ptr<told> log) {
    return [self, log](const Ts&... xs) {
      log->add(actors::now(self), caf::make_message(xs...),
               self->current_sender());
    };
  }
};

template <class Handle>
struct probe_maker;

template <class... Signatures>
struct probe_maker<caf::typed_actor<Signatures...>> {
  using handle = caf::typed_actor<Signatures...>;
  static auto function(std::shared_ptr<told> log) {
    return [log](typename handle::pointer self) ->
           typename handle::behavior_type {
             return {listener<Signatures>::make(self, log)...};
           };
  }
};

/// An actor that only listens.
template <class Handle>
struct probe {
  Handle handle;
  std::shared_ptr<told> log;

  told* operator->() const { return log.get(); }
};

class virtual_world {
public:
  virtual_world() = default;
  virtual_world(const virtual_world&) = delete;

  ~virtual_world() {
    for (auto i = owned_.rbegin(); i != owned_.rend(); ++i)
      caf::anon_send_exit(*i, caf::exit_reason::user_shutdown);
    scheduler().run_ready();
  }

  caf::actor_system& system() { return system_; }

  time_point now() {
    return time_point{scheduler().clock().now().time_since_epoch()};
  }

  void run_for(duration d) { scheduler().run_until(now() + d); }
  void settle() { scheduler().run_ready(); }

  /// Keeps an actor until the world ends, and ends it then.
  template <class Handle>
  Handle own(Handle handle) {
    owned_.push_back(caf::actor_cast<caf::actor>(handle));
    return handle;
  }

  template <class Handle>
  probe<Handle> listen() {
    auto log = std::make_shared<told>();
    return {own(system_.spawn(probe_maker<Handle>::function(log))), log};
  }

  /// Delivers a message, and lets everything happen that is due now.
  template <class Handle, class... Ts>
  void tell(const Handle& receiver, Ts&&... xs) {
    caf::anon_send(receiver, std::forward<Ts>(xs)...);
    settle();
  }

  /// The same, in the name of `sender`.
  template <class Sender, class Handle, class... Ts>
  void tell_as(const Sender& sender, const Handle& receiver, Ts&&... xs) {
    caf::send_as(caf::actor_cast<caf::actor>(sender),
                 caf::actor_cast<caf::actor>(receiver),
                 std::forward<Ts>(xs)...);
    settle();
  }

  /// Ends an actor as a crash would.
  template <class Handle>
  void kill(const Handle& handle) {
    caf::anon_send_exit(handle, caf::exit_reason::kill);
    settle();
  }

  /// @returns whether an actor has quit or was ended.
  template <class Handle>
  static bool is_gone(const Handle& handle) {
    // CAF calls back at once for an actor that is gone, else some day.
    auto gone = std::make_shared<bool>(false);
    caf::actor_cast<caf::actor>(handle)->attach_functor(
        [gone] { *gone = true; });
    return *gone;
  }

private:
  struct config : caf::actor_system_config {
    config() { load<actors::des_scheduler>(); }
  };

  actors::des_scheduler& scheduler() {
    return dynamic_cast<actors::des_scheduler&>(system_.scheduler());
  }

  config config_;
  caf::actor_system system_{config_};
  std::vector<caf::actor> owned_;
};

} // namespace sofof::test
