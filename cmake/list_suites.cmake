# Writes to LIST an add_test() for each suite of PROGRAM, with the label LABEL.
execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
string(REPLACE ";" "," output "${output}")
string(REPLACE "\n" ";" lines "${output}")
set(tests "")

# Skipped where every case is; a suite with some cases skipped passes. Suites of many cases start first.
macro(finish_suite)
  if(suite)
    string(APPEND tests "add_test([=[${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
      "set_tests_properties([=[${suite}]=] PROPERTIES COST ${cases} LABELS [=[${labels}]=] "
      "SKIP_REGULAR_EXPRESSION [=[\\[  PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\] [^\n]*(\n\\[  SKIPPED \\] [^\n]*)*\n*$]=])\n")
  endif()
endmacro()

set(suite "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ .]+)\\.( |$)") # cases are indented
    finish_suite()
    set(suite "${CMAKE_MATCH_1}")
    set(labels "${LABEL}")
    set(cases 0)
    if(suite MATCHES "Slow$")
      string(APPEND labels ";slow")
      set(cases 100)
    endif()
  elseif(line MATCHES "^ ")
    math(EXPR cases "${cases} + 1")
  endif()
endforeach()
finish_suite()
file(WRITE "${LIST}" "${tests}")
