// Meshes of Gmsh: sections, groups and nodes.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "specimens/gmsh_reader.hpp"

namespace proveta::solid_files {

using input::shown;

Content GmshReader::read() {
    while (in_.next()) {
        read_section();
    }
    if (!format_read_) {
        in_.fail("$MeshFormat is expected and the file ends: this is no mesh of Gmsh's versions 2.2 or 4.1");
    }
    return std::move(out_);
}

void GmshReader::read_section() {
    const std::string section(in_.word());
    if (section == "$NOD") {
        in_.fail(fmt::format("version 1.0 of Gmsh's format, which begins with {}; versions 2.2 and 4.1 are read (in Gmsh: "
                             "Mesh.MshFileVersion = 4.1)",
                             shown(section)));
    }
    if (section.size() < 2 || section[0] != '$' || section.starts_with("$End")) {
        in_.fail(format_read_ ? fmt::format("the beginning of a section is expected and {} was found", shown(in_.line()))
                              : fmt::format("$MeshFormat is expected and {} was found: this is no mesh of Gmsh's versions 2.2 or 4.1",
                                            shown(in_.line())));
    }
    const auto once = [&](bool& read) {
        if (read) {
            in_.fail(fmt::format("a second section {}", section));
        }
        read = true;
    };
    const bool nodes = section == "$Nodes" || section == "$ParametricNodes";
    if ((nodes || section == "$Elements") && !format_read_) {
        in_.fail(fmt::format("{} before $MeshFormat", section));
    }
    if (section == "$MeshFormat") {
        once(format_read_);
        read_format();
    } else if (section == "$PhysicalNames") {
        read_names();
    } else if (section == "$Entities" && blocks_) {
        read_entities();
    } else if (section == "$PartitionedEntities") {
        in_.fail("a mesh in partitions ($PartitionedEntities); save it without them (in Gmsh: Mesh.NbPartitions = 0)");
    } else if (nodes) {
        once(nodes_read_);
        blocks_ ? read_nodes_4() : read_nodes_2(section == "$ParametricNodes");
        sort_nodes();
    } else if (section == "$Elements") {
        once(elements_read_);
        if (!nodes_read_) {
            in_.fail("$Elements before $Nodes");
        }
        blocks_ ? read_elements_4() : read_elements_2();
        check_tags();
    } else { // comments, results and whatever else the mesh does not need
        in_.pass_over("$End" + section.substr(1));
        return;
    }
    in_.need_word("$End" + section.substr(1));
}

void GmshReader::read_format() {
    in_.need("the format's version, file type and data size", 3);
    const std::string version(in_.word());
    blocks_ = version == "4.1";
    if (!blocks_ && version != "2.2") {
        in_.fail(
            fmt::format("version {} of Gmsh's format; versions 2.2 and 4.1 are read (in Gmsh: Mesh.MshFileVersion = 4.1)", shown(version)));
    }
    (void)in_.real("a version");
    const long long type = in_.integer("the file's type, 0 or 1,");
    const long long size = in_.integer("the data size");
    if (type != 0 && type != 1) {
        in_.fail(fmt::format("the file's type is {}, where 0 (ASCII) or 1 (binary) is expected", type));
    }
    if (type == 0) {
        return;
    }
    if (size != 8 && (!blocks_ || size != 4)) {
        in_.fail(fmt::format("the data size is {}, where 8 is expected", size));
    }
    in_.set_binary(static_cast<std::size_t>(size), false);
    in_.begin_bytes();
    if (const long long one = in_.integer("the number 1"); one == 1LL << 24U) { // as a machine of the other order writes it
        in_.set_binary(static_cast<std::size_t>(size), true);
    } else if (one != 1) {
        in_.fail(fmt::format("the number 1 in four bytes is expected, which tells the order of bytes, and {} was found", one));
    }
    in_.end_bytes();
}

void GmshReader::read_names() {
    in_.need("the number of physical names", 1);
    const std::size_t n = in_.count("the number of physical names");
    for (std::size_t k = 0; k < n; ++k) {
        in_.need("a physical name");
        const long long dimension = in_.integer("a physical group's dimension");
        const long long number = in_.integer("a physical group's number");
        const auto open = in_.line().find('"');
        const auto close = in_.line().rfind('"');
        if (dimension < 0 || dimension > 3 || open == std::string_view::npos || close == open) {
            in_.fail(fmt::format("a dimension, a number and a name in quotes are expected and {} was found", shown(in_.line())));
        }
        out_.name[{static_cast<int>(dimension), number}] = std::string(in_.line().substr(open + 1, close - open - 1));
    }
}

void GmshReader::read_entities() {
    in_.begin_bytes();
    in_.need("the numbers of points, curves, surfaces and volumes", 4);
    std::array<std::size_t, 4> n{};
    for (auto& entities : n) {
        entities = in_.count("a number of entities");
    }
    for (int d = 0; d < 4; ++d) {
        for (std::size_t k = 0; k < n[static_cast<std::size_t>(d)]; ++k) {
            in_.need("an entity");
            read_entity(d);
        }
    }
    in_.end_bytes();
}

// A tag, a place or a box, the physical groups, and what bounds the entity, which is of no use here.
void GmshReader::read_entity(int dimension) {
    const long long tag = in_.integer("an entity's tag");
    for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) {
        (void)in_.real("a coordinate of an entity");
    }
    const std::size_t n = in_.count("the number of an entity's physical groups");
    std::vector<long long> physical;
    for (std::size_t k = 0; k < n; ++k) {
        physical.push_back(in_.integer("a physical group's number"));
    }
    if (!physical_.try_emplace({dimension, tag}, std::move(physical)).second) {
        in_.fail(fmt::format("a second entity {} of dimension {}", tag, dimension));
    }
    if (in_.are_bytes() && dimension > 0) {
        for (std::size_t left = in_.count("the number of what bounds an entity"); left > 0; --left) {
            (void)in_.integer("the tag of what bounds an entity");
        }
    }
}

