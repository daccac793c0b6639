// Style and script of a page, built into the program from the files beside this one.
#pragma once

#include <string_view>

namespace proveta::report {

extern const std::string_view page_style;
extern const std::string_view page_script;
/// SHA-256 of each in hexadecimal digits: the page allows these two and no other.
extern const std::string_view page_style_sha256;
extern const std::string_view page_script_sha256;

} // namespace proveta::report
