#include "core/solids/solid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/solids/elements.hpp"

namespace proveta {

namespace {

constexpr std::size_t elements_per_block = 64; // whatever the number of threads: it fixes the order of the sums
constexpr std::size_t nodes_per_block = 256;

std::size_t blocks(std::size_t items, std::size_t per_block) { return (items + per_block - 1) / per_block; }

template <std::size_t N> Nodal<static_cast<int>(N)> corners(const std::vector<Vec3>& of, const std::array<std::uint32_t, N>& nodes) {
    Nodal<static_cast<int>(N)> out;
    for (std::size_t a = 0; a < N; ++a) {
        out.col(static_cast<Eigen::Index>(a)) = of[nodes[a]];
    }
    return out;
}

} // namespace

Solid::Solid(std::string called, SolidMesh mesh, const SolidMaterial& of, double sheet_thickness)
    : name(std::move(called)), material(of), thickness(sheet_thickness), mesh_(std::move(mesh)) {
    const auto problems = problems_of(mesh_);
    if (!problems.empty()) {
        throw std::invalid_argument(problems.front());
    }
    if (!mesh_.membranes.empty() && !(thickness > 0.0)) {
        throw std::invalid_argument("membranes without a thickness");
    }
    position = mesh_.node;
    velocity.assign(nodes(), Vec3::Zero());
    contact.assign(nodes(), Vec3::Zero());
    pressing_.assign(nodes(), Vec3::Zero());
    set_up_points();
    set_up_gather();
}

void Solid::set_up_points() {
    for (const auto& e : mesh_.tetrahedra) {
        tetrahedra_.push_back(tetrahedron_point(corners(mesh_.node, e)));
        corner_mass_.insert(corner_mass_.end(), 4, 0.25 * material.density * tetrahedra_.back().weight);
    }
    for (const auto& e : mesh_.hexahedra) {
        const auto x = corners(mesh_.node, e);
        hexahedra_.push_back(hexahedron_points(x));
        // Row sums of the consistent matrix: the shape functions' own integrals, at the points where they are known.
        const double at = 1.0 / std::sqrt(3.0);
        for (int a = 0; a < 8; ++a) {
            double mass = 0.0;
            for (int q = 0; q < 8; ++q) {
                // Points stand in the order of the corners: each direction in which they agree counts 1 + 1/sqrt(3), else 1 - 1/sqrt(3).
                constexpr int bits[8] = {0, 1, 3, 2, 4, 5, 7, 6};
                const int differ = bits[a] ^ bits[q];
                double shape = 0.125;
                for (int c = 0; c < 3; ++c) {
                    shape *= (differ >> c & 1) != 0 ? 1.0 - at : 1.0 + at;
                }
                mass += shape * hexahedra_.back()[static_cast<std::size_t>(q)].weight;
            }
            corner_mass_.push_back(material.density * mass);
        }
        for (const auto& p : hexahedra_.back()) {
            if (!(p.weight > 0.0)) {
                throw std::invalid_argument("a hexahedron is so distorted that it folds over itself");
            }
        }
    }
    for (const auto& e : mesh_.membranes) {
        membranes_.push_back(membrane_point(corners(mesh_.node, e), thickness));
        corner_mass_.insert(corner_mass_.end(), 3, material.density * membranes_.back().weight / 3.0);
    }
    if (material.law == SolidLaw::j2) {
        plastic_states_.resize(tetrahedra_.size() + 8 * hexahedra_.size() + membranes_.size());
    }
    across_.assign(membranes_.size(), 1.0);
    stress_.assign(mesh_.elements(), 0.0);
    elastic_.assign(corner_mass_.size(), Vec3::Zero());
    damping_.assign(corner_mass_.size(), Vec3::Zero());
    for (std::size_t e = 0; e < mesh_.elements(); ++e) {
        frequency_.push_back(reference_frequency(e));
        frequency_bound_.push_back(bound(e, false));
    }
}

void Solid::set_up_gather() {
    offset_.assign(nodes() + 1, 0);
    each_corner_list([&](const std::uint32_t* node, std::size_t n) {
        for (std::size_t a = 0; a < n; ++a) {
            ++offset_[node[a] + 1];
        }
    });
    for (std::size_t k = 0; k < nodes(); ++k) {
        offset_[k + 1] += offset_[k];
    }
    from_.resize(corner_mass_.size());
    auto next = offset_;
    std::uint32_t corner = 0;
    each_corner_list([&](const std::uint32_t* node, std::size_t n) {
        for (std::size_t a = 0; a < n; ++a) {
            from_[next[node[a]]++] = corner++;
        }
    });
    mass_.assign(nodes(), 0.0);
    for (std::size_t k = 0; k < nodes(); ++k) {
        for (auto e = offset_[k]; e < offset_[k + 1]; ++e) {
            mass_[k] += corner_mass_[from_[e]];
        }
    }
}

template <int N, class Points>
void Solid::solid_element(const std::array<std::uint32_t, static_cast<std::size_t>(N)>& nodes, const Points& points, std::size_t corner,
                          std::size_t state, std::size_t element, PointSums& sums) {
    const Nodal<N> x = corners(position, nodes);
    const Nodal<N> v = corners(velocity, nodes);
    Nodal<N> elastic = Nodal<N>::Zero();
    Nodal<N> damping = Nodal<N>::Zero();
    stress_[element] = 0.0;
    for (std::size_t q = 0; q < points.size(); ++q) {
        PlasticState* plastic = plastic_states_.empty() ? nullptr : &plastic_states_[state + q];
        const PointSums of = add_point<N>(material, points[q], x, v, plastic, elastic, damping);
        sums.stored += of.stored;
        sums.plastic += of.plastic;
        stress_[element] = std::max(stress_[element], of.stress);
    }
    for (std::size_t a = 0; a < N; ++a) {
        elastic_[corner + a] = elastic.col(static_cast<Eigen::Index>(a));
        damping_[corner + a] = damping.col(static_cast<Eigen::Index>(a));
    }
}

void Solid::element_block(std::size_t block) {
    PointSums& sums = block_sums_[block];
    sums = {};
    const std::size_t nt = tetrahedra_.size();
    const std::size_t nh = hexahedra_.size();
    const std::size_t end = std::min(mesh_.elements(), (block + 1) * elements_per_block);
    for (std::size_t e = block * elements_per_block; e < end; ++e) {
        if (e < nt) {
            solid_element<4>(mesh_.tetrahedra[e], std::array{tetrahedra_[e]}, 4 * e, e, e, sums);
        } else if (e < nt + nh) {
            const std::size_t h = e - nt;
            solid_element<8>(mesh_.hexahedra[h], hexahedra_[h], 4 * nt + 8 * h, nt + 8 * h, e, sums);
        } else {
            const std::size_t s = e - nt - nh;
            const std::size_t corner = 4 * nt + 8 * nh + 3 * s;
            Nodal<3> elastic = Nodal<3>::Zero();
            Nodal<3> damping = Nodal<3>::Zero();
            PlasticState* plastic = plastic_states_.empty() ? nullptr : &plastic_states_[nt + 8 * nh + s];
            const PointSums of = add_membrane(material, membranes_[s], corners(position, mesh_.membranes[s]),
                                              corners(velocity, mesh_.membranes[s]), plastic, across_[s], elastic, damping);
            sums.stored += of.stored;
            sums.plastic += of.plastic;
            stress_[e] = of.stress;
            for (std::size_t a = 0; a < 3; ++a) {
                elastic_[corner + a] = elastic.col(static_cast<Eigen::Index>(a));
                damping_[corner + a] = damping.col(static_cast<Eigen::Index>(a));
            }
        }
    }
}

void Solid::forces(Team& team) {
    block_sums_.resize(blocks(mesh_.elements(), elements_per_block));
    team.run(block_sums_.size(), [&](std::size_t block) { element_block(block); });
    stored_ = 0.0;
    for (const auto& sums : block_sums_) {
        stored_ += sums.stored;
        plastic_ += sums.plastic;
    }
}

// A uniform pressure on a plane triangle is a third of its force at each corner.
void Solid::press(std::vector<Vec3>& out) const {
    for (const auto& pressure : pressures) {
        if (pressure.value == 0.0) {
            continue;
        }
        for (const auto& f : pressure.facet) {
            const Vec3 area = 0.5 * (position[f[1]] - position[f[0]]).cross(position[f[2]] - position[f[0]]);
            const Vec3 force = -pressure.value * pressure.share / 3.0 * area;
            for (const auto k : f) {
                out[k] += force;
            }
        }
    }
}

// Edges and corners of a body are often held by one hold along one axis and by another along the next.
void Solid::set_up_holds() {
    if (!hold_of_.empty()) {
        return;
    }
    hold_of_.assign(nodes(), {-1, -1, -1});
    for (std::size_t h = 0; h < holds.size(); ++h) {
        for (const auto k : holds[h].node) {
            for (std::size_t c = 0; c < 3; ++c) {
                hold_of_[k][c] = holds[h].axes[c] ? static_cast<std::int32_t>(h) : hold_of_[k][c];
            }
        }
    }
}

SolidSums Solid::move(Team& team, double dt, bool first, const Vec3& gravity, const std::vector<Vec3>& platens, double kick_time) {
    set_up_holds();
    press(pressing_);
    const double kick = first ? 0.5 * dt : kick_time > 0.0 ? kick_time : dt;
    std::vector<Vec3> given;
    for (const auto& hold : holds) {
        given.push_back(hold.platen >= 0 ? platens[static_cast<std::size_t>(hold.platen)] : hold.velocity);
    }
    std::vector<Vec3> reaction(nodes(), Vec3::Zero());
    node_sums_.assign(blocks(nodes(), nodes_per_block), {});
    team.run(node_sums_.size(), [&](std::size_t block) {
        SolidSums& sums = node_sums_[block];
        for (std::size_t k = block * nodes_per_block; k < std::min(nodes(), (block + 1) * nodes_per_block); ++k) {
            Vec3 elastic = Vec3::Zero();
            Vec3 damping = -material.mass_damping * mass_[k] * velocity[k];
            for (auto e = offset_[k]; e < offset_[k + 1]; ++e) {
                elastic += elastic_[from_[e]];
                damping += damping_[from_[e]];
            }
            const Vec3 weight = mass_[k] * gravity;
            const Vec3 force = elastic + damping + contact[k] + pressing_[k] + weight;
            const Vec3 before = velocity[k];
            Vec3 after = before + kick / mass_[k] * force;
            const auto& by = hold_of_[k];
            if (by[0] >= 0 || by[1] >= 0 || by[2] >= 0) {
                for (int c = 0; c < 3; ++c) {
                    const auto h = by[static_cast<std::size_t>(c)];
                    after[c] = h >= 0 ? given[static_cast<std::size_t>(h)][c] : after[c];
                }
                const Vec3 holding = mass_[k] / kick * (after - before) - force;
                sums.held += kick * holding.dot(0.5 * (before + after));
                reaction[k] = -holding;
            }
            // At the time of the forces the velocity is the mean of those on both sides of it.
            const Vec3 mean = 0.5 * (before + after);
            sums.rayleigh -= kick * damping.dot(mean);
            sums.pressure += kick * pressing_[k].dot(mean);
            sums.body += kick * weight.dot(mean);
            sums.kinetic += 0.5 * mass_[k] * (first ? before : mean).squaredNorm();
            velocity[k] = after;
            position[k] += dt * after;
            const double speed = after.norm();
            sums.fastest = std::isfinite(speed) ? std::max(sums.fastest, speed) : speed;
            contact[k].setZero();
            pressing_[k].setZero();
        }
    });
    for (std::size_t h = 0; h < holds.size(); ++h) {
        NodeHold& hold = holds[h];
        hold.reaction.setZero();
        for (const auto k : hold.node) {
            for (int c = 0; c < 3; ++c) {
                const bool its = hold_of_[k][static_cast<std::size_t>(c)] == static_cast<std::int32_t>(h);
                hold.reaction[c] += its ? reaction[k][c] : 0.0;
            }
        }
    }
    SolidSums sum;
    for (const auto& part : node_sums_) {
        sum.kinetic += part.kinetic;
        sum.rayleigh += part.rayleigh;
        sum.held += part.held;
        sum.pressure += part.pressure;
        sum.body += part.body;
        sum.fastest = std::isfinite(part.fastest) ? std::max(sum.fastest, part.fastest) : part.fastest;
        if (!std::isfinite(sum.fastest)) {
            break;
        }
    }
    return sum;
}

std::vector<Vec3> Solid::element_forces() const {
    std::vector<Vec3> out(nodes(), Vec3::Zero());
    for (std::size_t k = 0; k < nodes(); ++k) {
        for (auto e = offset_[k]; e < offset_[k + 1]; ++e) {
            out[k] += elastic_[from_[e]] + damping_[from_[e]];
        }
    }
    return out;
}

Vec3 Solid::momentum() const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < nodes(); ++k) {
        sum += mass_[k] * velocity[k];
    }
    return sum;
}

