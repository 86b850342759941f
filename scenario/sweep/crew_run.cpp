// A run for another host: its files come in, the crew carries it out, and its
// results go out.
#include "scenario/sweep/crew_run.hpp"

#include "scenario/results_folder.hpp"
#include "scenario/sweep/order_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sofof {

namespace fs = std::filesystem;

namespace {

class crew_run final : public ordered_run {
public:
  crew_run(std::shared_ptr<crew> hands, fs::path folder)
      : hands_{std::move(hands)}, order_{std::make_shared<run_order>(
                                      std::move(folder))} {}

  ~crew_run() override { order_->interrupted = true; }

  std::optional<std::string> add(const file_piece& piece) override {
    if (std::ranges::find(files_of_an_order, piece.file)
        == std::end(files_of_an_order))
      return "no order has a file of that name";
    given_ += piece.octets.size();
    if (given_ > largest_order)
      return fmt::format("the order is larger than {} MiB",
                         largest_order >> 20);
    std::ofstream file{order_->given() / piece.file,
                       std::ios::binary | std::ios::app};
    file << piece.octets << std::flush;
    if (!file)
      throw std::runtime_error{"it cannot keep the order; is its disk full?"};
    return std::nullopt;
  }

  void begin(std::function<void()> on_end) override {
    hands_->add(order_, std::move(on_end));
  }

  run_report report() override {
    const auto end = order_->ended();
    return {end.has_value(), end.value_or("")};
  }

  file_piece next() override {
    if (!listed_)
      list();
    if (left_.empty())
      return {};
    if (!file_.is_open())
      file_.open(order_->results() / left_.back(), std::ios::binary);
    file_piece piece{left_.back(), std::string(longest_piece, '\0')};
    file_.read(piece.octets.data(), longest_piece);
    if (!file_.is_open() || file_.bad())
      throw std::runtime_error{"it cannot read the results"};
    piece.octets.resize(static_cast<std::size_t>(file_.gcount()));
    if (file_.eof()) {
      file_ = {};
      left_.pop_back();
    }
    return piece;
  }

private:
  void list() {
    listed_ = true;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator{order_->results(), none})
      if (entry.is_regular_file() && !entry.is_symlink()
          && is_result_name(entry.path().filename().string()))
        left_.push_back(entry.path().filename().string());
    std::ranges::sort(left_);
  }

  std::shared_ptr<crew> hands_;
  std::shared_ptr<run_order> order_;
  std::size_t given_ = 0;
  bool listed_ = false;
  std::vector<std::string> left_;
  std::ifstream file_;
};

} // namespace

std::unique_ptr<ordered_run> make_crew_run(std::shared_ptr<crew> hands,
                                           fs::path folder) {
  return std::make_unique<crew_run>(std::move(hands), std::move(folder));
}

} // namespace sofof
