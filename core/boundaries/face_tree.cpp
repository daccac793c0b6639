#include "core/boundaries/face_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace proveta {

namespace {

constexpr std::uint32_t leaf_size = 4;

} // namespace

FaceTree::FaceTree(const SurfaceMesh& mesh) : order_(mesh.faces()) {
    std::vector<Eigen::AlignedBox3d> boxes(mesh.faces());
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        for (std::size_t k = 0; k < mesh.corners(f); ++k) {
            boxes[f].extend(mesh.at(f, k));
        }
    }
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty()) {
        split(boxes, 0, static_cast<std::uint32_t>(order_.size()));
    }
    boxes_.reserve(boxes.size());
    for (const auto f : order_) {
        boxes_.push_back(boxes[f]);
    }
}

void FaceTree::split(const std::vector<Eigen::AlignedBox3d>& boxes, std::uint32_t begin, std::uint32_t end) {
    Node node{{}, begin, end, 0};
    Eigen::AlignedBox3d centres;
    for (auto k = begin; k < end; ++k) {
        node.box.extend(boxes[order_[k]]);
        centres.extend(boxes[order_[k]].center());
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const auto middle = begin + (end - begin) / 2;
    const auto centre = [&](std::uint32_t f) { return boxes[f].center()[axis]; };
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t a, std::uint32_t b) { return centre(a) != centre(b) ? centre(a) < centre(b) : a < b; });
    split(boxes, begin, middle);
    nodes_[at].second = static_cast<std::uint32_t>(nodes_.size());
    split(boxes, middle, end);
}

void FaceTree::near(const Vec3& point, double reach, std::vector<std::uint32_t>& found) const {
    if (nodes_.empty()) {
        return;
    }
    const double square = reach * reach;
    const std::size_t before = found.size();
    std::array<std::uint32_t, 64> stack; // halving leaves at most 32 levels of 2^32 faces
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const Node& node = nodes_[at];
        if (node.box.squaredExteriorDistance(point) > square) {
            continue;
        }
        if (node.second != 0) {
            stack[depth++] = node.second;
            stack[depth++] = at + 1;
            continue;
        }
        for (auto k = node.begin; k < node.end; ++k) {
            if (boxes_[k].squaredExteriorDistance(point) <= square) {
                found.push_back(order_[k]);
            }
        }
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(before), found.end());
}

} // namespace proveta
