// Policies by name: the one place that knows them all.
#include "policies/registry.hpp"

#include "policies/baselines.hpp"
#include "policies/location.hpp"

#include <array>

namespace sofof {

namespace {

template <class Policy>
struct entry {
  std::string_view name;
  std::unique_ptr<Policy> (*make)();
};

constexpr std::array<entry<local_policy>, 3> lodms{{
    {"location",
     []() -> std::unique_ptr<local_policy> {
       return std::make_unique<location_lodm>();
     }},
    {"always",
     []() -> std::unique_ptr<local_policy> {
       return std::make_unique<constant_lodm>(true);
     }},
    {"never",
     []() -> std::unique_ptr<local_policy> {
       return std::make_unique<constant_lodm>(false);
     }},
}};

constexpr std::array<entry<central_policy>, 3> codms{{
    {"location",
     []() -> std::unique_ptr<central_policy> {
       return std::make_unique<location_codm>();
     }},
    {"always",
     []() -> std::unique_ptr<central_policy> {
       return std::make_unique<constant_codm>(true);
     }},
    {"never",
     []() -> std::unique_ptr<central_policy> {
       return std::make_unique<constant_codm>(false);
     }},
}};

template <class Entries>
auto make(const Entries& entries, std::string_view name) {
  for (const auto& e : entries)
    if (e.name == name)
      return e.make();
  return decltype(entries[0].make()){};
}

template <class Entries>
auto names(const Entries& entries) {
  std::vector<std::string_view> result;
  for (const auto& e : entries)
    result.push_back(e.name);
  return result;
}

} // namespace

std::unique_ptr<local_policy> make_lodm(std::string_view name) {
  return make(lodms, name);
}

std::unique_ptr<central_policy> make_codm(std::string_view name) {
  return make(codms, name);
}

std::vector<std::string_view> lodm_names() {
  return names(lodms);
}

std::vector<std::string_view> codm_names() {
  return names(codms);
}

} // namespace sofof
