#include "lab/protocols/registry.hpp"

namespace proveta {

std::unique_ptr<Protocol> make_ucs();

namespace {

using Maker = std::unique_ptr<Protocol> (*)();

// One line a test.
constexpr Maker makers[] = {
    make_ucs,
};

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
