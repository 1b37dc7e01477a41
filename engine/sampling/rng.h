#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace patina {

/// Counter-based random numbers (Philox 4x32-10; Salmon et al. 2011): stream k of a seed depends on (seed, k)
/// only, and the whole state is a counter, so that a run can be resumed exactly.
class Rng {
 public:
  using result_type = std::uint32_t;
  explicit Rng(std::uint64_t seed, std::uint64_t stream = 0);

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return 0xffffffffu; }
  result_type operator()();

  double uniform();  ///< (0, 1)
  double normal();   ///< N(0, 1)
  int below(int n);  ///< uniform on 0 ... n-1
  Eigen::VectorXd normals(Eigen::Index n);

  std::uint64_t position() const;  ///< how many 32-bit words have been taken
  void seek(std::uint64_t position);

 private:
  std::uint64_t seed_, stream_, position_ = 0;
  std::array<std::uint32_t, 4> block_{};
};

}  // namespace patina
