// A look at VTK's XML files before its readers, which trust the counts in them and would reach beyond their memory otherwise.
#pragma once

#include <string>

namespace proveta::vtk {

/// Throws std::runtime_error for counts in an XML file that are none, or that no file of this size could hold, even compressed, and for
/// what VTK's readers might see in another way than this look at it.
void check_xml(const std::string& file);

} // namespace proveta::vtk
