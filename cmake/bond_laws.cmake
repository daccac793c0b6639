# Writes core/laws/bond_law_list.hpp: every *_law.hpp in core/laws/bond is a law, whose struct has the file's name in capitals,
# kratos_dempack_law.hpp that of KratosDempack.
function(write_bond_law_list folder into)
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${folder} ${folder}/*_law.hpp)
  list(SORT headers)
  set(includes "")
  set(names "")
  foreach(header ${headers})
    string(APPEND includes "#include \"core/laws/bond/${header}\"\n")
    string(REGEX REPLACE "_law\\.hpp$" "" words ${header})
    string(REPLACE "_" ";" words ${words})
    set(name "")
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND name ${first}${rest})
    endforeach()
    list(APPEND names ${name})
  endforeach()
  list(JOIN names ", " names)
  file(CONFIGURE OUTPUT ${into} CONTENT
"// Written by cmake/bond_laws.cmake.
#pragma once

@includes@
namespace proveta {
template <class... Types> struct TypeList {};
using BondLaws = TypeList<@names@>;
} // namespace proveta
" @ONLY)
endfunction()
