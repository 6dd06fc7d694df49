# Tests of fv_solver/implicit.
find_package(Eigen3 REQUIRED)
littoral_gtest(
  NAME fv_implicit_test
  PREFIX fv
  SOURCES implicit_lines_test.cpp implicit_multigrid_test.cpp implicit_solver_test.cpp
  LIBS fv_core Eigen3::Eigen)
# small dense oracles need no lanes, and g++ 12 warns about its own AVX-512 headers
target_compile_definitions(fv_implicit_test PRIVATE EIGEN_DONT_VECTORIZE)
