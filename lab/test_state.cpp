#include "lab/test_state.hpp"

#include <stdexcept>

namespace proveta {

namespace {

// Numbers of a list of equal records: laid out flat, visited, and taken back.
template <class Record, class Flatten, class Restore>
void visit_list(const std::string& name, std::vector<Record>& list, std::size_t width, const Flatten& flatten, const Restore& restore,
                StateVisitor& visit) {
    std::vector<double> flat;
    flat.reserve(width * list.size());
    for (const Record& record : list) {
        flatten(record, flat);
    }
    visit(name, flat);
    if (flat.size() % width != 0) {
        throw std::runtime_error(name + " has an unexpected length");
    }
    list.clear();
    for (std::size_t k = 0; k < flat.size(); k += width) {
        list.push_back(restore(flat.data() + k));
    }
}

} // namespace

void visit_rows(const std::string& prefix, report::Table& table, StateVisitor& visit) {
    const std::size_t width = table.columns.size();
    visit_list(
        prefix + "rows", table.rows, width,
        [](const std::vector<double>& row, std::vector<double>& flat) { flat.insert(flat.end(), row.begin(), row.end()); },
        [&](const double* at) { return std::vector<double>(at, at + width); }, visit);
}

void visit_events(const std::string& prefix, std::vector<FailureEvent>& events, StateVisitor& visit) {
    visit_list(
        prefix + "events", events, 8,
        [](const FailureEvent& e, std::vector<double>& flat) {
            flat.insert(flat.end(), {e.time, e.axial_strain, e.position.x(), e.position.y(), e.position.z(), static_cast<double>(e.mode),
                                     e.energy, e.area});
        },
        [](const double* v) {
            return FailureEvent{v[0], v[1], Vec3(v[2], v[3], v[4]), static_cast<FailureMode>(static_cast<int>(v[5])), v[6], v[7]};
        },
        visit);
}

void visit_picture(const std::string& prefix, report::Picture& p, StateVisitor& visit) {
    visit(prefix + "title", p.title);
    visit(prefix + "caption", p.caption);
    visit(prefix + "width", p.width);
    visit(prefix + "height", p.height);
    visit_list(
        prefix + "dots", p.dots, 4,
        [](const report::PictureDot& d, std::vector<double>& flat) {
            flat.insert(flat.end(), {d.x, d.z, d.radius, d.value});
        },
        [](const double* v) {
            return report::PictureDot{v[0], v[1], v[2], v[3]};
        },
        visit);
    visit_list(
        prefix + "lines", p.lines, 6,
        [](const report::PictureLine& l, std::vector<double>& flat) {
            flat.insert(flat.end(), {l.x0, l.z0, l.x1, l.z1, static_cast<double>(l.mode), l.weight});
        },
        [](const double* v) { return report::PictureLine{v[0], v[1], v[2], v[3], static_cast<int>(v[4]), v[5]}; }, visit);
    std::vector<std::int32_t> corners;
    std::vector<double> values;
    for (const auto& facet : p.facets) {
        corners.push_back(static_cast<std::int32_t>(facet.corner.size()));
        values.insert(values.end(), {facet.value, facet.light});
        for (const auto& [x, z] : facet.corner) {
            values.insert(values.end(), {x, z});
        }
    }
    visit(prefix + "facet_corners", corners);
    visit(prefix + "facets", values);
    p.facets.clear();
    std::size_t at = 0;
    for (const auto n : corners) {
        report::PictureFacet facet{{}, values.at(at), values.at(at + 1)};
        at += 2;
        for (std::int32_t k = 0; k < n; ++k, at += 2) {
            facet.corner.emplace_back(values.at(at), values.at(at + 1));
        }
        p.facets.push_back(std::move(facet));
    }
}

} // namespace proveta
