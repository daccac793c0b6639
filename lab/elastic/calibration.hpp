// Elastic calibration: the factors with which a specimen has the Young's modulus and Poisson's ratio of its card.
#pragma once

#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/bonds/bonds.hpp"
#include "core/laws/material.hpp"
#include "specimens/shape.hpp"

namespace proveta {

/// What a calibration found. Factors as in Material.
struct ElasticFactors {
    double normal_factor = 1.0;   ///< a
    double shear_factor = 1.0;    ///< b
    double averaged_factor = 0.0; ///< lambda / (a E)
};

struct ElasticCalibration {
    ElasticFactors factors;
    double young_modulus = 0.0;        ///< that the specimen has with them, by the elastic solve, Pa
    double poisson_ratio = 0.0;        ///< the same
    double wanted_poisson_ratio = 0.0; ///< the card's
    bool in_reach = true;              ///< bonds alone, or with the averaged part, give the card's ratio
    std::optional<double> furthest;    ///< where bonds alone do not give the card's ratio: the nearest that they do
    int solves = 0;
};

/// A calibration that cannot be made, and why.
struct NotCalibrated : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Finds the factors of a material. network: the specimen's bonds as a material makes them, the same pairs every time. averaged: the
/// averaged part of the stress (core/bonds/dilatation.hpp) may be used where the ratio k_t / k_n alone cannot give the card's nu; k_t / k_n
/// is then 1 / (2 (1 + nu)) (5.17). nu is met to 2e-4, E exactly, both by the gauges of a uniaxial test between platens without
/// friction (press_uniaxially): E is proportional to a, nu falls with k_t / k_n and grows with lambda; secants find both.
/// Throws NotCalibrated; also where the platens touch too few spheres, the network is in pieces (pressable.hpp) or its ends give way.
ElasticCalibration calibrate_elasticity(const Shape& shape, const Spheres& spheres, const Material& material, bool averaged,
                                        const std::function<Bonds(const Material&)>& network);

/// The calibration in words, for logs and reports.
std::string text_of(const ElasticCalibration& calibration);

} // namespace proveta
