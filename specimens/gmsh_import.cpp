// Meshes of Gmsh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "specimens/solid_lines.hpp"

namespace proveta::solid_files {

namespace {

// Gmsh's own library is under the GPL and this program under the BSD licence, so that it cannot be linked: its two common formats are
// read here, ASCII only.
class GmshReader {
  public:
    explicit GmshReader(const std::string& file) : in_(file, text_of(file)) {}

    Content read() {
        read_format();
        while (in_.next()) {
            read_section();
        }
        return std::move(out_);
    }

  private:
    struct Node {
        long long tag;
        std::uint32_t index;
        std::size_t line;
    };

    void read_format();
    void read_section();
    void skip(const std::string& section);
    void read_names();
    void read_entities();
    void read_entity(int dimension);
    void read_nodes_2();
    void read_nodes_4();
    void read_elements_2();
    void read_elements_4();
    [[nodiscard]] Kind kind_of(long long type) const;
    void add_node(long long tag, std::size_t line, std::size_t first);
    void sort_nodes();
    [[nodiscard]] std::uint32_t node_at(std::size_t field) const;
    Element& add_element(Kind kind, std::size_t first);
    void add_to_group(Element& element, long long physical);
    void check_tags() const;

    Lines in_;
    Content out_;
    bool blocks_ = false; // version 4.1: nodes and elements in blocks of one entity each
    std::vector<Node> node_;
    bool nodes_read_ = false;
    bool elements_read_ = false;
    std::map<std::pair<int, long long>, std::vector<long long>> physical_; // of entities
};

void GmshReader::read_format() {
    if (!in_.next() || in_[0] != "$MeshFormat") {
        in_.fail(fmt::format("$MeshFormat is expected and {} was found: this is no mesh of Gmsh's versions 2.2 or 4.1", shown(in_.line())));
    }
    in_.need("the format's version, file type and data size", 3);
    const std::string version(in_[0]);
    blocks_ = version == "4.1";
    if (!blocks_ && version != "2.2") {
        in_.fail(fmt::format("version {} of Gmsh's format; versions 2.2 and 4.1 are read", shown(version)));
    }
    if (in_.integer(1, "the file's type, 0 or 1,") != 0) {
        in_.fail("a binary file; save the mesh as ASCII (in Gmsh: Mesh.Binary = 0)");
    }
    in_.need_word("$EndMeshFormat");
}

void GmshReader::read_section() {
    const std::string section(in_[0]);
    if (section.size() < 2 || section[0] != '$' || section.starts_with("$End")) {
        in_.fail(fmt::format("the beginning of a section is expected and {} was found", shown(in_.line())));
    }
    const auto once = [&](bool& read) {
        if (read) {
            in_.fail(fmt::format("a second section {}", section));
        }
        read = true;
    };
    if (section == "$PhysicalNames") {
        read_names();
    } else if (section == "$Entities" && blocks_) {
        read_entities();
    } else if (section == "$Nodes") {
        once(nodes_read_);
        blocks_ ? read_nodes_4() : read_nodes_2();
        sort_nodes();
    } else if (section == "$Elements") {
        once(elements_read_);
        if (!nodes_read_) {
            in_.fail("$Elements before $Nodes");
        }
        blocks_ ? read_elements_4() : read_elements_2();
        check_tags();
    } else {
        if (section == "$PartitionedEntities") {
            out_.notes.emplace_back("physical groups of a mesh in partitions were left out");
        }
        skip(section);
        return;
    }
    in_.need_word("$End" + section.substr(1));
}

// Passes over a section that the mesh does not need.
void GmshReader::skip(const std::string& section) {
    const std::string end = "$End" + section.substr(1);
    do {
        in_.need(end);
    } while (in_[0] != end);
}

void GmshReader::read_names() {
    in_.need("the number of physical names", 1);
    const std::size_t n = in_.count(0, "the number of physical names");
    for (std::size_t k = 0; k < n; ++k) {
        in_.need("a physical name");
        const long long dimension = in_.integer(0, "a physical group's dimension");
        const long long number = in_.integer(1, "a physical group's number");
        const auto open = in_.line().find('"');
        const auto close = in_.line().rfind('"');
        if (dimension < 0 || dimension > 3 || open == std::string_view::npos || close == open) {
            in_.fail(fmt::format("a dimension, a number and a name in quotes are expected and {} was found", shown(in_.line())));
        }
        out_.name[{static_cast<int>(dimension), number}] = std::string(in_.line().substr(open + 1, close - open - 1));
    }
}

void GmshReader::read_entities() {
    in_.need("the numbers of points, curves, surfaces and volumes", 4);
    std::array<std::size_t, 4> n{};
    for (std::size_t d = 0; d < 4; ++d) {
        n[d] = in_.count(d, "a number of entities");
    }
    for (int d = 0; d < 4; ++d) {
        for (std::size_t k = 0; k < n[static_cast<std::size_t>(d)]; ++k) {
            in_.need("an entity");
            read_entity(d);
        }
    }
}

// A tag, a place or a box, and the physical groups; what bounds the entity is of no use here.
void GmshReader::read_entity(int dimension) {
    const std::size_t at = dimension == 0 ? 4 : 7;
    const std::size_t n = in_.count(at, "the number of an entity's physical groups");
    std::vector<long long> physical;
    for (std::size_t k = 1; k <= n; ++k) {
        physical.push_back(in_.integer(at + k, "a physical group's number"));
    }
    if (!physical_.try_emplace({dimension, in_.integer(0, "an entity's tag")}, std::move(physical)).second) {
        in_.fail(fmt::format("a second entity {} of dimension {}", in_[0], dimension));
    }
}

void GmshReader::read_nodes_2() {
    in_.need("the number of nodes", 1);
    const std::size_t n = in_.count(0, "the number of nodes");
    for (std::size_t k = 0; k < n; ++k) {
        in_.need("a node: tag x y z", 4);
        add_node(in_.integer(0, "a node's tag"), in_.number(), 1);
    }
}

void GmshReader::read_nodes_4() {
    in_.need("the numbers of blocks and nodes, and the least and greatest tag", 4);
    const std::size_t blocks = in_.count(0, "the number of blocks");
    const std::size_t total = in_.count(1, "the number of nodes");
    for (std::size_t b = 0; b < blocks; ++b) {
        in_.need("a block of nodes: dimension, entity, parametric and number", 4);
        const bool parametric = in_.integer(2, "parametric, 0 or 1,") != 0;
        const long long dimension = in_.integer(0, "an entity's dimension");
        if (dimension < 0 || dimension > 3) {
            in_.fail(fmt::format("an entity's dimension is {}", dimension));
        }
        const std::size_t n = in_.count(3, "the number of nodes in the block");
        std::vector<std::pair<long long, std::size_t>> tag;
        for (std::size_t k = 0; k < n; ++k) {
            in_.need("a node's tag", 1);
            tag.emplace_back(in_.integer(0, "a node's tag"), in_.number());
        }
        for (const auto& [t, line] : tag) {
            in_.need("a node's coordinates", parametric ? 3 + static_cast<std::size_t>(dimension) : 3);
            add_node(t, line, 0);
        }
    }
    if (out_.node.size() != total) {
        in_.fail(fmt::format("the blocks hold {} nodes where {} are expected", out_.node.size(), total));
    }
}

void GmshReader::add_node(long long tag, std::size_t line, std::size_t first) {
    if (out_.node.size() >= no_node) {
        in_.fail("too many nodes");
    }
    node_.push_back({tag, static_cast<std::uint32_t>(out_.node.size()), line});
    constexpr auto what = "a node's coordinate, a finite number,";
    out_.node.emplace_back(in_.real(first, what), in_.real(first + 1, what), in_.real(first + 2, what));
}

void GmshReader::sort_nodes() {
    std::sort(node_.begin(), node_.end(), [](const Node& a, const Node& b) { return std::tie(a.tag, a.index) < std::tie(b.tag, b.index); });
    const auto same = [](const Node& a, const Node& b) { return a.tag == b.tag; };
    const auto twice = std::adjacent_find(node_.begin(), node_.end(), same);
    if (twice != node_.end()) {
        in_.fail_at((twice + 1)->line, fmt::format("a second node {}; the first is in line {}", twice->tag, twice->line));
    }
}

std::uint32_t GmshReader::node_at(std::size_t field) const {
    const long long tag = in_.integer(field, "a node's tag");
    const auto found = std::lower_bound(node_.begin(), node_.end(), tag, [](const Node& n, long long t) { return n.tag < t; });
    if (found == node_.end() || found->tag != tag) {
        in_.fail(fmt::format("node {} is not among the nodes", tag));
    }
    return found->index;
}

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
    in_.fail(fmt::format("{} (Gmsh's type {}); bodies are made of linear tetrahedra and hexahedra, membranes of linear triangles and "
                         "quadrilaterals",
                         name == refused.end() ? "an element of an unknown kind" : name->second, type));
}

// The element of the line, whose nodes are the fields from `first` to the last.
Element& GmshReader::add_element(Kind kind, std::size_t first) {
    const std::size_t n = nodes_of(kind);
    if (in_.size() != first + n) {
        in_.fail(fmt::format("{} numbers are expected for an element of {} nodes and {} were found", first + n, n, in_.size()));
    }
    Element element;
    element.kind = kind;
    element.tag = in_.integer(0, "an element's tag");
    element.line = in_.number();
    element.node.fill(no_node);
    for (std::size_t k = 0; k < n; ++k) {
        element.node[k] = node_at(first + k);
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

void GmshReader::read_elements_2() {
    in_.need("the number of elements", 1);
    const std::size_t n = in_.count(0, "the number of elements");
    for (std::size_t k = 0; k < n; ++k) {
        in_.need("an element");
        (void)in_.integer(0, "an element's tag"); // first, for a section that ends too early
        const Kind kind = kind_of(in_.integer(1, "an element's type"));
        const long long tags = in_.integer(2, "the number of an element's tags");
        if (tags < 0 || static_cast<std::size_t>(tags) > in_.size()) {
            in_.fail(fmt::format("an element with {} tags in a line of {} numbers", tags, in_.size()));
        }
        Element& element = add_element(kind, 3 + static_cast<std::size_t>(tags));
        if (tags > 0) {
            add_to_group(element, in_.integer(3, "a physical group's number"));
        }
    }
}

void GmshReader::read_elements_4() {
    in_.need("the numbers of blocks and elements, and the least and greatest tag", 4);
    const std::size_t blocks = in_.count(0, "the number of blocks");
    const std::size_t total = in_.count(1, "the number of elements");
    for (std::size_t b = 0; b < blocks; ++b) {
        in_.need("a block of elements: dimension, entity, type and number", 4);
        const Kind kind = kind_of(in_.integer(2, "an element's type"));
        if (in_.integer(0, "an entity's dimension") != dimension_of(kind)) {
            in_.fail(fmt::format("elements of dimension {} in an entity of dimension {}", dimension_of(kind), in_[0]));
        }
        const auto entity = physical_.find({dimension_of(kind), in_.integer(1, "an entity's tag")});
        const std::size_t n = in_.count(3, "the number of elements in the block");
        for (std::size_t k = 0; k < n; ++k) {
            in_.need("an element");
            Element& element = add_element(kind, 1);
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
            in_.fail_at(b.line, fmt::format("a second element {}, with other nodes; the first is in line {}", b.tag, a.line));
        }
    }
}
} // namespace

Content read_gmsh(const std::string& file) { return GmshReader(file).read(); }

} // namespace proveta::solid_files
