#include "specimens/storage.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "specimens/hdf5_file.hpp"
#include "specimens/statistics.hpp"

namespace proveta {

namespace {

constexpr const char* specimen_format = "proveta specimen 1";

// Forms one after the other, then stones.
void put_stones(const Specimen& s, Hdf5File& h) {
    std::vector<std::int32_t> count, form;
    std::vector<double> centre, radius, volume, inertia, size, position, attitude;
    for (const auto& f : s.forms) {
        count.push_back(static_cast<std::int32_t>(f.radius.size()));
        for (const Vec3& c : f.centre) {
            centre.insert(centre.end(), c.begin(), c.end());
        }
        radius.insert(radius.end(), f.radius.begin(), f.radius.end());
        volume.push_back(f.volume);
        inertia.insert(inertia.end(), f.inertia.begin(), f.inertia.end());
    }
    for (const auto& stone : s.stones) {
        form.push_back(stone.form);
        size.push_back(stone.size);
        position.insert(position.end(), stone.position.begin(), stone.position.end());
        attitude.insert(attitude.end(), {stone.attitude.w(), stone.attitude.x(), stone.attitude.y(), stone.attitude.z()});
    }
    h.put("form_spheres", count);
    h.put("stone_form", form);
    for (const auto& [name, values] : {std::pair{"form_centre", &centre},
                                       {"form_radius", &radius},
                                       {"form_volume", &volume},
                                       {"form_inertia", &inertia},
                                       {"stone_size", &size},
                                       {"stone_position", &position},
                                       {"stone_attitude", &attitude}}) {
        h.put(name, *values);
    }
}

// An array of so many numbers, all of them finite.
std::vector<double> get_numbers(const Hdf5File& h, const std::string& name, std::size_t length) {
    std::vector<double> values;
    h.get(name, values);
    if (values.size() != length) {
        throw std::runtime_error(name + ": arrays of unequal length");
    }
    if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) {
        throw std::runtime_error(name + ": not a number");
    }
    return values;
}

void require_positive(const std::vector<double>& values, const std::string& what) {
    if (!std::all_of(values.begin(), values.end(), [](double x) { return x > 0.0; })) {
        throw std::runtime_error(what + " has an impossible value");
    }
}

Vec3 vector_at(const std::vector<double>& from, std::size_t k) { return {from[3 * k], from[3 * k + 1], from[3 * k + 2]}; }

std::vector<ClusterShape> get_forms(const Hdf5File& h) {
    std::vector<std::int32_t> count;
    h.get("form_spheres", count);
    std::size_t spheres = 0;
    for (const auto n : count) {
        if (n < 1) {
            throw std::runtime_error("a form without spheres");
        }
        spheres += static_cast<std::size_t>(n);
    }
    const auto centre = get_numbers(h, "form_centre", 3 * spheres);
    const auto radius = get_numbers(h, "form_radius", spheres);
    const auto volume = get_numbers(h, "form_volume", count.size());
    const auto inertia = get_numbers(h, "form_inertia", 3 * count.size());
    require_positive(radius, "form_radius");
    require_positive(volume, "form_volume");
    require_positive(inertia, "form_inertia");
    std::vector<ClusterShape> forms(count.size());
    std::size_t next = 0;
    for (std::size_t f = 0; f < forms.size(); ++f) {
        for (std::int32_t k = 0; k < count[f]; ++k, ++next) {
            forms[f].centre.push_back(vector_at(centre, next));
            forms[f].radius.push_back(radius[next]);
        }
        forms[f].volume = volume[f];
        forms[f].inertia = vector_at(inertia, f);
    }
    return forms;
}

std::vector<Stone> get_stones(const Hdf5File& h, std::size_t forms) {
    std::vector<std::int32_t> form;
    h.get("stone_form", form);
    const std::size_t n = form.size();
    const auto size = get_numbers(h, "stone_size", n);
    const auto position = get_numbers(h, "stone_position", 3 * n);
    const auto attitude = get_numbers(h, "stone_attitude", 4 * n);
    require_positive(size, "stone_size");
    std::vector<Stone> stones(n);
    for (std::size_t k = 0; k < n; ++k) {
        const double* q = &attitude[4 * k];
        stones[k] = {form[k], size[k], vector_at(position, k), {q[0], q[1], q[2], q[3]}};
        if (form[k] < 0 || static_cast<std::size_t>(form[k]) >= forms) {
            throw std::runtime_error("stone " + std::to_string(k) + " has a form that is not there");
        }
        if (std::fabs(stones[k].attitude.norm() - 1.0) > 1e-9) {
            throw std::runtime_error("stone " + std::to_string(k) + " has an impossible attitude");
        }
    }
    return stones;
}

} // namespace

