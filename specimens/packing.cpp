#include "specimens/packing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/contacts/cell_grid.hpp"
#include "core/contacts/incidence.hpp"
#include "core/geometry/hilbert.hpp"
#include "specimens/random.hpp"

namespace proveta {

namespace {

// Neighbours of each sphere within reach, both ways, so that every sphere sums its own forces in a fixed order.
struct Neighbours {
    std::vector<std::uint32_t> offset;
    std::vector<std::uint32_t> other;
};

Neighbours list_neighbours(const VectorField& at, const std::vector<double>& radius, double skin) {
    const auto pairs = find_pairs(at, radius, 1.0, skin);
    std::vector<std::int32_t> first;
    std::vector<std::int32_t> second;
    for (const auto& p : pairs) {
        first.push_back(p.i);
        second.push_back(p.j);
    }
    const Incidence in = make_incidence(radius.size(), first, second);
    Neighbours out{in.offset, std::vector<std::uint32_t>(in.entry.size())};
    for (std::size_t k = 0; k < in.entry.size(); ++k) {
        const auto pair = in.entry[k] >> 1;
        out.other[k] = static_cast<std::uint32_t>((in.entry[k] & 1u) != 0 ? first[pair] : second[pair]);
    }
    return out;
}

// Sums of one block of spheres, added up in block order.
struct Sums {
    double power = 0.0;   // F . v
    double force2 = 0.0;  // |F|^2
    double speed2 = 0.0;  // |v|^2
    double net = 0.0;     // sum of |F|
    double contact = 0.0; // sum of single contact forces
    double contacts = 0.0;
    double farthest = 0.0;
    double deepest = 0.0; // overlap over the smaller radius

    void add(const Sums& o) {
        power += o.power;
        force2 += o.force2;
        speed2 += o.speed2;
        net += o.net;
        contact += o.contact;
        contacts += o.contacts;
        farthest = std::max(farthest, o.farthest);
        deepest = std::max(deepest, o.deepest);
    }
};

class Relaxer {
  public:
    Relaxer(const Shape& shape, Packing& packing)
        : shape_(shape), p_(packing), velocity_(packing.radius.size()), force_(packing.radius.size()) {
        const auto n = static_cast<double>(p_.radius.size());
        skin_ = 0.35 * std::accumulate(p_.radius.begin(), p_.radius.end(), 0.0) / n;
    }

    // Forces at the present positions.
    Sums forces() {
        if (2.0 * travel_ >= skin_) {
            near_ = list_neighbours(p_.centre, p_.radius, skin_);
            travel_ = 0.0;
        }
        return over_blocks([&](std::size_t k, Sums& sums) { force_on(k, sums); });
    }

    // Unit mass: velocity keep v + turn F + dt F, then a move that the walls cut short.
    void move(double dt, double keep, double turn) {
        const Sums sums = over_blocks([&](std::size_t k, Sums& out) {
            const Vec3 v = keep * velocity_.at(k) + (turn + dt) * force_.at(k);
            const Vec3 before = p_.centre.at(k);
            const Vec3 after = shape_.keep_inside(before + v * dt, p_.radius[k]);
            velocity_.set(k, (after - before) / dt);
            p_.centre.set(k, after);
            out.farthest = std::max(out.farthest, (after - before).squaredNorm());
        });
        travel_ += std::sqrt(sums.farthest);
    }

  private:
    static constexpr std::size_t block = 256;
    // The spring stiffens where an overlap nears this share of the smaller radius, so that small spheres are not swallowed.
    static constexpr double deep = 0.35;
    static constexpr double stiffest = 4.0;

    // Calls one(k, sums) for every sphere; sums are formed block by block, so threads do not matter.
    template <class One> Sums over_blocks(One&& one) {
        const std::size_t n = p_.radius.size();
        std::vector<Sums> parts((n + block - 1) / block);
#pragma omp parallel for schedule(static)
        for (std::size_t part = 0; part < parts.size(); ++part) {
            for (std::size_t k = part * block; k < std::min(n, (part + 1) * block); ++k) {
                one(k, parts[part]);
            }
        }
        Sums total;
        for (const auto& part : parts) {
            total.add(part);
        }
        return total;
    }

