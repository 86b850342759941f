// Results that come from another host, on their way to the disk.
#include "scenario/sweep/result_files.hpp"

#include "scenario/results_folder.hpp"
#include "scenario/sweep/order_files.hpp"

#include <utility>

namespace sofof {

namespace {

constexpr auto summary_name = "summary.json";
constexpr std::size_t longest_summary = std::size_t{16} << 20;

} // namespace

result_files::result_files(std::filesystem::path folder)
    : folder_{std::move(folder)} {
  constexpr auto whatever_is_there = true;
  make_results_folder(folder_, {}, 0, whatever_is_there);
  remove_results(folder_);
}

std::optional<std::string> result_files::take(const file_piece& piece) {
  octets_ += piece.octets.size();
  if (octets_ > largest_results)
    return "it sends more than a run can have";
  if (piece.file != current_) {
    if (!is_result_name(piece.file) || !met_.insert(piece.file).second)
      return "it sends files that no run has";
    if (file_)
      file_->close();
    file_.reset();
    current_ = piece.file;
    if (current_ != summary_name)
      file_.emplace(folder_ / current_);
  }
  if (file_) {
    file_->text() += piece.octets;
    file_->end_line();
    return std::nullopt;
  }
  summary_ += piece.octets;
  if (summary_.size() > longest_summary)
    return "it sends a summary that no run has";
  return std::nullopt;
}

std::optional<std::string> result_files::finish() {
  if (!met_.contains(summary_name))
    return "it sends no summary";
  if (file_)
    file_->close();
  write_file(folder_ / summary_name, summary_);
  return std::nullopt;
}

} // namespace sofof
