// Payloads as what comes by a connection: whatever the frame check admits, the
// actors of both ends live on and keep their promises. They hear all inputs one
// after the other; a finding may need more of them than the last.
#define DOCTEST_CONFIG_IMPLEMENT
#include "tests/actors/hearing.hpp"
#include "tests/fuzz/fuzz.hpp"

#include <caf/init_global_meta_objects.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <random>

using namespace sofof;

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size,
                                        std::size_t most);

namespace {

/// The fixtures of tests check, too.
struct doctest_setup {
  doctest::Context context;

  doctest_setup() {
    caf::init_global_meta_objects<caf::id_block::sofof>();
    caf::core::init_global_meta_objects();
    context.setAsDefaultForAssertsOutOfTestCases();
    context.setAssertHandler(
        [](const doctest::AssertData& x) { fuzz::require(!x.m_failed); });
  }
};

template <class End>
class end_of_connection {
public:
  void hear(std::span<const std::byte> payload) {
    using namespace std::chrono_literals;
    end_.hear(payload);
    ++heard_;
    if (heard_ % 16 == 0) // below what a provider hears
      end_.live(50ms);
    if (heard_ % 256 == 0) {
      fuzz::require(end_.is_unharmed());
      end_.forget();
    }
  }

  std::vector<test::octets> honest() { return end_.honest(); }

private:
  End end_;
  std::uint64_t heard_ = 0;
};

struct both_ends {
  doctest_setup setup;
  end_of_connection<test::hearing_provider> provider;
  end_of_connection<test::hearing_vehicles> vehicles;
  std::array<std::vector<test::octets>, 2> honest{provider.honest(),
                                                  vehicles.honest()};
};

both_ends& ends() {
  static auto& both = *new both_ends; // CAF ends with the process
  return both;
}

} // namespace

/// One input in eight is an honest message, changed once.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data,
                                               std::size_t size,
                                               std::size_t most,
                                               unsigned seed) {
  std::minstd_rand draw{seed};
  if (draw() % 8 == 0) {
    const std::uint8_t end = draw() % 2;
    const auto& honest = ends().honest[end];
    const auto& payload = honest[draw() % honest.size()];
    if (payload.size() < most) {
      data[0] = end;
      std::memcpy(data + 1, payload.data(), payload.size());
      size = 1 + payload.size();
    }
  }
  if (size < 2)
    return LLVMFuzzerMutate(data, size, most);
  return 1 + LLVMFuzzerMutate(data + 1, size - 1, most - 1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  if (size < 2)
    return 0;
  const auto payload = fuzz::octets_of(data, size).subspan(1);
  if (data[0] % 2 == 0)
    ends().provider.hear(payload);
  else
    ends().vehicles.hear(payload);
  return 0;
}
