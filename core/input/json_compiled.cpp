// The JSON value's own functions.
#include "core/input/json.hpp"

template class nlohmann::basic_json<nlohmann::ordered_map>;
