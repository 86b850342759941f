// What is known of the others before a plan is made, by the services that come
// before planning in a chain, and who knows it at a provider.
#pragma once

#include "base/ids.hpp"
#include "base/time.hpp"
#include "messages/protocol/payload.hpp"
#include "planners/scene/driving_scene.hpp"
#include "planners/scene/told_drive.hpp"
#include "planners/scene/track.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <vector>

namespace sofof::actors {

/// What a tracking function has found.
struct known_tracks {
  std::vector<planners::track> all;
};

/// What an environment model has found.
struct known_scene {
  planners::driving_scene scene; ///< On the vehicle's route, at its `at`.
  /// What it was made of, if that was in the vehicle: the scene of any later
  /// moment can be made of it. Null: a provider told the scene.
  std::shared_ptr<const known_tracks> made_of;
};

/// What the services of a chain have found so far; null: that one is not there
/// or has not found anything yet. It stays in the vehicle.
struct chain_findings {
  std::shared_ptr<const known_tracks> tracks;
  provider_id tracks_by = 0; ///< Where they were found; 0: in the vehicle.
  std::shared_ptr<const known_scene> scene;
  provider_id scene_by = 0;
};

// Neither ever leaves the vehicle as it is.
void visit_fields(auto&, known_tracks&) {}
void visit_fields(auto&, known_scene&) {}

/// Who knows the others at a provider.
class others_source {
public:
  virtual ~others_source() = default;

  /// Copies what is known now and believed by who plans for `station`.
  virtual void tracks(std::vector<planners::track>& out,
                      station_id station) = 0;

  /// Copies what others than `station` say of their drives.
  virtual void drives(std::vector<planners::told_drive>& out,
                      station_id station) = 0;
};

/// Who knows the others at a provider: all that is heard there, or a service of
/// a chain.
enum class chain_part : std::uint8_t { hearing, tracking, environment };

/// What the services of a chain share where they run beside each other at a
/// provider.
class functions_beside {
public:
  /// This function runs there for this vehicle.
  void add(chain_part part, provider_id provider, station_id vehicle,
           const std::shared_ptr<others_source>& what) {
    const std::lock_guard lock{mutex_};
    std::erase_if(running_, [](const auto& x) { return x.second.expired(); });
    running_[{part, provider, vehicle}] = what;
  }

  /// @returns whom one that follows it there asks, so that its result need not
  /// go up again; null if it does not run there.
  std::shared_ptr<others_source> find(chain_part part, provider_id provider,
                                      station_id vehicle) const {
    const std::lock_guard lock{mutex_};
    const auto i = running_.find({part, provider, vehicle});
    return i == running_.end() ? nullptr : i->second.lock();
  }

private:
  mutable std::mutex mutex_;
  std::map<std::tuple<chain_part, provider_id, station_id>,
           std::weak_ptr<others_source>>
      running_;
};

} // namespace sofof::actors

template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::known_tracks> = "known_tracks";
template <>
inline constexpr std::string_view
    sofof::messages::payload_name<sofof::actors::known_scene> = "known_scene";
