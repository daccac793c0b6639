# Writes INTO, a source that knows what computes, and leaves it alone where nothing changed:
#     the physics revision: a hash of all sources of FROM that can change a number, and of BUILT_BY, compiler and flags;
#     the revision of git, for people.
# GIT: the program git, or what is none.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE sources RELATIVE ${FROM} ${FROM}/core/*.cpp ${FROM}/core/*.hpp ${FROM}/materials/*.cpp ${FROM}/materials/*.hpp
     ${FROM}/materials/cards/*.json ${FROM}/specimens/*.cpp ${FROM}/specimens/*.hpp ${FROM}/lab/*.cpp ${FROM}/lab/*.hpp)
# Of lab all counts but the command line, campaigns, cases of verification, and what only writes, draws or reads results.
list(FILTER sources EXCLUDE REGEX "^lab/(cli|calibrate|series|study|sweep|trials|verification)/")
list(FILTER sources EXCLUDE REGEX "^lab/.*_(report|plots|pictures)\\.[ch]pp$")
list(FILTER sources EXCLUDE REGEX "^lab/(benchmark|citation|clock|compare|exit_codes|fields|keeper|output_folder)\\.[ch]pp$")
list(FILTER sources EXCLUDE REGEX "^lab/(progress|provenance|revision|run|snapshot|summary|test_tables)\\.[ch]pp$")
list(FILTER sources EXCLUDE REGEX "^lab/scene/run_scene\\.[ch]pp$")
list(SORT sources)
set(all "")
foreach(source ${sources})
  file(SHA256 ${FROM}/${source} hash)
  string(APPEND all "${source} ${hash}\n")
endforeach()
string(REGEX REPLACE " +" ";" flags "${BUILT_BY}")
list(FILTER flags EXCLUDE REGEX "^-W") # warnings change no number
string(SHA256 physics "${all}${flags}")
string(SUBSTRING ${physics} 0 12 physics)

# Only FROM's own: a source archive may lie within another repository.
set(git "no git")
if(GIT AND EXISTS ${FROM}/.git)
  set(ENV{GIT_OPTIONAL_LOCKS} 0)
  execute_process(COMMAND ${GIT} describe --tags --match v* --always --dirty WORKING_DIRECTORY ${FROM}
                  OUTPUT_VARIABLE said RESULT_VARIABLE code OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(code EQUAL 0 AND said MATCHES "^[A-Za-z0-9._/+-]+$")
    set(git ${said})
  endif()
endif()

file(CONFIGURE OUTPUT ${INTO} CONTENT
"// Written at each build by cmake/write_revision.cmake.
#include \"lab/revision.hpp\"

namespace proveta {

const char* physics_revision() { return \"@physics@\"; }

const char* git_revision() { return \"@git@\"; }

} // namespace proveta
" @ONLY)
