#include "water/banded_cholesky.h"

#include <algorithm>
#include <cmath>

#include "pipeline/frame/error.h"

namespace rinkaku::water {

BandedCholesky::BandedCholesky(std::size_t size, std::size_t band)
    : size_(size), band_(band), entries_(size * (band + 1), 0.0) {}

void BandedCholesky::factorise() {
  const std::size_t stride = band_ + 1;
  for (std::size_t i = 0; i < size_; ++i) {
    double* row = entries_.data() + i * stride;
    const std::size_t first = i > band_ ? i - band_ : 0;
    for (std::size_t j = first; j <= i; ++j) {
      const double* other = entries_.data() + j * stride;
      const std::size_t from = std::max(first, j > band_ ? j - band_ : 0);
      const double* a = row + (from + band_ - i);
      const double* b = other + (from + band_ - j);
      // Four sums side by side: a single one would wait for each addition before it.
      double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
      std::size_t k = 0;
      const std::size_t n = j - from;
      for (; k + 4 <= n; k += 4) {
        s0 += a[k] * b[k], s1 += a[k + 1] * b[k + 1], s2 += a[k + 2] * b[k + 2], s3 += a[k + 3] * b[k + 3];
      }
      for (; k < n; ++k) s0 += a[k] * b[k];
      const double rest = row[j + band_ - i] - ((s0 + s1) + (s2 + s3));
      if (j < i) {
        row[j + band_ - i] = rest / other[band_];
      } else {
        if (!(rest > 0)) throw runtime_failure("water", "the flow's equations can't be solved");
        row[band_] = std::sqrt(rest);
      }
    }
  }
}

void BandedCholesky::solve(std::span<double> values) const {
  const std::size_t stride = band_ + 1;
  for (std::size_t i = 0; i < size_; ++i) {
    const double* row = entries_.data() + i * stride;
    double sum = values[i];
    for (std::size_t j = i > band_ ? i - band_ : 0; j < i; ++j) sum -= row[j + band_ - i] * values[j];
    values[i] = sum / row[band_];
  }
  for (std::size_t i = size_; i-- > 0;) {
    const double* row = entries_.data() + i * stride;
    values[i] /= row[band_];
    for (std::size_t j = i > band_ ? i - band_ : 0; j < i; ++j) values[j] -= row[j + band_ - i] * values[i];
  }
}

}  // namespace rinkaku::water