std::vector<double> Solid::plastic_strain() const {
    std::vector<double> out;
    if (plastic_states_.empty()) {
        return out;
    }
    std::size_t state = 0;
    for (std::size_t e = 0; e < mesh_.elements(); ++e) {
        const bool hexahedron = e >= tetrahedra_.size() && e < tetrahedra_.size() + hexahedra_.size();
        out.push_back(0.0);
        for (int q = 0; q < (hexahedron ? 8 : 1); ++q) {
            out.back() = std::max(out.back(), plastic_states_[state++].strain);
        }
    }
    return out;
}

// sigma = sum over nodes of -f_a x_a / V: exact for constant stress, the mean otherwise.
std::vector<Mat3> Solid::stresses() const {
    std::vector<Mat3> out;
    std::size_t corner = 0;
    std::size_t element = 0;
    each_corner_list([&](const std::uint32_t* node, std::size_t n) {
        Mat3 sum = Mat3::Zero();
        for (std::size_t a = 0; a < n; ++a) {
            sum -= elastic_[corner++] * position[node[a]].transpose();
        }
        double volume = 0.0;
        if (n == 3) {
            const std::size_t s = element - tetrahedra_.size() - hexahedra_.size();
            const Vec3 area = (position[node[1]] - position[node[0]]).cross(position[node[2]] - position[node[0]]);
            volume = 0.5 * area.norm() * thickness * across_[s];
        } else if (n == 4) {
            volume = tetrahedron_point(corners(position, mesh_.tetrahedra[element])).weight;
        } else {
            for (const auto& p : hexahedron_points(corners(position, mesh_.hexahedra[element - tetrahedra_.size()]))) {
                volume += p.weight;
            }
        }
        sum /= volume;
        out.emplace_back(0.5 * (sum + sum.transpose()));
        ++element;
    });
    return out;
}

} // namespace proveta
