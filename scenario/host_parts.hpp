// What providers and vehicles on hosts of their own have in common, whatever
// connects them.
#pragma once

#include "actors/remote/acceptor.hpp"
#include "actors/remote/provider_connection.hpp"
#include "network/keys/key_ring.hpp"
#include "scenario/build.hpp"
#include "scenario/hosts.hpp"
#include "scenario/news_board.hpp"
#include "scenario/runtime.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// @returns what a run asks for news, which also reads the keys again when
/// they have changed.
/// @param keys  May be null.
std::function<std::vector<std::string>()>
news_of(std::shared_ptr<news_board> board, const host_options& what,
        std::shared_ptr<network::key_ring> keys);

/// @param keys  May be null: then there is nothing to tell.
std::function<void(recording::exposition&)>
figures_of(std::shared_ptr<network::key_ring> keys);

/// @returns the place of a provider in the scenario, counting from 0.
/// @throws input_error when there is none of this name.
std::size_t find_provider(const scenario_definition& s, std::string_view name,
                          std::string_view option);

/// Asks whether a hello is signed for the stations that it names.
actors::peer_finding examine_signature(const network::credentials& own,
                                       const messages::peer_hello& hello,
                                       const std::string& nonce);

/// On this machine alone nobody proves anything, and any stations are a peer.
actors::peer_finding believe(const messages::peer_hello& hello);

/// @throws input_error when the certificate in this folder is another's.
void check_identity(const network::credentials& own, const std::string& folder,
                    const std::string& provider);
void check_identity(const network::credentials& own, const std::string& folder,
                    const std::vector<station_id>& stations);

/// @throws input_error when the provider is to fail, which no process can.
void check_lives(const provider_options& provider);

/// @returns those of a process that drive connected, in order.
std::vector<station_id> connected_stations(const scenario_definition& s,
                                           const process_share& here);

/// @returns what such a process has of a run, for its part of the scenario.
run_options options_of_host(run_options options, std::string_view role,
                            std::string whose);

/// @returns the part of a process that runs one provider, for others.
process_share share_of_provider(std::size_t place, const runtime& time);

/// @returns the part of a process that drives these stations, of all if none is
/// given.
/// @throws input_error when the scenario lacks one of them.
process_share share_of_vehicles(const scenario_definition& s,
                                const std::set<station_id>& wanted);

/// @returns whom a provider lets in; what is of its actors is filled in later,
/// and how it examines a hello.
actors::acceptor_setup acceptor_of(const scenario_definition& s,
                                   std::size_t place, bool own_map,
                                   const runtime& time,
                                   const std::shared_ptr<news_board>& board);

/// @returns the connection to one provider, as far as it is like that to any.
actors::provider_connection_setup
connection_to(const scenario_definition& s, std::size_t place,
              const drive_options& what,
              const std::vector<station_id>& stations,
              const std::shared_ptr<news_board>& board);

/// Has a connection prove that it may speak for its stations.
void prove_by(const std::shared_ptr<network::key_ring>& keys,
              actors::provider_connection_setup& setup);

} // namespace sofof::scenario
