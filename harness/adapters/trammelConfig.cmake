# Configuration for find_package(trammel) after 'cmake --install': program, data, and tests of another code.
#
#   trammel_PROGRAM   path of the program
#   trammel_ADAPTERS  folder of trammel_adapter.py, which adapters in Python import
#
#   trammel::solver   library of the solver, if Eigen is installed
#
#   trammel_add_tests(SOLVER command... [CASES name...] [LABELS label...] [PREFIX prefix] [TIMEOUT s])
#
# Adds one ctest test for each named case and each case of the catalogue with one of the labels. Each test
# runs the command ('command CASE.json RESULT.json') and grades its answer.
get_filename_component(trammel_PREFIX ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set(trammel_PROGRAM ${trammel_PREFIX}/bin/trammel)
set(trammel_DATA ${trammel_PREFIX}/share/trammel)
set(trammel_ADAPTERS ${trammel_DATA}/adapters)
if(NOT EXISTS ${trammel_PROGRAM})
  set(trammel_FOUND FALSE)
  set(trammel_NOT_FOUND_MESSAGE "${trammel_PROGRAM} does not exist")
  return()
endif()

find_package(Eigen3 3.4 QUIET NO_MODULE)
if(Eigen3_FOUND)
  include(${CMAKE_CURRENT_LIST_DIR}/trammelSolver.cmake)
endif()

function(trammel_add_tests)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PREFIX;TIMEOUT" "SOLVER;CASES;LABELS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_SOLVER OR NOT (arg_CASES OR arg_LABELS))
    message(FATAL_ERROR "trammel_add_tests: expected SOLVER command, and CASES or LABELS")
  endif()
  if(NOT arg_PREFIX)
    set(arg_PREFIX trammel)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  set(environment "TRAMMEL_HOME=${trammel_DATA}" "PYTHONPATH=${trammel_ADAPTERS}")
  if(arg_LABELS)
    list(TRANSFORM arg_LABELS PREPEND "--label-any=" OUTPUT_VARIABLE labels)
    execute_process(COMMAND ${CMAKE_COMMAND} -E env ${environment} ${trammel_PROGRAM} list ${labels} --json
      OUTPUT_VARIABLE found COMMAND_ERROR_IS_FATAL ANY)
    string(JSON count LENGTH "${found}")
    math(EXPR last "${count} - 1")
    foreach(i RANGE ${last})
      string(JSON name GET "${found}" ${i} id)
      list(APPEND arg_CASES ${name})
    endforeach()
    list(REMOVE_DUPLICATES arg_CASES)
  endif()
  list(JOIN arg_SOLVER " " command)
  foreach(name ${arg_CASES})
    add_test(NAME ${arg_PREFIX}.${name} COMMAND ${trammel_PROGRAM} grade "${command}" ${name}
      --jobs 1 --out ${CMAKE_CURRENT_BINARY_DIR}/${arg_PREFIX}/${name})
    set_tests_properties(${arg_PREFIX}.${name} PROPERTIES LABELS "${arg_PREFIX};${arg_LABELS}"
      TIMEOUT ${arg_TIMEOUT} ENVIRONMENT "${environment}")
  endforeach()
endfunction()
