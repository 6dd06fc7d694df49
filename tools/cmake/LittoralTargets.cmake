# What every target of the project shares. Flags hang on one interface target, never on the directory.

add_library(littoral_options INTERFACE)
target_compile_options(
  littoral_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                             # sqrt vectorises only without errno; NaN checks stay alive: no -ffinite-math-only
                             -fno-math-errno
                             # all of a build is compiled alike, so how lanes are passed cannot clash
                             -Wno-psabi)
if(LITTORAL_WERROR)
  target_compile_options(littoral_options INTERFACE -Werror)
endif()
if(LITTORAL_NATIVE)
  # 256-bit lanes beat 512-bit ones for the gathers of the pair loops
  target_compile_options(littoral_options INTERFACE -march=native -mprefer-vector-width=256)
endif()
if(LITTORAL_SANITIZE)
  # Checks at every access take as long to compile as all the rest. null, object-size: what they find, the address
  # sanitizer stops at as well; vptr likewise for objects that have ended. alignment stays where bytes become numbers,
  # in the libraries the solvers share.
  target_compile_options(
    littoral_options INTERFACE -fsanitize=${LITTORAL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize=null,object-size,vptr
    $<$<NOT:$<IN_LIST:$<TARGET_PROPERTY:NAME>,littoral_coupler;littoral_record;littoral_support>>:-fno-sanitize=alignment>)
  target_link_options(littoral_options INTERFACE -fsanitize=${LITTORAL_SANITIZE})
  target_sources(littoral_options
                 INTERFACE $<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:${CMAKE_CURRENT_LIST_DIR}/sanitizer_defaults.cpp>)
endif()

if(LITTORAL_PRECOMPILE)
  target_compile_options(littoral_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)  # for ccache
endif()

# littoral_precompile(target header ...): with LITTORAL_PRECOMPILE those of the standard library that most files read, and
# the given ones, are read once for the target. Files name what they use all the same: other builds read them one by one.
function(littoral_precompile target)
  if(LITTORAL_PRECOMPILE)
    target_precompile_headers(
      ${target} PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map> <memory> <optional> <sstream>
      <string> <vector> ${ARGN})
  endif()
endfunction()

# littoral_gtest(NAME name PREFIX ctest-prefix SOURCES ... LIBS ...): one GoogleTest program, each case a ctest.
function(littoral_gtest)
  cmake_parse_arguments(T "" "NAME;PREFIX;TIMEOUT" "SOURCES;LIBS" ${ARGN})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 60)
  endif()
  if(LITTORAL_SANITIZE)
    math(EXPR T_TIMEOUT "3 * ${T_TIMEOUT}")
  endif()
  add_executable(${T_NAME} ${T_SOURCES})
  target_link_libraries(${T_NAME} PRIVATE ${T_LIBS} littoral_options GTest::gtest_main)
  list(LENGTH T_SOURCES n_sources)
  if(n_sources GREATER 3)
    littoral_precompile(${T_NAME} <random> <gtest/gtest.h>)
  endif()
  gtest_discover_tests(
    ${T_NAME}
    TEST_PREFIX ${T_PREFIX}.
    WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}
    DISCOVERY_TIMEOUT 60
    # small cases: threads would only wait for each other when tests run side by side
    PROPERTIES TIMEOUT ${T_TIMEOUT} ENVIRONMENT "OMP_NUM_THREADS=1")
endfunction()

# littoral_mpi_test(NAME ctest-name RANKS n COMMAND ... [TIMEOUT s] [PASS regex] [FAILS]): one mpirun job in a
# folder of its own (leaks are not looked for: MPI unloads the plugins that leak before anyone can tell whose they
# were). COMMAND may be an MPMD line ("a : -n 2 b"). FAILS: the job must exit non-zero.
function(littoral_mpi_test)
  cmake_parse_arguments(T "FAILS" "NAME;RANKS;TIMEOUT;PASS" "COMMAND" ${ARGN})
  if(NOT T_TIMEOUT)
    set(T_TIMEOUT 60)
  endif()
  if(LITTORAL_SANITIZE)
    math(EXPR T_TIMEOUT "3 * ${T_TIMEOUT}")
  endif()
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${T_NAME})
  file(MAKE_DIRECTORY ${folder})
  add_test(NAME ${T_NAME}
           COMMAND ${CMAKE_SOURCE_DIR}/tests/support/mpi_test ${T_TIMEOUT} $<IF:$<BOOL:${T_FAILS}>,fails,passes>
                   "${T_PASS}" ${MPIEXEC_EXECUTABLE} --oversubscribe -n ${T_RANKS} ${T_COMMAND}
           WORKING_DIRECTORY ${folder})
  math(EXPR outer "${T_TIMEOUT} + 15")
  set_tests_properties(
    ${T_NAME} PROPERTIES TIMEOUT ${outer} ENVIRONMENT
                         "OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;OMP_NUM_THREADS=1;ASAN_OPTIONS=detect_leaks=0")
endfunction()
