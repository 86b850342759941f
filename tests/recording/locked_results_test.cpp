// Results on a disk that takes no more, which /dev/full stands for.
#include "recording/locked_results.hpp"

#include "tests/support/contains.hpp"
#include "tests/support/made_up_run.hpp"
#include "tests/support/scratch.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

namespace sofof::made_up {

using namespace messages;
using namespace recording;

namespace {

run_info onto_full_disk() {
  auto info = run();
  info.pcap = "/dev/full";
  return info;
}

constexpr int many = 2000;

/// Takes records whose lines fill many blocks.
void record_many(record_sink& keeper) {
  for (int k = 0; k < many; ++k) {
    keeper.on_record(result(running(), static_cast<std::uint64_t>(k), 1s, 5ms,
                            std::nullopt));
    keeper.on_record(air_record{});
  }
}

std::uint64_t results_counted(locked_results& keeper) {
  return keeper.with([](const results& r) {
    return r.so_far().headline().latency.ms().count();
  });
}

} // namespace

TEST_CASE("records are counted once, whether their files can be written or "
          "not") {
  const test::scratch at;
  locked_results keeper{at.path(), onto_full_disk(),
                        write_failure::ends_the_files};
  CHECK_FALSE(keeper.loss());
  record_many(keeper);
  keeper.with([](results& r) { r.flush(); });
  REQUIRE(keeper.loss());
  CHECK(test::contains(*keeper.loss(), "/dev/full: No space left on device"));
  record_many(keeper);
  CHECK(results_counted(keeper) == 2 * many);
  CHECK(
      keeper
          .with([](results& r) { return r.finish(made_up::at(9s), 1, false); })
          .virtual_s
      == 9);
  CHECK_FALSE(std::filesystem::exists(at / "summary.json"));
}

TEST_CASE("a disk that is full at the end only is told, too") {
  const test::scratch at;
  locked_results keeper{at.path(), onto_full_disk(),
                        write_failure::ends_the_files};
  keeper.on_record(air_record{});
  CHECK_FALSE(keeper.loss());
  keeper.with([](results& r) { return r.finish(made_up::at(9s), 1, false); });
  CHECK(keeper.loss());
}

TEST_CASE("a full disk ends a run that has to leave results") {
  const test::scratch at;
  locked_results keeper{at.path(), onto_full_disk()};
  record_many(keeper);
  CHECK_THROWS_AS(keeper.with([](results& r) { r.flush(); }), storage_error);
}

TEST_CASE("without files from the beginning all is counted") {
  locked_results keeper{run(), "the disk is full"};
  CHECK(keeper.loss() == "the disk is full");
  record_many(keeper);
  CHECK(results_counted(keeper) == many);
}

} // namespace sofof::made_up
