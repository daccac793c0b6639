#include "lab/protocols/registry.hpp"

namespace proveta {

// One line a test: X(name), made by make_name() in a file of its own beside this one.
#define PROVETA_TESTS(X)                                                                                                                   \
    X(ucs)                                                                                                                                 \
    X(triaxial)                                                                                                                            \
    X(brazilian)                                                                                                                           \
    X(oedometric)                                                                                                                          \
    X(hydrostatic)                                                                                                                         \
    X(direct_tension)                                                                                                                      \
    X(granular_triaxial)

#define PROVETA_DECLARE(name) std::unique_ptr<Protocol> make_##name();
PROVETA_TESTS(PROVETA_DECLARE)

namespace {

using Maker = std::unique_ptr<Protocol> (*)();

#define PROVETA_LIST(name) make_##name,
constexpr Maker makers[] = {PROVETA_TESTS(PROVETA_LIST)};

} // namespace

std::unique_ptr<Protocol> make_protocol(const std::string& name) {
    for (const auto make : makers) {
        auto protocol = make();
        if (protocol->about().name == name) {
            return protocol;
        }
    }
    return nullptr;
}

std::vector<std::string> test_names() {
    std::vector<std::string> names;
    for (const auto make : makers) {
        names.push_back(make()->about().name);
    }
    return names;
}

std::vector<input::Choice> test_choices() {
    std::vector<input::Choice> out;
    for (const auto make : makers) {
        const auto info = make()->about();
        out.push_back({info.name, info.title});
    }
    return out;
}

} // namespace proveta