void GmshReader::read_nodes_2(bool parametric) {
    in_.need("the number of nodes", 1);
    const std::size_t n = in_.count("the number of nodes");
    in_.begin_bytes();
    for (std::size_t k = 0; k < n; ++k) {
        in_.need("a node: tag x y z", parametric ? 0 : 4);
        const std::size_t place = in_.place();
        add_node(in_.integer("a node's tag"), place);
        if (parametric && (in_.are_bytes() || in_.left_in_line() > 0)) { // dimension, entity and place on a curve or a surface
            const long long dimension = in_.integer("an entity's dimension");
            (void)in_.integer("an entity's tag");
            for (long long c = 0; c < dimension && dimension < 3; ++c) {
                (void)in_.real("a parametric coordinate");
            }
        }
        if (!in_.are_bytes() && in_.left_in_line() > 0) {
            in_.fail(fmt::format("a node of {} numbers too many", in_.left_in_line()));
        }
    }
    in_.end_bytes();
}

void GmshReader::read_nodes_4() {
    in_.begin_bytes();
    in_.need("the numbers of blocks and nodes, and the least and greatest tag", 4);
    const std::size_t blocks = in_.count("the number of blocks");
    const std::size_t total = in_.count("the number of nodes");
    (void)in_.size("the least tag");
    (void)in_.size("the greatest tag");
    for (std::size_t b = 0; b < blocks; ++b) {
        in_.need("a block of nodes: dimension, entity, parametric and number", 4);
        const long long dimension = in_.integer("an entity's dimension");
        if (dimension < 0 || dimension > 3) {
            in_.fail(fmt::format("an entity's dimension is {}", dimension));
        }
        (void)in_.integer("an entity's tag");
        const bool parametric = in_.integer("parametric, 0 or 1,") != 0;
        const std::size_t n = in_.count("the number of nodes in the block");
        std::vector<std::pair<long long, std::size_t>> tags;
        for (std::size_t k = 0; k < n; ++k) {
            in_.need("a node's tag", 1);
            const std::size_t place = in_.place();
            tags.emplace_back(in_.size("a node's tag"), place);
        }
        for (const auto& [tag, place] : tags) {
            in_.need("a node's coordinates", parametric ? 0 : 3);
            add_node(tag, place);
            if (parametric) { // Gmsh writes none in volumes, whatever its manual says
                const std::size_t more = in_.are_bytes() ? static_cast<std::size_t>(dimension % 3) : in_.left_in_line();
                for (std::size_t k = 0; k < more; ++k) {
                    (void)in_.real("a parametric coordinate");
                }
            }
        }
    }
    if (out_.node.size() != total) {
        in_.fail(fmt::format("the blocks hold {} nodes where {} are expected", out_.node.size(), total));
    }
    in_.end_bytes();
}

void GmshReader::add_node(long long tag, std::size_t place) {
    if (out_.node.size() >= no_node) {
        in_.fail("too many nodes");
    }
    node_.push_back({tag, static_cast<std::uint32_t>(out_.node.size()), place});
    constexpr auto what = "a node's coordinate, a finite number,";
    const double x = in_.real(what);
    const double y = in_.real(what);
    out_.node.emplace_back(x, y, in_.real(what));
}

void GmshReader::sort_nodes() {
    std::sort(node_.begin(), node_.end(), [](const Node& a, const Node& b) { return std::tie(a.tag, a.index) < std::tie(b.tag, b.index); });
    const auto same = [](const Node& a, const Node& b) { return a.tag == b.tag; };
    const auto twice = std::adjacent_find(node_.begin(), node_.end(), same);
    if (twice != node_.end()) {
        in_.fail_at((twice + 1)->place, fmt::format("a second node {}; the first is in {}", twice->tag, in_.text_of(twice->place)));
    }
}

std::uint32_t GmshReader::index_of(long long tag) const {
    const auto found = std::lower_bound(node_.begin(), node_.end(), tag, [](const Node& n, long long t) { return n.tag < t; });
    if (found == node_.end() || found->tag != tag) {
        in_.fail(fmt::format("node {} is not among the nodes", tag));
    }
    return found->index;
}

Content read_gmsh(const std::string& file) { return GmshReader(file).read(); }

} // namespace proveta::solid_files
