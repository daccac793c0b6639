// A preconditioner for the stiffness of a bond network: each sphere by itself, and clumps of spheres as rigid bodies.
//
// Conjugate gradients carry a motion one bond a step; the clumps carry what is long-waved across the specimen at once, so that the number
// of iterations hardly grows with the number of spheres (additive two-level Schwarz with rigid-body modes; A. Toselli, O. Widlund, Domain
// Decomposition Methods, Springer 2005, ch. 3; coarse space by aggregation: P. Vanek, J. Mandel, M. Brezina, Computing 56 (1996) 179).
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "core/statics/bond_network.hpp"

namespace proveta {

class TwoLevel {
  public:
    /// free: 1 for each of the six components of each sphere that may move, else 0. damping: added to the diagonal of every free
    /// component, in the unit of its stiffness.
    TwoLevel(const BondNetwork& network, const Eigen::VectorXd& free, const Eigen::VectorXd& added);

    /// z = M^-1 r, zero where not free.
    template <int W> void apply(const NetworkField<W>& r, NetworkField<W>& z) const;

  private:
    using Mat6 = BondNetwork::Mat6;
    void gather_clumps();
    void assemble_coarse(const Eigen::VectorXd& added);
    [[nodiscard]] Mat6 modes(std::size_t sphere) const; // motion of the sphere by its clump's six, zero where not free

    const BondNetwork& network_;
    const Eigen::VectorXd& free_;
    std::vector<Mat6> inverse_;                         // of each sphere's own stiffness, on what is free and held by something
    std::vector<std::uint32_t> clump_;                  // of each sphere
    std::vector<Vec3> centre_;                          // of each clump
    std::vector<std::uint32_t> member_offset_, member_; // spheres of each clump
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> coarse_;
    bool has_coarse_ = false;
};

} // namespace proveta
