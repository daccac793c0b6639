# Looks up at each build what computes: the physics revision and that of git (cmake/write_revision.cmake). They are in one small source,
# which changes, and is compiled again, only where they did.
function(add_revision library)
  find_package(Git QUIET)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  set(built_by "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} Eigen ${Eigen3_VERSION}")
  string(APPEND built_by " ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}}")
  foreach(target kernels_baseline kernels_avx2 kernels_avx512) # each with what all are compiled with
    if(TARGET ${target})
      string(APPEND built_by " ${target} $<JOIN:$<TARGET_PROPERTY:${target},COMPILE_OPTIONS>, >")
    endif()
  endforeach()
  set(source ${PROJECT_BINARY_DIR}/generated/lab/revision.cpp)
  add_custom_target(${library}_look_up
    COMMAND ${CMAKE_COMMAND} -D "FROM=${PROJECT_SOURCE_DIR}" -D "INTO=${source}" -D "BUILT_BY=${built_by}" -D "GIT=${GIT_EXECUTABLE}"
            -P ${PROJECT_SOURCE_DIR}/cmake/write_revision.cmake
    BYPRODUCTS ${source}
    COMMENT "Looking up the revision"
    VERBATIM)
  add_library(${library} STATIC ${source})
  add_dependencies(${library} ${library}_look_up)
  target_include_directories(${library} PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${library} PRIVATE proveta_options)
endfunction()
