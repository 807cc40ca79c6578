#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rinkaku::water {

/// A symmetric positive definite matrix whose entries lie near the diagonal, factorised once and solved often.
class BandedCholesky {
 public:
  BandedCholesky() = default;
  /// All entries 0. `band`: how far from the diagonal an entry may lie.
  BandedCholesky(std::size_t size, std::size_t band);

  std::size_t size() const { return size_; }
  /// Adds to the entry at (row, column) and, by symmetry, (column, row). Precondition: column <= row <= column + band.
  void add(std::size_t row, std::size_t column, double value) {
    entries_[row * (band_ + 1) + column + band_ - row] += value;
  }
  /// Replaces the matrix by its factor. Cost: size x band^2 / 2 products. Throws Error (Runtime) if it isn't positive
  /// definite.
  void factorise();
  /// The solution in place of the right-hand side, after factorise(). Cost: 2 x size x band products. No allocation.
  void solve(std::span<double> values) const;

 private:
  std::size_t size_ = 0, band_ = 0;
  std::vector<double> entries_;  // a row's band, ending with its diagonal
};

}  // namespace rinkaku::water
