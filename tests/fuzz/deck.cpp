// Decks and what is written of decks.
#include "lab/calibrate/input.hpp"
#include "lab/scene/scene.hpp"
#include "lab/series/plan.hpp"
#include "lab/sweep/sweep.hpp"
#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_deck_file(std::string_view bytes) {
    const std::string file = scratch_file("deck.json", bytes);
    const auto has = [&](std::string_view key) { return bytes.find(key) != std::string_view::npos; };
    may_refuse([&] {
        if (has("\"scene\"")) {
            (void)resolved(read_scene(file, {}));
        } else if (has("\"targets\"")) {
            (void)read_calibration(file);
        } else if (has("\"parameters\"")) {
            (void)resolved(read_sweep(file));
        } else {
            (void)read_plan({file}, {});
        }
    });
}

} // namespace proveta::fuzz
