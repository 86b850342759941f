// Teaches the learners in a toy world: train_learners
// policies/learning/snapshots
#define DOCTEST_CONFIG_IMPLEMENT
#include "policies/registry.hpp"
#include "tests/support/option_list.hpp"
#include "tests/support/toy_drive.hpp"

#include <fstream>
#include <iostream>
#include <string>

using namespace sofof;

int main(int count, char** words) {
  if (count != 2) {
    std::cerr << "Say where the snapshots shall go: train_learners FOLDER\n";
    return 2;
  }
  doctest::Context checks;
  checks.setAsDefaultForAssertsOutOfTestCases();
  for (const std::string name : {"q_learning", "dqn"}) {
    const auto lodm = make_lodm(name);
    test::option_list learning;
    learning.flags = {{"learning", true}};
    lodm->fields(learning);
    constexpr int drives = 6000;
    std::cout << name << " learned at "
              << test::mean_cost(*lodm, 1'000'000, drives);
    std::ofstream file{words[1] + ("/" + name) + ".txt", std::ios::binary};
    file << lodm->snapshot();
    if (!file.flush()) {
      std::cerr << "\nCannot write to " << words[1] << ".\n";
      return 1;
    }
    const auto frozen = make_lodm(name);
    frozen->restore(lodm->snapshot());
    std::cout << ", costs " << test::mean_cost(*frozen, 1, 500)
              << " a drive (always "
              << test::mean_cost(*make_lodm("always"), 1, 500) << ", never "
              << test::mean_cost(*make_lodm("never"), 1, 500)
              << ", greedy_gain "
              << test::mean_cost(*make_lodm("greedy_gain"), 1, 500) << ")\n";
  }
}