void save_specimen(const Specimen& s, const std::string& file) {
    Hdf5File h(file, Hdf5File::Mode::create);
    h.put_text("format", specimen_format);
    h.put("x", s.spheres.centre.x);
    h.put("y", s.spheres.centre.y);
    h.put("z", s.spheres.centre.z);
    h.put("radius", s.spheres.radius);
    h.put("group", std::vector<std::int32_t>(s.group.begin(), s.group.end()));
    h.put("shape", std::vector<double>{static_cast<double>(s.shape.kind), s.shape.diameter, s.shape.width, s.shape.depth, s.shape.height});
    h.put_text("recipe", s.recipe.dump());
    if (!s.stones.empty()) {
        put_stones(s, h);
    }
    const SpecimenStatistics st = statistics(s);
    h.put("mean_radius", st.mean_radius);
    h.put("relative_deviation", st.relative_deviation);
    h.put("porosity", st.porosity);
    h.put("touching", st.touching);
    h.put("largest_overlap", st.largest_overlap);
    h.put("fabric_deviator", st.fabric_deviator);
    h.close();
}

Specimen load_specimen(const std::string& file) {
    const Hdf5File h(file, Hdf5File::Mode::read);
    if (!h.has("format") || h.get_text("format") != specimen_format) {
        throw std::runtime_error("not a specimen of this program");
    }
    Specimen s;
    h.get("x", s.spheres.centre.x);
    h.get("y", s.spheres.centre.y);
    h.get("z", s.spheres.centre.z);
    h.get("radius", s.spheres.radius);
    std::vector<std::int32_t> group;
    h.get("group", group);
    s.group.assign(group.begin(), group.end());
    if (h.has("stone_form")) {
        s.forms = get_forms(h);
        s.stones = get_stones(h, s.forms.size());
    }
    std::vector<double> shape;
    h.get("shape", shape);
    const std::size_t n = s.spheres.radius.size();
    if (s.size() == 0 || s.spheres.centre.x.size() != n || s.spheres.centre.y.size() != n || s.spheres.centre.z.size() != n ||
        s.group.size() != n || shape.size() != 5) {
        throw std::runtime_error("arrays of unequal length");
    }
    if (shape[0] != 0.0 && shape[0] != 1.0 && shape[0] != 2.0) {
        throw std::runtime_error("a shape that this program does not know");
    }
    s.shape.kind = static_cast<ShapeKind>(static_cast<int>(shape[0]));
    s.shape.diameter = shape[1];
    s.shape.width = shape[2];
    s.shape.depth = shape[3];
    s.shape.height = shape[4];
    for (std::size_t k = 0; k < n; ++k) {
        if (!s.spheres.centre.at(k).allFinite() || !(s.spheres.radius[k] > 0.0) || !std::isfinite(s.spheres.radius[k])) {
            throw std::runtime_error("sphere " + std::to_string(k) + " has an impossible centre or radius");
        }
    }
    for (const double x : shape) {
        if (!std::isfinite(x) || x < 0.0) {
            throw std::runtime_error("impossible dimensions");
        }
    }
    s.recipe = input::Json::parse(h.get_text("recipe"), nullptr, false);
    return s;
}

} // namespace proveta