    void force_on(std::size_t i, Sums& sums) {
        Vec3 f = Vec3::Zero();
        const Vec3 at = p_.centre.at(i);
        const double r = p_.radius[i];
        for (auto k = near_.offset[i]; k < near_.offset[i + 1]; ++k) {
            const auto j = near_.other[k];
            const Vec3 from = at - p_.centre.at(j);
            const double reach = r + p_.radius[j];
            const double d2 = from.squaredNorm();
            if (d2 < reach * reach) {
                const double d = std::max(std::sqrt(d2), 1e-12 * reach);
                const double overlap = reach - d;
                const double depth = overlap / (deep * std::min(r, p_.radius[j]));
                const double push = overlap * (1.0 + std::min(depth * depth * depth * depth, stiffest));
                f += from * (push / d);
                sums.contact += push;
                sums.contacts += 1.0;
                sums.deepest = std::max(sums.deepest, deep * depth);
            }
        }
        // The walls carry what pushes against them.
        const Vec3 wished = at + f;
        const Vec3 allowed = shape_.keep_inside(wished, r) - at;
        const bool held = (allowed - f).squaredNorm() > 0.0 && shape_.depth_below_surface(at) <= r * (1.0 + 1e-9);
        const Vec3 net = held ? allowed : f;
        force_.set(i, f);
        const Vec3 v = velocity_.at(i);
        sums.power += f.dot(v);
        sums.force2 += f.squaredNorm();
        sums.speed2 += v.squaredNorm();
        sums.net += net.norm();
    }

    const Shape& shape_;
    Packing& p_;
    VectorField velocity_;
    VectorField force_;
    Neighbours near_;
    double skin_ = 0.0;
    double travel_ = 1e300;
};

} // namespace

Packing pack(const Shape& shape, const std::vector<double>& radii, std::uint64_t seed, double tolerance, Relaxation& report,
             const std::function<void(double)>& progress, double enough) {
    Random random(seed, Stream::positions);
    Packing p;
    const double x = shape.kind == ShapeKind::cylinder ? shape.diameter : shape.width;
    const double y = shape.kind == ShapeKind::cylinder ? shape.diameter : shape.depth;
    while (p.radius.size() < radii.size()) {
        const double r = radii[p.radius.size()];
        const Vec3 at((random.uniform() - 0.5) * x, (random.uniform() - 0.5) * y, random.uniform() * shape.height);
        if (shape.depth_below_side(at) > 0.0) {
            p.centre.push_back(shape.keep_inside(at, r));
            p.radius.push_back(r);
        }
    }
    // Neighbours in memory from the start, for speed.
    const auto order = hilbert_order(p.centre);
    Packing sorted;
    for (const auto k : order) {
        sorted.centre.push_back(p.centre.at(k));
        sorted.radius.push_back(p.radius[k]);
    }
    report.number.assign(order.begin(), order.end());
    p = std::move(sorted);

    Relaxer relaxer(shape, p);
    constexpr double longest = 0.25; // half the critical step of a sphere with some fifteen springs of unit stiffness
    constexpr int most = 5000;
    double dt = 0.1;
    double mix = 0.1;
    int downhill = 0;
    double first = 0.0;
    for (report.iterations = 0; report.iterations < most; ++report.iterations) {
        const Sums s = relaxer.forces();
        const double n = static_cast<double>(p.radius.size());
        report.residual = s.contact > 0.0 ? (s.net / n) / (s.contact / s.contacts) : 0.0;
        report.largest_overlap = s.deepest;
        if (report.residual <= tolerance || (enough > 0.0 && s.deepest <= enough)) {
            break;
        }
        first = std::max(first, report.residual);
        if (progress) {
            progress(std::log(first / report.residual) / std::log(first / tolerance));
        }
        if (s.power > 0.0) {
            relaxer.move(dt, 1.0 - mix, mix * std::sqrt(s.speed2 / s.force2));
            if (++downhill > 5) {
                dt = std::min(1.1 * dt, longest);
                mix *= 0.99;
            }
        } else {
            dt = report.iterations > 0 ? std::max(0.5 * dt, 0.02) : dt;
            mix = 0.1;
            downhill = 0;
            relaxer.move(dt, 0.0, 0.0);
        }
    }
    return p;
}

} // namespace proveta
