// Which program this is. The values are looked up at each build (cmake/write_revision.cmake).
#pragma once

namespace proveta {

/// Hash, 12 hexadecimal digits, of all sources that can change a number of a result, and of compiler and flags. Two programs with the same
/// one give the same results; what another one computed is never taken from a store.
const char* physics_revision();

/// For people: tag and commit of git, with "-dirty" where files differ from them; "no git" for a build from elsewhere.
const char* git_revision();

} // namespace proveta
