// Elements of Gmsh's meshes.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "specimens/gmsh_reader.hpp"

namespace proveta::solid_files {

Kind GmshReader::kind_of(long long type) const {
    static const std::map<long long, Kind> known{{15, Kind::point},        {1, Kind::line},        {2, Kind::triangle},
                                                 {3, Kind::quadrilateral}, {4, Kind::tetrahedron}, {5, Kind::hexahedron}};
    static const std::map<long long, const char*> refused{
        {6, "a prism"},
        {7, "a pyramid"},
        {8, "a second-order line (3 nodes)"},
        {9, "a second-order triangle (6 nodes)"},
        {10, "a second-order quadrilateral (9 nodes)"},
        {11, "a second-order tetrahedron (10 nodes)"},
        {12, "a second-order hexahedron (27 nodes)"},
        {13, "a second-order prism (18 nodes)"},
        {14, "a second-order pyramid (14 nodes)"},
        {16, "a second-order quadrilateral (8 nodes)"},
        {17, "a second-order hexahedron (20 nodes)"},
        {18, "a second-order prism (15 nodes)"},
        {19, "a second-order pyramid (13 nodes)"},
        {21, "a third-order triangle (10 nodes)"},
        {26, "a third-order line (4 nodes)"},
        {29, "a third-order tetrahedron (20 nodes)"},
        {92, "a third-order hexahedron (64 nodes)"},
    };
    if (const auto found = known.find(type); found != known.end()) {
        return found->second;
    }
    const auto name = refused.find(type);
    const std::string found = name == refused.end() ? "an element of an unknown kind" : name->second;
    in_.fail(fmt::format("{} (Gmsh's type {}); bodies are made of linear tetrahedra and hexahedra, membranes of linear triangles and "
                         "quadrilaterals{}",
                         found, type,
                         type == 6 || type == 7                     ? " (in Gmsh: without Recombine, layers are of tetrahedra)"
                         : found.find("order") != std::string::npos ? " (in Gmsh: Mesh.ElementOrder = 1)"
                                                                    : ""));
}

// The element whose nodes' tags are next.
Element& GmshReader::add_element(Kind kind, long long tag, std::size_t place) {
    const std::size_t n = nodes_of(kind);
    if (!in_.are_bytes() && in_.left_in_line() != n) {
        in_.fail(
            fmt::format("{} numbers are expected for the nodes of an element of {} nodes and {} were found", n, n, in_.left_in_line()));
    }
    Element element;
    element.kind = kind;
    element.tag = tag;
    element.place = place;
    element.node.fill(no_node);
    for (std::size_t k = 0; k < n; ++k) {
        element.node[k] = index_of(blocks_ ? in_.size("a node's tag") : in_.integer("a node's tag"));
    }
    return out_.elements.emplace_back(element);
}

// Numbers of groups are negative where an entity is turned; zero means none.
void GmshReader::add_to_group(Element& element, long long physical) {
    if (physical == 0) {
        return;
    }
    element.grouped = true;
    auto& group = out_.group[{dimension_of(element.kind), physical < 0 ? -physical : physical}];
    group.insert(group.end(), element.node.begin(), element.node.begin() + static_cast<std::ptrdiff_t>(nodes_of(element.kind)));
}

// As text, each element says its type; as bytes, blocks of one type do.
void GmshReader::read_elements_2() {
    in_.need("the number of elements", 1);
    const std::size_t n = in_.count("the number of elements");
    in_.begin_bytes();
    for (std::size_t read = 0; read < n;) {
        in_.need("an element");
        if (!in_.are_bytes()) {
            const long long tag = in_.integer("an element's tag");
            const Kind kind = kind_of(in_.integer("an element's type"));
            read_element_2(tag, kind, in_.integer("the number of an element's tags"), in_.place());
            ++read;
            continue;
        }
        const Kind kind = kind_of(in_.integer("an element's type"));
        const std::size_t block = in_.count_of_integers("the number of elements in the block");
        const long long tags = in_.integer("the number of an element's tags");
        if (block == 0 || block > n - read) {
            in_.fail(fmt::format("a block of {} elements where {} are still expected", block, n - read));
        }
        for (std::size_t k = 0; k < block; ++k, ++read) {
            const std::size_t place = in_.place();
            read_element_2(in_.integer("an element's tag"), kind, tags, place);
        }
    }
    in_.end_bytes();
}

// The tags: physical group, entity, number of partitions, partitions.
void GmshReader::read_element_2(long long tag, Kind kind, long long tags, std::size_t place) {
    if (tags < 0 || tags > 100000 || (!in_.are_bytes() && static_cast<std::size_t>(tags) > in_.left_in_line())) {
        in_.fail(fmt::format("an element with {} tags", tags));
    }
    long long physical = 0;
    for (long long k = 0; k < tags; ++k) {
        const long long value = in_.integer(k == 0 ? "a physical group's number" : "an element's tag");
        physical = k == 0 ? value : physical;
        if (value != 1 && value != 0 && (k == 2 || k == 3)) { // all in partition 1: no partitions
            in_.fail(fmt::format("element {} of a mesh in partitions; save it without them (in Gmsh: Mesh.NbPartitions = 0)", tag));
        }
    }
    add_to_group(add_element(kind, tag, place), physical);
}

void GmshReader::read_elements_4() {
    in_.begin_bytes();
    in_.need("the numbers of blocks and elements, and the least and greatest tag", 4);
    const std::size_t blocks = in_.count("the number of blocks");
    const std::size_t total = in_.count("the number of elements");
    (void)in_.size("the least tag");
    (void)in_.size("the greatest tag");
    for (std::size_t b = 0; b < blocks; ++b) {
        in_.need("a block of elements: dimension, entity, type and number", 4);
        const long long dimension = in_.integer("an entity's dimension");
        const long long entity_tag = in_.integer("an entity's tag");
        const Kind kind = kind_of(in_.integer("an element's type"));
        if (dimension != dimension_of(kind)) {
            in_.fail(fmt::format("elements of dimension {} in an entity of dimension {}", dimension_of(kind), dimension));
        }
        const auto entity = physical_.find({dimension_of(kind), entity_tag});
        const std::size_t n = in_.count("the number of elements in the block");
        for (std::size_t k = 0; k < n; ++k) {
            in_.need("an element");
            const std::size_t place = in_.place();
            const long long tag = in_.size("an element's tag");
            Element& element = add_element(kind, tag, place);
            if (entity != physical_.end()) {
                for (const long long physical : entity->second) {
                    add_to_group(element, physical);
                }
            }
        }
    }
    if (out_.elements.size() != total) {
        in_.fail(fmt::format("the blocks hold {} elements where {} are expected", out_.elements.size(), total));
    }
    in_.end_bytes();
}

// An element of several groups may be there several times, but not with other nodes.
void GmshReader::check_tags() const {
    std::vector<const Element*> by_tag;
    for (const auto& element : out_.elements) {
        by_tag.push_back(&element);
    }
    std::stable_sort(by_tag.begin(), by_tag.end(), [](const Element* a, const Element* b) { return a->tag < b->tag; });
    for (std::size_t k = 1; k < by_tag.size(); ++k) {
        const Element& a = *by_tag[k - 1];
        const Element& b = *by_tag[k];
        if (a.tag == b.tag && (a.kind != b.kind || a.node != b.node)) {
            in_.fail_at(b.place, fmt::format("a second element {}, with other nodes; the first is in {}", b.tag, in_.text_of(a.place)));
        }
    }
}

} // namespace proveta::solid_files
