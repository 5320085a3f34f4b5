// Linear systems whose matrix is symmetric and positive, and known by what it does to a vector.
//
// Based on: M. R. Hestenes, E. Stiefel, "Methods of Conjugate Gradients for Solving Linear Systems", J. Res. NBS 49(6),
// 1952; with the diagonal as preconditioner.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace lkao::bake {

struct SolverLimits {
  double tolerance = 1e-6;  // of the residual, relative to the right side
  int most_iterations = 500;
};

// Solves A x = b from where x is; `multiply(x, y)` puts A x into y. Where the diagonal is 0 so must the row be: that x
// stays. Returns the number of iterations.
template <class Multiply>
int solve(const Multiply& multiply, std::span<const double> diagonal, std::span<const double> b, std::vector<double>& x,
          const SolverLimits& limits = {}) {
  const std::size_t size = b.size();
  const auto dot = [size](std::span<const double> u, std::span<const double> v) {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) sum += u[i] * v[i];
    return sum;
  };
  const auto precondition = [&](std::span<const double> r, std::vector<double>& z) {
    for (std::size_t i = 0; i < size; ++i) z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0;
  };

  std::vector<double> product(size), residual(size), z(size);
  multiply(x, product);
  for (std::size_t i = 0; i < size; ++i) residual[i] = b[i] - product[i];
  precondition(residual, z);
  std::vector<double> direction = z;
  double energy = dot(residual, z);
  const double enough = limits.tolerance * std::sqrt(dot(b, b));
  int iteration = 0;
  while (iteration < limits.most_iterations && std::sqrt(dot(residual, residual)) > enough) {
    ++iteration;
    multiply(direction, product);
    const double step = energy / dot(direction, product);
    for (std::size_t i = 0; i < size; ++i) {
      x[i] += step * direction[i];
      residual[i] -= step * product[i];
    }
    precondition(residual, z);
    const double next = dot(residual, z);
    for (std::size_t i = 0; i < size; ++i) direction[i] = z[i] + next / energy * direction[i];
    energy = next;
  }
  return iteration;
}

}  // namespace lkao::bake
