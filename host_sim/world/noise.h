#pragma once
// Smooth pseudo-random fields for textures: value noise on an integer lattice, [-1, 1].

#include <Eigen/Core>
#include <cstdint>

namespace dottrack::host_sim {

double value_noise(const Eigen::Vector2d& p, std::uint64_t seed);
double value_noise(const Eigen::Vector3d& p, std::uint64_t seed);

// The sum of octaves, each of half the wavelength and half the amplitude of the one before;
// normalised to [-1, 1].
double fractal_noise(const Eigen::Vector2d& p, int octaves, std::uint64_t seed);

}  // namespace dottrack::host_sim
