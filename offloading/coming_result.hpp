// The result of a cycle that perhaps is still being computed.
#pragma once

#include "base/job_pool.hpp"
#include "offloading/service_function.hpp"

#include <functional>
#include <memory>
#include <optional>

namespace sofof::offloading {

/// What is left of a cycle that has been begun, for a pool to compute.
class coming_output {
public:
  /// @param of    Lives until this has been computed.
  /// @param left  What `of` has begun.
  coming_output(std::shared_ptr<service_function> of,
                std::function<service_output()> left);

  void begin(job_pool& pool) { pool.begin(job_); }

  /// Returns when it has been computed.
  /// @throws what the function threw.
  void wait() const { job_->wait(); }

  /// Waits. To be called once.
  /// @throws what the function threw.
  service_output take();

private:
  std::shared_ptr<service_output> made_ = std::make_shared<service_output>();
  job_ptr job_;
};

/// What a cycle gives, and when: in virtual time it is due when the computer
/// that is modelled has done with it, whoever computes it here.
struct coming_result {
  messages::service_result frame; ///< Complete, if there is no `output`.
  std::shared_ptr<coming_output> output;

  /// Waits, if need be. To be called once.
  /// @returns nullopt if the cycle gave nothing.
  /// @throws what the function threw.
  std::optional<messages::service_result> take();
};

} // namespace sofof::offloading
