// A provider that lies about tracks or scenes: what vehicles must survive.
#pragma once

#include "actors/services/service_type.hpp"
#include "base/time.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace sofof::experiments::torture {

/// What tracking or the environment model at a provider may say instead of what
/// it has found.
enum class chain_lie {
  tracks_removed,  ///< No body within 60 m ahead of the vehicle is told.
  tracks_added,    ///< A car stands 15 m before it.
  tracks_shifted,  ///< All bodies within 60 m are 3 m farther left.
  tracks_slowed,   ///< They are told to move half as fast.
  tracks_hidden,   ///< No body is told that the vehicle does not see itself.
  tracks_new_ids,  ///< All of them are 0.7 m farther on and 0.45 m farther
                   ///< left, by new numbers in each result.
  scene_removed,   ///< Nobody leads, crosses, or is beside.
  scene_added,     ///< A lead stands 12 m before it.
  scene_shifted,   ///< Leads and who crosses are 12 m farther, and those beside
                   ///< 1.5 m farther beside.
  scene_map,       ///< All of it is 8 m farther on: by a map that is shifted.
  scene_lead_fast, ///< Leads are 5 m nearer and drive at 50 m/s.
  scene_gives_way, ///< Who leads or is beside crosses there and gives way.
  scene_told_moment,   ///< Leads tell where they are now, and nothing else.
  scene_beside_fast,   ///< Bodies beside drive at 50 m/s.
  scene_far_crossings, ///< Four more cross 300 m ahead, for minutes.
};

inline constexpr std::array<std::string_view, 15> chain_lie_names{
    "tracks_removed",    "tracks_added",      "tracks_shifted",
    "tracks_slowed",     "tracks_hidden",     "tracks_new_ids",
    "scene_removed",     "scene_added",       "scene_shifted",
    "scene_map",         "scene_lead_fast",   "scene_gives_way",
    "scene_told_moment", "scene_beside_fast", "scene_far_crossings"};

/// @returns nullopt for a name that no such lie has.
std::optional<chain_lie> chain_lie_of(std::string_view name);

/// @returns the name of the service that tells this lie.
std::string_view liar_of(chain_lie what);

/// Counts results that are not what an honest service had told.
using lies_told = std::shared_ptr<std::atomic<std::uint64_t>>;

/// The results that come down are changed. A function that runs beside this one
/// at the provider asks the honest one.
/// @param honest  The service of that name.
/// @param after   The first results of each session are honest.
/// @param told    Counts, if it is there.
/// @returns the service as it is in vehicles, with providers that lie.
actors::service_type_ptr lying_chain(actors::service_type_ptr honest,
                                     chain_lie what,
                                     duration after = std::chrono::seconds{8},
                                     lies_told told = nullptr);

} // namespace sofof::experiments::torture
