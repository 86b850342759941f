// The best assignment in polynomial time, where vehicles want equal amounts.
#pragma once

#include "policies/algorithms/assignment/problem.hpp"

#include <optional>

namespace sofof::policies::assignment {

/// When all who would win by a provider want the same of it, it has a number of
/// seats, and the assignment is a transportation problem: a flow from vehicles
/// to seats, whose cheapest is whole. Vehicles are seated one after the other,
/// each along the shortest path of displacements that ends at a free seat or at
/// home (successive shortest paths, Dijkstra with potentials).
///
/// O(N² M). Providers may differ in what is wanted of them.
/// @returns the optimum; nullopt when demands at a provider are not equal, or
/// when somebody is alone in it who leans on another one.
/// @throws std::invalid_argument as check() does.
/// Source: Ahuja, Magnanti & Orlin, Network Flows (1993), sections 9.7
/// and 12.4.
std::optional<solution> min_cost_flow(const problem& p);

} // namespace sofof::policies::assignment
