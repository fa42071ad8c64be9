# register_suites(target label): one test of CTest for each suite of a program of GoogleTest, listed after each build.
# Suites whose names end in "Slow" have the label `slow` as well: the sanitizers leave them out.
set(NACRE_LIST_SUITES "${CMAKE_CURRENT_LIST_DIR}/list_suites.cmake")

function(register_suites target label)
  set(list "${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake")
  add_custom_command(TARGET ${target} POST_BUILD
    COMMAND "${CMAKE_COMMAND}" -D "PROGRAM=$<TARGET_FILE:${target}>" -D "LABEL=${label}" -D "LIST=${list}" -P "${NACRE_LIST_SUITES}"
    BYPRODUCTS "${list}"
    VERBATIM)
  # CTest reads this file, also where the program has not been built.
  set(include "${CMAKE_CURRENT_BINARY_DIR}/${target}_include.cmake")
  file(WRITE "${include}" "if(EXISTS \"${list}\")\n  include(\"${list}\")\nelse()\n  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\n  set_tests_properties(${target}_NOT_BUILT PROPERTIES LABELS ${label})\nendif()\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${include}")
endfunction()
