// Messages whose octets were changed on their way: what the frame check admits
// reaches the actors of both ends, and harms neither. tests/fuzz/handlers looks
// for more of them.
#include "tests/actors/hearing.hpp"

#include <random>

namespace sofof::test::changes {

namespace {

constexpr std::size_t wanted = 20'000;

class changer {
public:
  octets operator()(octets x) {
    constexpr std::byte odd[] = {std::byte{0}, std::byte{1}, std::byte{0x7f},
                                 std::byte{0x80}, std::byte{0xff}};
    for (auto n = draw(5); n > 0; --n) {
      const auto at =
          x.begin() + static_cast<std::ptrdiff_t>(draw(x.size() - 1));
      switch (draw(3)) {
        case 0:
          *at = odd[draw(4)];
          break;
        case 1:
          *at = static_cast<std::byte>(draw(255));
          break;
        case 2:
          x.insert(at, draw(8), odd[draw(4)]);
          break;
        default:
          if (x.size() > 8)
            x.erase(at, at + std::min<std::ptrdiff_t>(4, x.end() - at));
      }
    }
    return x;
  }

  /// @returns a number from 0 on.
  std::size_t draw(std::size_t most) {
    return std::uniform_int_distribution<std::size_t>{0, most}(numbers_);
  }

private:
  std::mt19937 numbers_{20};
};

/// Lets one end hear changes of what is honest.
/// @returns how many were admitted and could be read.
template <class End>
std::size_t send_changed(End& end) {
  changer change;
  const auto honest = end.honest();
  std::size_t read = 0;
  for (std::size_t n = wanted; n > 0; --n) {
    if (!end.hear(change(honest[change.draw(honest.size() - 1)])))
      continue;
    ++read;
    if (n % 16 == 0) // below what a provider hears
      end.live(50ms);
    if (n % 1024 == 0) {
      REQUIRE(end.is_unharmed());
      end.forget();
    }
  }
  end.live(1s);
  REQUIRE(end.is_unharmed());
  return read;
}

} // namespace

TEST_CASE_FIXTURE(hearing_provider,
                  "whatever admitted messages hold, a provider "
                  "lives on, and speaks for its stations "
                  "alone") {
  CHECK(send_changed(*this) > wanted / 10);
}

TEST_CASE_FIXTURE(hearing_vehicles, "whatever admitted messages hold, vehicles "
                                    "keep their connection") {
  CHECK(send_changed(*this) > wanted / 10);
}

} // namespace sofof::test::changes
