// Material cards.
#include "materials/card.hpp"

#include "tests/fuzz/scratch.hpp"
#include "tests/fuzz/targets.hpp"

namespace proveta::fuzz {

void read_card_file(std::string_view bytes) {
    const std::string file = scratch_file("card.json", bytes);
    may_refuse([&] { (void)to_material(load_card(file, "", "deck.json", "/material/card")); });
}

} // namespace proveta::fuzz
