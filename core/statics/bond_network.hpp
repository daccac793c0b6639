// The linear stiffness of a bond network: spheres with translations and rotations, bonds as springs with lever arms, bearings to the
// ground.
//
// Nothing is assembled: K q is summed sphere by sphere from the bonds it has, for one or several q at a time.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/bonds/bonds.hpp"
#include "core/parallel/team.hpp"
#include "core/particles/spheres.hpp"
#include "core/statics/elastic.hpp"

namespace proveta {

/// Motions or loads of all spheres, W of them side by side: six rows a sphere, displacement (m) and rotation (rad), or force and moment.
template <int W> using NetworkField = Eigen::Matrix<double, Eigen::Dynamic, W, W == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

class BondNetwork {
  public:
    using Mat6 = Eigen::Matrix<double, 6, 6>;
    using Vec6 = Eigen::Matrix<double, 6, 1>;

    /// One side of a bond, seen from the sphere whose list it is in.
    struct Side {
        std::uint32_t other; ///< sphere
        std::uint32_t bond;
        Vec3 n;                ///< unit vector to the other sphere
        double k_n, k_t;       ///< N/m
        double arm, other_arm; ///< levers of this sphere and of the other, m
        double g, other_g;     ///< in theta of this sphere and of the other (core/bonds/dilatation.hpp), 1/m
        double bend, twist;    ///< N m
    };

    /// The bonds as they are at the start, undamaged. Throws nothing; the spheres' positions are copied.
    BondNetwork(const Spheres& spheres, const Bonds& bonds, std::vector<Bearing> bearings, int threads);

    [[nodiscard]] std::size_t spheres() const { return offset_.size() - 1; }
    [[nodiscard]] bool planar() const { return planar_; }
    [[nodiscard]] const VectorField& position() const { return position_; }
    [[nodiscard]] const std::vector<Bearing>& bearings() const { return bearings_; }
    [[nodiscard]] const std::vector<double>& dilatation() const { return dilatation_; } ///< lambda V of each sphere, J; may be empty
    [[nodiscard]] Team& team() const { return *team_; }

    /// Bond sides of a sphere.
    [[nodiscard]] const Side* begin(std::size_t sphere) const { return sides_.data() + offset_[sphere]; }
    [[nodiscard]] const Side* end(std::size_t sphere) const { return sides_.data() + offset_[sphere + 1]; }

    /// f = K q: forces and moments that hold the motions q. Also theta of each sphere, where bonds have an averaged part.
    template <int W> void apply(const NetworkField<W>& q, NetworkField<W>& f, NetworkField<W>& theta) const;

    /// Stiffness of a sphere with all others held; of the springs alone, or with the averaged part.
    [[nodiscard]] Mat6 diagonal(std::size_t sphere, bool averaged = true) const;
    /// Stiffness of a sphere against motions of the other one through a bond's springs: force on this for a motion of the other.
    [[nodiscard]] static Mat6 coupling(const Side& side);

  private:
    VectorField position_;
    bool planar_;
    std::vector<Bearing> bearings_;
    std::vector<std::uint32_t> bearing_offset_; // of each sphere into bearings_, which are sorted
    std::vector<std::uint32_t> offset_;
    std::vector<Side> sides_;
    std::vector<double> dilatation_;
    std::unique_ptr<Team> team_;
};

/// Largest eigenvalue of M^-1 K of the undamaged bond network by power iteration, rad2/s2; a check on the bound on the stable step.
double largest_eigenvalue(const Spheres& spheres, const Bonds& bonds, int iterations);

} // namespace proveta
