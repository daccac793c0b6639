// The reader of Gmsh's meshes, in two parts: sections and nodes (gmsh_import.cpp), and elements (gmsh_elements.cpp).
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "specimens/gmsh_records.hpp"

namespace proveta::solid_files {

// Gmsh's own library is under the GPL and this program under the BSD licence, so that it cannot be linked: its two common formats are
// read here, as text and as bytes, which hold the same numbers in the same order but for the elements of version 2.2.
class GmshReader {
  public:
    explicit GmshReader(const std::string& file) : in_(file, text_of(file)) {}

    Content read();

  private:
    struct Node {
        long long tag;
        std::uint32_t index;
        std::size_t place;
    };

    void read_section();
    void read_format();
    void read_names();
    void read_entities();
    void read_entity(int dimension);
    void read_nodes_2(bool parametric);
    void read_nodes_4();
    void read_elements_2();
    void read_element_2(long long tag, Kind kind, long long tags, std::size_t place);
    void read_elements_4();
    [[nodiscard]] Kind kind_of(long long type) const;
    void add_node(long long tag, std::size_t place);
    void sort_nodes();
    [[nodiscard]] std::uint32_t index_of(long long tag) const;
    Element& add_element(Kind kind, long long tag, std::size_t place);
    void add_to_group(Element& element, long long physical);
    void check_tags() const;

    GmshRecords in_;
    Content out_;
    bool blocks_ = false; // version 4.1: nodes and elements in blocks of one entity each
    std::vector<Node> node_;
    bool format_read_ = false;
    bool nodes_read_ = false;
    bool elements_read_ = false;
    std::map<std::pair<int, long long>, std::vector<long long>> physical_; // of entities
};

} // namespace proveta::solid_files
